/// `septet-sound`: the sound of a recorded session as a file. `septet sound` starts it.

#include <filesystem>
#include <string>

#include <fmt/core.h>

#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "program/confinement.hpp"
#include "sim-client/sound/sound_program.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  using program::number_between;
  sound::SoundOptions options;
  std::string speakers = "stereo";
  CLI::App app{
      "Turn a recorded session into a sound file: what the driver heard, all of it synthesised (docs/sound.md).\n"
      "No sound device is needed. Full scale is a pressure of 1 Pa: 94 dB.",
      "septet sound"};
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("septet: {}; septet sound --help shows the options\n", error.what());
  });
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  app.add_option("session", options.session, "Session file of a drive")->required();
  app.add_option("--out", options.out, "New file: WAV, 48 kHz, 16 bits")->default_str("drive.wav, beside the session");
  app.add_option("--speakers", speakers, "stereo, or 5.1 with what shakes in its channel of low frequencies")
      ->check(CLI::IsMember({"stereo", "5.1"}))
      ->capture_default_str();
  app.add_flag("--headphones", options.stage.headphones, "Stereo for headphones, by a head's transfer function");
  app.add_option("--volume", options.stage.volume_db, "In dB; 0 is as loud as it was in the car")
      ->check(number_between(-60.0, 40.0))
      ->capture_default_str();
  app.add_option("--from", options.from_s, "Simulated second: leave out what is earlier")
      ->check(number_between(0.0, 1e6));
  app.add_option("--to", options.to_s, "Simulated second: leave out what is later")->check(number_between(0.0, 1e6));
  return program::run("septet", app, argc, argv, [&] {
    options.stage.speakers = speakers == "5.1" ? audio::Speakers::surround_51 : audio::Speakers::stereo;
    // The output is a file, or the session whose folder will hold it; writing is limited to that folder.
    program::write_only_below(
        {std::filesystem::absolute(options.out.empty() ? options.session : options.out).parent_path()});
    return sound::run_sound(options);
  });
}
