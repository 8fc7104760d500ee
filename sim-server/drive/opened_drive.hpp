#pragma once
/// A source of ticks with all that it stands on: a scenario to be driven, or a session to be shown again.

#include <memory>
#include <optional>

#include "engine/core/expected.hpp"
#include "engine/scene/store.hpp"
#include "logging/session/session_reader.hpp"
#include "program/console.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/server_options.hpp"
#include "sim-server/host/remote_car.hpp"
#include "sim-server/host/tick_source.hpp"

namespace septet::server {

struct OpenedDrive {
  LoadedDrive loaded;  ///< Of a session that is shown again the rig alone.
  scene::Store store;
  std::optional<logging::SessionReader> session;  ///< Nothing: it is driven.
  bool by_person = false;                         ///< A person drives, not a simulated driver.
  std::shared_ptr<RemoteCar> remote_car;          ///< The driver's car, where it is on another machine.
  std::unique_ptr<TickSource> source;
  LiveDrive* live = nullptr;  ///< The source, where it is driven.
};

/// The drive or the session that the options name, whose files have been found (find_files). Error: what cannot be read or opened.
Expected<std::unique_ptr<OpenedDrive>> open_drive(const ServerOptions& options, program::ProgressLine& line);

}  // namespace septet::server
