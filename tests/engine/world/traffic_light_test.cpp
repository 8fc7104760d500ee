// Traffic lights on the wire: their encoding, and foreign bytes.

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/world/traffic_light.hpp"

namespace septet {
namespace {

std::vector<TrafficLight> two_lights() {
  TrafficLight first{.road = 3, .s_m = 399.0, .along_s = true};
  first.world_from_light = {Vec3(1326.5, -489.25, 14.3), orientation_from_angles(2.5, 0.0, 0.0)};
  first.lamps.set(Lamp::signal_red, true);
  TrafficLight second{.road = 70000, .s_m = 1.0, .along_s = false, .for_walkers = true};
  second.world_from_light = {Vec3(-5e5, 3e5, -12.0), orientation_from_angles(-3.0, 0.0, 0.0)};
  second.lamps.set(Lamp::signal_green, true);
  return {first, second};
}

}  // namespace

TEST_CASE("lights come out of their keyframe as they went in, to the millimetre") {
  const auto sent = two_lights();
  const auto got = decode_traffic_lights(encode_traffic_lights(sent));
  REQUIRE(got.has_value());
  REQUIRE(got->size() == sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    const TrafficLight &a = sent[i], &b = (*got)[i];
    CHECK(a.road == b.road);
    CHECK(std::abs(a.s_m - b.s_m) <= 0.0005);
    CHECK(a.along_s == b.along_s);
    CHECK(a.for_walkers == b.for_walkers);
    CHECK(a.lamps == b.lamps);
    CHECK(glm::length(a.world_from_light.position_m - b.world_from_light.position_m) < 0.001);
    CHECK(std::abs(glm::dot(a.world_from_light.orientation, b.world_from_light.orientation)) > 1.0 - 1e-8);
  }
}

TEST_CASE("numbers that are none or boundless are sent as something that can be read") {
  auto lights = two_lights();
  lights[0].world_from_light.position_m.x = std::numeric_limits<double>::quiet_NaN();
  lights[1].world_from_light.position_m.y = std::numeric_limits<double>::infinity();
  lights[1].s_m = -1e300;
  CHECK(decode_traffic_lights(encode_traffic_lights(lights)).has_value());
}

TEST_CASE("a keyframe that is cut, longer or made up is refused or read, and never more") {
  const Bytes whole = encode_traffic_lights(two_lights());
  for (std::size_t length = 0; length < whole.size(); ++length)
    CHECK_FALSE(decode_traffic_lights(std::span(whole).first(length)).has_value());
  Bytes longer = whole;
  longer.push_back(std::byte{0});
  CHECK_FALSE(decode_traffic_lights(longer).has_value());
  Random random(5, 1);
  for (int i = 0; i < 2000; ++i) {
    Bytes altered = whole;
    altered[random.below(altered.size())] = static_cast<std::byte>(random.below(256));
    const auto read = decode_traffic_lights(altered);
    if (read) CHECK(read->size() <= most_traffic_lights);
  }
}

TEST_CASE("a snapshot without lights, or with damaged ones, has none") {
  Snapshot snapshot;
  CHECK(traffic_lights_of(snapshot).empty());
  EffectKeyframe keyframe{.id = traffic_light_effect_id, .kind = traffic_light_keyframe_kind};
  keyframe.data = encode_traffic_lights(two_lights());
  snapshot.effects.push_back(keyframe);
  CHECK(traffic_lights_of(snapshot).size() == 2);
  snapshot.effects[0].data.pop_back();
  CHECK(traffic_lights_of(snapshot).empty());
}

}  // namespace septet
