#pragma once
/// Reasons for the end of a drive: one list for the log, the summary, the report, the last line and the exit status.

#include <cstdint>
#include <optional>
#include <string_view>

namespace septet::logging {

enum class DriveEnd : std::uint8_t {
  stop_trigger,   ///< The storyboard's StopTrigger.
  time_over,      ///< The requested simulated seconds are over.
  road_end,       ///< The driver's car is beyond the end of the road.
  game_over,      ///< The scenario's game is over.
  session_end,    ///< Replay: end of the session.
  window_closed,  ///< By the person at a screen.
  escape,         ///< Pressed at a screen.
  restart,        ///< Requested at a screen or on the operator's page: `septet drive` begins the drive again.
  by_operator,    ///< On the operator's page.
  interrupted,    ///< SIGINT: Ctrl-C.
  terminated,     ///< SIGTERM.
  hung_up,        ///< SIGHUP: the terminal or the connection to it has gone.
  log_failed,     ///< The log cannot be written: disk full or gone, file deleted.
  traffic_lost,   ///< Connection to the traffic engine lost.
  no_screens,     ///< No screen could be started.
  failed,         ///< Any other error.
};

/// Name in files: "stop_trigger", …
std::string_view name_of(DriveEnd end);
/// For people: "the scenario's StopTrigger fired", …
std::string_view text_of(DriveEnd end);
std::optional<DriveEnd> drive_end_called(std::string_view name);

/// Exit statuses of `septet drive`, `septet replay` and `septet-server`. 2 is wrong use of the command line.
inline constexpr int finished_status = 0, failed_status = 1, stopped_status = 3;
/// Finished: the drive came to an end of its own. Stopped: a person ended it before.
int exit_status(DriveEnd end);

}  // namespace septet::logging
