/// `septet-screen`: one screen of a rig, in a window, full screen or off-screen.

#include <string>

#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "sim-client/screen/screen_session.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  screen::ScreenOptions options;
  std::string server = "127.0.0.1:4750";
  CLI::App app{"septet-screen: one screen of a rig. `septet drive` starts it; on another machine start it yourself."};
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  app.add_option("--name", options.name, "Which screen of the rig")->required();
  app.add_option("--server", server, "Server's address and port");
  app.add_option("--keys", options.keys, "Folder with NAME.key and server.public")->required();
  app.add_option("--pictures", options.pictures, "Folder for a picture of every simulated second");
  app.add_option("--scene-hashes", options.scene_hashes,
                 "File for the tick of each picture that is kept, and the hash of the scene that it shows");
  app.add_flag("--virtual", options.is_virtual, "Off-screen");
  app.add_flag("--full-screen", options.full_screen, "Cover a whole monitor");
  app.add_option("--monitor", options.monitor, "Which monitor of this machine, from 0, instead of the rig's")
      ->check(CLI::Range(0, 63));
  app.add_flag("--validation", options.validation, "Turn on Vulkan's validation layer");
  return program::run("septet-screen", app, argc, argv, [&]() -> Expected<int> {
    const auto address = net::parse_address(server, "--server");
    if (!address) return tl::unexpected(address.error());
    options.server = *address;
    return screen::run_screen(options).map([] { return 0; });
  });
}
