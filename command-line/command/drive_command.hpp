#pragma once
/// `septet drive`: server, screens and car on this machine, or the parts that this machine has in the rig.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

struct DriveOptions {
  std::string scenario = "motorway-ambulance";  ///< A file, a folder, or a name below scenarios/.
  std::string rig;                ///< A file, or a name below rigs/; empty: by whether there is a display.
  std::filesystem::path out;      ///< Empty: out/latest; of a replay: replay, beside the session.
  std::optional<double> seconds;  ///< Simulated; 0: until the scenario ends or somebody stops it.
  std::uint64_t seed = 1;
  bool virtual_screens = false;
  std::string driver;                   ///< Which simulated driver; empty: the rig's.
  std::string vehicle;                  ///< A file, or a name below vehicles/; empty: the rig's.
  std::filesystem::path models;         ///< Folder of a person's own models; empty: none.
  std::string participant;              ///< The driver's code, for log, summary and report.
  std::vector<std::string> about;       ///< Of whoever drives, each "KEY=VALUE" (logging/subject.hpp).
  std::string log = "whole";            ///< Or samples: no snapshots.
  std::vector<std::string> parameters;  ///< Of the scenario, each "NAME=VALUE".
  std::string traffic = "own";          ///< Who moves the traffic: own or sumo.
  std::filesystem::path replay;         ///< A session to show again, instead of a scenario to drive.
  double replay_from_s = 0.0;
  bool full_screen = false;             ///< Also where the rig does not say so.
  bool start_now = false;               ///< Do not wait for a person to take the controls.
  std::optional<int> page_port;         ///< Of the operator's page; 0: any free one; none: there is no page.
  std::vector<std::string> page_hosts;  ///< By what names, beside this machine's own, it may be asked for.
  bool no_screens = false;              ///< Server and car only.
  bool no_sound = false;                ///< Also where the rig has a sound.
};

/// Of a drive that is not told how long to last, off-screen. One in a window, and a replay, last as for `--seconds 0`.
inline constexpr double seconds_unless_told = 30.0;

/// Runs the whole drive; returns the exit status (logging/drive_end.hpp). Prints progress to standard error, and at the end to
/// standard output what there is to look at and, in the last line, why the drive has ended.
Expected<int> run_drive(DriveOptions options);

}  // namespace septet::server
