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
  std::string rig;                ///< A file, or a name below rigs/; empty: chosen by the presence of a display.
  std::filesystem::path out;      ///< Empty: out/latest; for a replay: replay, beside the session.
  std::optional<double> seconds;  ///< Simulated; 0: until the scenario ends or a person stops it.
  std::uint64_t seed = 1;
  bool virtual_screens = false;
  std::string driver;                   ///< Simulated driver; empty: the rig's.
  std::string to;                       ///< Goal to which the driver is guided; empty: nobody guides him.
  std::string language = "en";          ///< Of spoken guidance.
  std::string motion;                   ///< Table by which the driver's car goes; empty: somebody drives.
  std::string vehicle;                  ///< A file, or a name below vehicles/; empty: the rig's.
  std::filesystem::path models;         ///< Folder of a person's own models; empty: none.
  std::string participant;              ///< The driver's code, for log, summary and report.
  std::vector<std::string> about;       ///< Facts of the driver, each "KEY=VALUE" (logging/session/subject.hpp).
  std::string log = "whole";            ///< Or "samples": without snapshots.
  std::vector<std::string> parameters;  ///< Scenario parameters, each "NAME=VALUE".
  std::string traffic = "own";          ///< Traffic engine: own or sumo.
  std::filesystem::path replay;         ///< A session to replay, instead of a scenario to drive.
  double replay_from_s = 0.0;
  std::string eyes;                     ///< Of a replay: whose eyes, by name or number; empty: the driver's.
  std::filesystem::path begin_from;     ///< An earlier session of this drive; empty: begin at the start.
  double begin_at_s = 0.0;              ///< The drive begins at the newest state that session kept until then.
  bool full_screen = false;             ///< Full screen even without the rig's `full_screen`.
  bool start_now = false;               ///< Do not wait for a person to take the controls.
  std::optional<int> page_port;         ///< Port of the operator's page; 0: any free one; empty: no page.
  std::vector<std::string> page_hosts;  ///< Allowed host names of the page, beside this machine's own.
  std::filesystem::path edits;          ///< File of edits over the generated world; empty: none.
  std::filesystem::path save;           ///< File for what differs from that world at the end; empty: none.
  std::filesystem::path editors;        ///< Folder for the key and the address of `septet edit`; empty: nobody edits.
  bool no_screens = false;              ///< Server and car only.
  bool no_sound = false;                ///< Silences a rig with sound too.
};

/// Default length of an off-screen drive. One in a window, and a replay, last as for `--seconds 0`.
inline constexpr double seconds_unless_told = 30.0;

/// Runs the whole drive; returns the exit status (logging/session/drive_end.hpp). Prints progress to standard error,
/// and at the end the results' places to standard output, with the reason of the end in the last line.
Expected<int> run_drive(DriveOptions options);

}  // namespace septet::server
