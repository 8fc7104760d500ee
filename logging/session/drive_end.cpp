#include "logging/session/drive_end.hpp"

#include <algorithm>
#include <array>

#include "engine/core/check.hpp"

namespace septet::logging {
namespace {

struct Row {
  DriveEnd end;
  std::string_view name, text;
  int status;
};

constexpr std::array rows{
    Row{DriveEnd::stop_trigger, "stop_trigger", "the scenario's StopTrigger fired", finished_status},
    Row{DriveEnd::time_over, "time_over", "the time that it was given is over", finished_status},
    Row{DriveEnd::road_end, "road_end", "the driver's car is beyond the end of the road", finished_status},
    Row{DriveEnd::game_over, "game_over", "the game is over", finished_status},
    Row{DriveEnd::session_end, "session_end", "the session is over", finished_status},
    Row{DriveEnd::window_closed, "window_closed", "a screen's window was closed", stopped_status},
    Row{DriveEnd::escape, "escape", "the driver left it by Escape", stopped_status},
    Row{DriveEnd::restart, "restart", "it was to begin again", stopped_status},
    Row{DriveEnd::by_operator, "by_operator", "the operator ended it", stopped_status},
    Row{DriveEnd::interrupted, "interrupted", "it was interrupted (SIGINT)", stopped_status},
    Row{DriveEnd::terminated, "terminated", "it was asked to end (SIGTERM)", stopped_status},
    Row{DriveEnd::hung_up, "hung_up", "its terminal has gone (SIGHUP)", stopped_status},
    Row{DriveEnd::log_failed, "log_failed", "the log cannot be written", failed_status},
    Row{DriveEnd::traffic_lost, "traffic_lost", "the traffic engine has gone", failed_status},
    Row{DriveEnd::no_screens, "no_screens", "no screen could be started", failed_status},
    Row{DriveEnd::failed, "failed", "of an error", failed_status},
};

const Row& row_of(DriveEnd end) {
  const auto found = std::ranges::find(rows, end, &Row::end);
  SEPTET_CHECK(found != rows.end(), "an end of number {}", static_cast<int>(end));
  return *found;
}

}  // namespace

std::string_view name_of(DriveEnd end) { return row_of(end).name; }
std::string_view text_of(DriveEnd end) { return row_of(end).text; }
int exit_status(DriveEnd end) { return row_of(end).status; }

std::optional<DriveEnd> drive_end_called(std::string_view name) {
  const auto found = std::ranges::find(rows, name, &Row::name);
  return found == rows.end() ? std::nullopt : std::optional(found->end);
}

}  // namespace septet::logging
