#pragma once
/// One screen from connecting to the end of the drive: receives, draws, presents, keeps pictures, reports.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/net/address.hpp"

namespace septet::screen {

struct ScreenOptions {
  std::string name;  ///< In the rig.
  net::Address server;
  std::filesystem::path keys;            ///< Folder with NAME.key and server.public.
  std::filesystem::path pictures;        ///< Where pictures of whole ticks go (TICK.png); empty: none are kept.
  bool is_virtual = false;               ///< Off-screen, on the software rasteriser.
  bool full_screen = false;              ///< Also where the rig does not say so.
  std::optional<std::uint32_t> monitor;  ///< Instead of the rig's.
  bool validation = false;
};

/// Runs until the server says that the drive is over, the window is closed or `SIGTERM` comes.
Expected<void> run_screen(const ScreenOptions& options);

}  // namespace septet::screen
