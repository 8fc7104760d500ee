#pragma once
/// What `septet-server` is told on its command line.

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
  std::filesystem::path replay;  ///< A session to show instead of a scenario to drive.
  double replay_from_s = 0.0;
  double seconds = 0.0;  ///< Simulated; 0: until stopped.
  std::uint64_t seed = 1;
  std::string driver;              ///< A simulated driver, who then drives whatever the rig says; empty: the rig's.
  std::string vehicle;             ///< A file or a name; empty: the rig's.
  std::filesystem::path models;    ///< Folder of a person's own models; empty: none.
  std::string participant;         ///< The driver's code.
  std::vector<std::string> about;  ///< Of whoever drives, each "KEY=VALUE" (logging/session/subject.hpp).
  bool log_samples_only = false;   ///< The log keeps no snapshots: it can be measured, and not be shown again.
  std::vector<std::string> parameters;  ///< Of the scenario, each "NAME=VALUE".
  std::string traffic = "own";          ///< Who moves the traffic: own or sumo.
  std::filesystem::path begin_from;     ///< An earlier session of the same drive; empty: begin at the start.
  double begin_at_s = 0.0;              ///< The drive begins at the newest state that session kept until then.
  double wait_for_screens_s =
      -1.0;  ///< Before it drives, in real time; then without those that are missing. Negative: until all are there.
  bool start_now = false;  ///< Do not wait for a person to take the controls.
  bool lockstep = false;
  bool no_screens = false;
  bool no_sound = false;                ///< Also where the rig has a sound.
  std::optional<int> page_port;         ///< Of the operator's page; 0: any free one; none: there is no page.
  std::vector<std::string> page_hosts;  ///< By what names, beside this machine's own, it may be asked for.
  std::optional<page::Handover>
      page_handover;      ///< The page's port and token, where whoever started the drive had them.
  bool any_port = false;  ///< Any free port instead of the rig's: several drives on one machine.
};

inline constexpr std::size_t most_participant_characters = 100;

/// What can be said of them before any file is read.
/// Error: no such driver or traffic engine; a participant's code that cannot be printed on one line of a report.
Expected<void> check_names(const ServerOptions& options);

/// Makes rig and scenario, which may be names or folders, the files that they mean. Error: there is no such file.
Expected<void> find_files(ServerOptions& options);

}  // namespace septet::server
