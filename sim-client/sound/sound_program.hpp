#pragma once
/// Execution of the command line of `septet-sound`: the sound of a recorded session as a file.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/audio/sound_stage.hpp"
#include "engine/core/expected.hpp"

namespace septet::sound {

struct SoundOptions {
  std::filesystem::path session;
  std::filesystem::path out;  ///< Empty: drive.wav beside the session.
  std::optional<double> from_s, to_s;
  audio::StageOptions stage;
  std::uint64_t seed = 1;  ///< Seed of the noises.
};

/// Makes the file and prints its place. Returns the exit status; 1 if a person stopped it.
Expected<int> run_sound(SoundOptions options);

}  // namespace septet::sound
