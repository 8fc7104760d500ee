#include "engine/traffic/ring.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "engine/core/check.hpp"
#include "engine/road/opendrive_reader.hpp"

namespace septet::traffic {

road::RoadNetwork ring_road(double length_m, int lanes) {
  std::string right;
  for (int id = 1; id <= lanes; ++id) {
    right += fmt::format(R"(<lane id="-{}" type="driving"><link><predecessor id="-{}"/><successor id="-{}"/></link>)"
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
  SEPTET_CHECK(network.has_value(), "a ring of {} m: {}", length_m, describe(network.error()));
  return std::move(*network);
}

TrafficState dense_ring(const road::RoadNetwork& network, int lanes, std::uint32_t count, std::uint64_t seed) {
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
    const std::uint32_t place = k / static_cast<std::uint32_t>(lanes);
    const double x = std::fmod(place * spacing + random.uniform(0.0, 0.1) * spacing + lane * 3.0, length);
    const double bell = (random.uniform() + random.uniform() + random.uniform()) / 3.0;
    const Driver driver = with_temperament(kind.middle, bell);
    add_vehicle(traffic, 1000 + k, kind.model, driver, lane, x,
                idm_equilibrium_speed(driver.following, std::max(3.0, spacing - 14.0)));
  }
  return state;
}

}  // namespace septet::traffic
