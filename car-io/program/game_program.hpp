#pragma once
/// `septet-car serve`: the car drives a commercial game. It is a wheel with force feedback to any game of this machine,
/// or for another machine's game by its telemetry; the game's data move fan, shaker and instruments (car-io/games).

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::car_io {

struct ServeOptions {
  std::filesystem::path rig;
  /// "outgauge", "outsim=30001", "codemasters", or a TOML file; a port behind = replaces the usual one. Empty: wheel
  /// alone.
  std::vector<std::string> games;
  std::string listen = "127.0.0.1";  ///< Local address for telemetry.
};

/// Runs until it is stopped, or the wheel is removed.
Expected<void> run_serve(const ServeOptions& options);

}  // namespace septet::car_io
