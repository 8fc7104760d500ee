#pragma once
/// `septet drive`: server, screens and car on this machine, or the parts that this machine has in the rig.

#include <cstdint>
#include <filesystem>
#include <string>

namespace septet::server {

struct DriveOptions {
  std::string scenario = "motorway-ambulance";  ///< A file, a folder, or a name below scenarios/.
  std::string rig;                              ///< A file, or a name below rigs/; empty: by whether there is a display.
  std::filesystem::path out;                    ///< Empty: out/latest.
  double seconds = 0.0;                         ///< Simulated; 0: 30 s where nobody drives, else until the driver stops.
  std::uint64_t seed = 1;
  bool virtual_screens = false;
  std::string driver;           ///< Which simulated driver; empty: the rig's.
  std::string traffic = "own";   ///< Who moves the traffic: own or sumo.
  std::filesystem::path replay;  ///< A session to show again, instead of a scenario to drive.
  double replay_from_s = 0.0;
  bool no_screens = false;  ///< Server and car only.
};

/// Runs the whole drive; answers the exit status. Prints progress to standard error, and at the end three lines on what there
/// is to look at to standard output.
int run_drive(DriveOptions options);

}  // namespace septet::server
