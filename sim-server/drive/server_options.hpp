#pragma once
/// Options of `septet-server`.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-server/page/listening_socket.hpp"

namespace septet::server {

struct ServerOptions {
  std::string scenario, rig;
  std::filesystem::path out;
  std::filesystem::path keys;    ///< Folder with server.key and allowed-clients.
  std::filesystem::path replay;  ///< A session to replay, instead of a scenario to drive.
  double replay_from_s = 0.0;
  std::string eyes;      ///< Of a replay: whose eyes the screens show, by name or number; empty: the driver's.
  double seconds = 0.0;  ///< Simulated; 0: until stopped.
  std::uint64_t seed = 1;
  std::string driver;            ///< A simulated driver, who replaces the rig's source; empty: the rig's.
  std::string to;                ///< Goal to which the driver is guided; empty: nobody guides him.
  std::string language = "en";   ///< Of spoken guidance: en, de or sv.
  std::string motion;            ///< Table by which the driver's car goes; empty: somebody drives.
  std::string vehicle;           ///< A file or a name; empty: the rig's.
  std::filesystem::path models;  ///< A user's folder of models; empty: none.
  std::filesystem::path edits;   ///< File of edits over the generated world; empty: none.
  std::filesystem::path save;    ///< Where what differs from the generated world is written at the end; empty: nowhere.
  std::string participant;       ///< The driver's code.
  std::vector<std::string> about;       ///< About the driver, each "KEY=VALUE" (logging/session/subject.hpp).
  bool log_samples_only = false;        ///< The log has no snapshots: it can be measured, not replayed.
  std::vector<std::string> parameters;  ///< Scenario parameters, each "NAME=VALUE".
  std::string traffic = "own";          ///< Engine of the traffic: own or sumo.
  std::filesystem::path begin_from;     ///< An earlier session of the same drive; empty: begin at the start.
  double begin_at_s = 0.0;              ///< The drive begins at the newest state kept until then.
  double wait_for_screens_s =
      -1.0;  ///< Longest wait, in real time; the drive then begins without the missing ones. Negative: unlimited.
  bool start_now = false;  ///< Do not wait for a person to take the controls.
  bool lockstep = false;
  bool no_screens = false;
  bool no_sound = false;                        ///< True: no sound, even if the rig has one.
  std::optional<int> page_port;                 ///< Port of the operator's page; 0: any free one; empty: no page.
  std::vector<std::string> page_hosts;          ///< Further host names for the page, beside this machine's own.
  std::optional<page::Handover> page_handover;  ///< The page's port and token, if the parent program had them.
  bool any_port = false;  ///< Any free port instead of the rig's, for several drives on one machine.
};

inline constexpr std::size_t most_participant_characters = 100;

/// Checks all that needs no file. Error: no such driver or traffic engine; a participant's code that cannot be printed
/// on one line of a report.
Expected<void> check_names(const ServerOptions& options);

/// Replaces the names or folders in `rig` and `scenario` by their files. Error: there is no such file.
Expected<void> find_files(ServerOptions& options);

}  // namespace septet::server
