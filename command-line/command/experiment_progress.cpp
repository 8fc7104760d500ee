#include "command-line/command/experiment_progress.hpp"

#include <cmath>

#include <fmt/core.h>

namespace septet::server {

std::string text_of(const ExperimentProgress& p) {
  const double rate = p.wall_s > 0.0 ? p.driven_now_s / p.wall_s : 0.0;
  const std::string left =
      rate > 0.0 ? fmt::format("at most {:.0f} min left", std::ceil((p.planned_s - p.driven_s) / rate / 60.0))
                 : std::string("time left not known yet");
  return fmt::format("{} of {} subjects, {:.2f} of {:.2f} h driven, {:.0f} times as fast as real time, {}", p.finished,
                     p.subjects, p.driven_s / 3600.0, p.planned_s / 3600.0, rate, left);
}

}  // namespace septet::server
