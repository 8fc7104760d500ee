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
  std::string name;  ///< Name in the rig.
  net::Address server;
  std::filesystem::path keys;            ///< Folder with NAME.key and server.public.
  std::filesystem::path pictures;        ///< Folder for pictures of whole ticks (TICK.png); empty: not kept.
  std::filesystem::path scene_hashes;    ///< File for a line of each kept picture; empty: none.
  bool is_virtual = false;               ///< Off-screen, on the software rasteriser.
  bool full_screen = false;              ///< Full screen even without the rig's `full_screen`.
  std::optional<std::uint32_t> monitor;  ///< Overrides the rig's.
  bool validation = false;
};

/// Runs until the server ends the drive, the window is closed or `SIGTERM` comes.
Expected<void> run_screen(const ScreenOptions& options);

}  // namespace septet::screen
