#pragma once
/// The sound of a film: a session's sound cut as the film's shots are, and as fast as they are.
///
/// Each cut begins anew, a quarter of a second of sound before it goes unheard, and its edges fade over 3 ms. A shot in slow motion is heard
/// as a tape that runs slowly: deeper, and each event with its picture. It is what the driver heard, wherever the camera is.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "logging/session_reader.hpp"

namespace septet::sound {

/// A stretch of the session, played at `speed` for so many frames of the film.
struct Cut {
  double from_s = 0.0, speed = 1.0;
  std::uint64_t frames = 0;
};

/// Writes a stereo WAV file as long as the film to the sample. `go_on` is asked after each block; false where it said no, and then there is no
/// file. Error: the session cannot be heard, the file cannot be written.
Expected<bool> write_cut_track(const logging::SessionReader& session, const std::vector<Cut>& cuts,
                               double frames_per_second, const std::filesystem::path& file,
                               const std::function<bool()>& go_on);

}  // namespace septet::sound
