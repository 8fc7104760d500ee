#pragma once
/// A drive's model from files, or from the texts in a session.

#include <memory>
#include <string>
#include <vector>

#include "engine/rig/rig.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/simulation/model.hpp"
#include "logging/session/records.hpp"

namespace septet::server {

/// Role of the table by which the driver's car goes, among a drive's sources.
inline constexpr std::string_view motion_role = "motion";

/// Files on disk that a drive is loaded from, and its options.
struct DriveFiles {
  std::string scenario;  ///< Path of the .xosc.
  std::string rig;       ///< Path of the .toml.
  std::uint64_t seed = 1;
  std::string vehicle{};                               ///< A file or a name, instead of the rig's; empty: the rig's.
  std::string motion{};                                ///< Table of the car's motion; empty: somebody drives.
  std::vector<scenario::ParameterValue> parameters{};  ///< Instead of the scenario's own values.
};

/// A model with the texts that it was read from: they go into the log, so that a session needs no file beside it.
struct LoadedDrive {
  std::shared_ptr<const simulation::Model> model;
  rig::Rig rig;
  std::vector<logging::SourceFile> sources;          ///< Roles: scenario, road, rig, vehicle, catalog, motion.
  std::vector<scenario::ParameterValue> parameters;  ///< Those given by the user.
  std::vector<std::string> warnings;                 ///< Unsupported contents of the files, by name and line.

  const std::string& source(std::string_view role) const;
  /// Name of the vehicle's file, without folder and extension.
  std::string vehicle_name() const;
};

Expected<LoadedDrive> load_drive(const DriveFiles& files);
/// Loads the drive of a session again. `where`: the session's file, for errors.
Expected<LoadedDrive> load_drive(const logging::SessionInfo& session, const std::string& where);

}  // namespace septet::server
