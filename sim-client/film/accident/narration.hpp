#pragma once
/// A narrator's voice in a film: one WAV file for each subtitle, by a command of the user's.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-client/film/accident/subtitles.hpp"

namespace septet::film {

/// Runs `command` by the shell once for each of `spoken`, with the words in the environment as WORDS and the name of
/// the file to write as WAV, and adds what it has written to the film's sound, each at its beginning. The pictures stay
/// as they are. Error: the command fails or writes nothing, or ffmpeg cannot add it; the film is as before then.
Expected<void> narrate(const std::filesystem::path& film, bool has_sound, const std::vector<Spoken>& spoken,
                       const std::string& command);

}  // namespace septet::film
