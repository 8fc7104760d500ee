#include "sim-server/attendants/console.hpp"

#include <csignal>
#include <optional>
#include <string>

#include <fmt/core.h>

#include "program/stop_signal.hpp"
#include "sim-server/host/serve.hpp"

namespace septet::server {
namespace {

/// The end that a signal asks for.
std::optional<logging::DriveEnd> end_by_signal() {
  const auto signal = program::stop_signal();
  if (!signal) return std::nullopt;
  program::obey_stop_signal();
  switch (*signal) {
    case SIGINT:
      return logging::DriveEnd::interrupted;
    case SIGHUP:
      return logging::DriveEnd::hung_up;
    case SIGUSR1:
      return logging::DriveEnd::no_screens;
    default:
      return logging::DriveEnd::terminated;
  }
}

}  // namespace

void Console::before_tick(const Moment& moment) {
  has_begun_ = moment.newest != nullptr;
  if (!live_ || !live_->actuators_cut() || !input_.take_rearm()) return;
  if (const auto why_not = live_->rearm_actuators("console"))
    line_.message("fan, shaker and wheel force stay at 0: " + *why_not);
}

Wishes Console::wishes() {
  Wishes wishes;
  wishes.end = end_by_signal();
  wishes.goes_without_missing = reads_go_ && !has_begun_ && input_.said();
  return wishes;
}

void Console::show(const Progress& progress) {
  // Time passed begins anew when the driver has taken the controls.
  if (!line_.is_due(progress.wall_s)) return;
  const std::string total = progress.total_s > 0.0 ? fmt::format(" of {:.0f}", progress.total_s) : "";
  line_.show(fmt::format("{:6.1f}{} s driven, {:.0f} s passed, {}", progress.simulated_s, total, progress.wall_s,
                         progress.doing));
}

void Console::close(ServeResult& result) {
  line_.close();
  if (result.error) line_.message(fmt::format("septet-server: {}", describe(*result.error)));
}

}  // namespace septet::server
