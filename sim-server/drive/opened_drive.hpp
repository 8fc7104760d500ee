#pragma once
/// A source of ticks with everything it depends on: a scenario to drive, or a session to replay.

#include <memory>
#include <optional>

#include "engine/core/expected.hpp"
#include "engine/scene/store.hpp"
#include "logging/session/participants.hpp"
#include "logging/session/recorded_scene.hpp"
#include "logging/session/session_reader.hpp"
#include "program/console.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/server_options.hpp"
#include "sim-server/drive/standing_things.hpp"
#include "sim-server/host/remote_car.hpp"
#include "sim-server/host/tick_source.hpp"

namespace septet::server {

struct OpenedDrive {
  LoadedDrive loaded;  ///< For a replay, the rig alone.
  scene::Store store;
  std::optional<scene::Store> generated;          ///< As it was before any edit, where what differs is to be saved.
  StandingThings standing;                        ///< Of the generated world.
  std::optional<logging::SessionReader> session;  ///< Set for a replay.
  std::optional<logging::RecordedScene> recorded_scene;  ///< Of a replay: what is still to come of it.
  std::optional<logging::Stay> eyes;      ///< Of a replay: whose eyes the screens show; empty: the driver's.
  bool by_person = false;                 ///< A person drives, not a simulated driver.
  std::shared_ptr<RemoteCar> remote_car;  ///< The driver's car, if it is on another machine.
  std::unique_ptr<TickSource> source;
  LiveDrive* live = nullptr;  ///< The source, if it is a drive; null for a replay.
};

/// Opens the drive or the session named by the options, whose files have been found (find_files). Error: a file or a
/// device cannot be opened.
Expected<std::unique_ptr<OpenedDrive>> open_drive(const ServerOptions& options, program::ProgressLine& line);

}  // namespace septet::server
