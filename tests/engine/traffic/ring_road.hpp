#pragma once
/// Rings of any length and number of lanes, and what is measured on them.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

/// A circle of right-hand traffic, driven along s, lanes −1 to −lanes of 3.75 m.
inline road::RoadNetwork ring_road(double length_m, int lanes) {
  std::string right;
  for (int id = 1; id <= lanes; ++id) {
    right += fmt::format(
        R"(<lane id="-{}" type="driving"><link><predecessor id="-{}"/><successor id="-{}"/></link>)"
        R"(<width sOffset="0" a="3.75" b="0" c="0" d="0"/></lane>)",
        id, id, id);
  }
  const std::string text = fmt::format(
      R"(<OpenDRIVE><header revMajor="1" revMinor="8"/><road id="ring" length="{0}" junction="-1"><link>)"
      R"(<predecessor elementType="road" elementId="ring" contactPoint="end"/>)"
      R"(<successor elementType="road" elementId="ring" contactPoint="start"/></link><planView>)"
      R"(<geometry s="0" x="0" y="0" hdg="0" length="{0}"><arc curvature="{1:.17g}"/></geometry></planView>)"
      R"(<lanes><laneSection s="0"><center><lane id="0" type="none"/></center><right>{2}</right></laneSection></lanes>)"
      R"(</road></OpenDRIVE>)",
      length_m, 2.0 * std::acos(-1.0) / length_m, right);
  auto network = road::read_opendrive(text, "ring.xodr");
  if (!network) throw std::runtime_error(describe(network.error()));
  return std::move(*network);
}

inline ModelIndex model_named(std::string_view name) { return *find_vehicle_model(name); }

/// `count` vehicles spread evenly over a ring's lanes, every seventh a lorry on the outer lanes,
/// drivers from timid to aggressive, each at the speed that its gap allows.
inline TrafficState dense_ring(const road::RoadNetwork& network, int lanes, std::uint32_t count,
                               std::uint64_t seed) {
  Random random(seed, 5);
  TrafficState state;
  state.corridors.push_back(empty_corridor(network, {0, -1, 1.0, 0.0}));
  CorridorTraffic& traffic = state.corridors[0];
  const TrafficParameters parameters = motorway_traffic(count, 1e6);
  const double length = traffic.corridor.length_m;
  for (std::uint32_t k = 0; k < count; ++k) {
    const int lane = 1 + static_cast<int>(k % static_cast<std::uint32_t>(lanes));
    const bool heavy = lane + 2 > lanes && random.below(3) == 0;
    const VehicleClass& kind = parameters.classes[heavy ? 5 : random.below(5)];
    const double spacing = length * lanes / count;
    const double x = std::fmod((k / static_cast<std::uint32_t>(lanes)) * spacing +
                                   random.uniform(0.0, 0.1) * spacing + lane * 3.0,
                               length);
    const double bell = (random.uniform() + random.uniform() + random.uniform()) / 3.0;
    const Driver driver = with_temperament(kind.middle, bell);
    add_vehicle(traffic, 1000 + k, kind.model, driver, lane, x,
                idm_equilibrium_speed(driver.following, std::max(3.0, spacing - 14.0)));
  }
  return state;
}

/// Pairs of vehicles whose bodies overlap, counting the lateral place with the corridor's nominal
/// lane width.
inline int overlapping_bodies(const CorridorTraffic& traffic) {
  int count = 0;
  std::vector<std::size_t> by_x;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.lane[i] > 0) by_x.push_back(i);
  }
  std::sort(by_x.begin(), by_x.end(),
            [&](std::size_t a, std::size_t b) { return traffic.x_m[a] < traffic.x_m[b]; });
  const std::size_t n = by_x.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t behind = by_x[k];
    for (std::size_t step = 1; step < n; ++step) {
      const std::size_t ahead = by_x[(k + step) % n];
      double d = traffic.x_m[ahead] - traffic.x_m[behind];
      if (d < 0.0) d += traffic.corridor.closed ? traffic.corridor.length_m : 1e9;
      if (d > 20.0) break;
      const double apart = std::abs(lateral_m(traffic, ahead) - lateral_m(traffic, behind));
      const bool beside = apart >= traffic.half_width_m[ahead] + traffic.half_width_m[behind];
      if (d < traffic.length_m[ahead] && !beside) ++count;
    }
  }
  return count;
}

}  // namespace septet::traffic
