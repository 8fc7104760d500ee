#include "logging/study/drive_observer.hpp"

#include <fmt/core.h>

namespace septet::logging {

Observation observe(DriveObserver& observer, const Snapshot& snapshot, const std::optional<Leader>& leader) {
  Observation result;
  const ParticipantId driver = snapshot.driver_car.participant;
  const auto add = [&](Tick tick, double time_s, const char* kind, std::string detail) {
    result.events.push_back({tick, time_s, kind, driver, std::move(detail)});
  };
  if (!is_sample_due(snapshot.tick, observer.ticks_per_second)) return result;
  result.sample = take_sample(snapshot, leader);
  if (const auto change = advance(observer.lane_changes, *result.sample))
    add(change->tick, change->simulated_time_s, "lane_change",
        fmt::format("lanes_to_left={} from_lane={} to_lane={}", change->lanes_to_left, change->from_lane,
                    change->to_lane));
  if (const auto glance = advance(observer.glances, *result.sample))
    add(glance->tick, glance->start_s, "mirror_glance",
        fmt::format("area=\"{}\" duration_s={:.2f}", glance->area, glance->duration_s));
  return result;
}

}  // namespace septet::logging
