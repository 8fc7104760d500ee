#pragma once
/// Sound of a film: a session's sound with the film's cuts and speeds.
///
/// Each cut starts with a quarter of a second that is not heard, and its edges fade over 3 ms. A shot in slow motion
/// sounds like a slow tape: deeper, and each event with its picture. The sound is the driver's, wherever the camera is.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "logging/session/session_reader.hpp"

namespace septet::sound {

/// Stretch of the session, played at `speed` for this many frames of the film.
struct Cut {
  double from_s = 0.0, speed = 1.0;
  std::uint64_t frames = 0;
};

/// Writes a stereo WAV file as long as the film to the sample. `go_on` is called after each block; if it returns false,
/// so does this, and there is no file. Error: the session's sound cannot be rendered, the file cannot be written.
Expected<bool> write_cut_track(const logging::SessionReader& session, const std::vector<Cut>& cuts,
                               double frames_per_second, const std::filesystem::path& file,
                               const std::function<bool()>& go_on);

}  // namespace septet::sound
