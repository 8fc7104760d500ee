#include "engine/world/traffic_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace septet {
namespace {

constexpr std::uint8_t version = 1;
constexpr double quanta_per_m = 1000.0, quanta_per_rad = 10000.0;
constexpr std::int64_t furthest = 1'000'000'000'000, most_heading = 40'000;
constexpr int first_lamp_bit = 10;
static_assert(static_cast<int>(Lamp::signal_red) == 1 << first_lamp_bit);

std::int64_t quantised(double value, double per_unit, std::int64_t most) {
  if (!(value == value)) return 0;
  const auto bound = static_cast<double>(most);
  return std::llround(std::clamp(value * per_unit, -bound, bound));
}

double heading_of(const RigidTransform& pose) {
  const Vec3 ahead = pose.orientation * Vec3(1.0, 0.0, 0.0);
  return std::atan2(ahead.y, ahead.x);
}

}  // namespace

Bytes encode_traffic_lights(std::span<const TrafficLight> lights) {
  lights = lights.first(std::min(lights.size(), most_traffic_lights));
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(version);
  out.put_varint(lights.size());
  for (const TrafficLight& light : lights) {
    out.put_varint(light.road);
    out.put_signed_varint(quantised(light.s_m, quanta_per_m, furthest));
    out.put(static_cast<std::uint8_t>((light.lamps.bits >> first_lamp_bit & 7) | (light.along_s ? 8 : 0) |
                                      (light.for_walkers ? 16 : 0)));
    for (int c = 0; c < 3; ++c)
      out.put_signed_varint(quantised(light.world_from_light.position_m[c], quanta_per_m, furthest));
    out.put_signed_varint(quantised(heading_of(light.world_from_light), quanta_per_rad, most_heading));
  }
  return bytes;
}

Expected<std::vector<TrafficLight>> decode_traffic_lights(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  const auto number = [&](double per_unit, std::int64_t most) {
    const std::int64_t value = in.get_signed_varint();
    if (value < -most || value > most) in.fail();
    return in.ok() ? static_cast<double>(value) / per_unit : 0.0;
  };
  if (in.get<std::uint8_t>() != version) in.fail();
  constexpr std::size_t bytes_each = 7;
  std::vector<TrafficLight> lights(in.get_count(std::min(most_traffic_lights, in.remaining() / bytes_each)));
  for (TrafficLight& light : lights) {
    const std::uint64_t road = in.get_varint();
    if (road > UINT32_MAX) in.fail();
    light.road = static_cast<std::uint32_t>(road);
    light.s_m = number(quanta_per_m, furthest);
    const auto bits = in.get<std::uint8_t>();
    if (bits >= 32) in.fail();
    light.lamps.bits = static_cast<std::uint16_t>((bits & 7) << first_lamp_bit);
    light.along_s = (bits & 8) != 0;
    light.for_walkers = (bits & 16) != 0;
    for (int c = 0; c < 3; ++c) light.world_from_light.position_m[c] = number(quanta_per_m, furthest);
    light.world_from_light.orientation = orientation_from_angles(number(quanta_per_rad, most_heading), 0.0, 0.0);
  }
  if (!in.ok() || !in.at_end())
    return failure("the bytes are of another kind, or damaged", "traffic light keyframe",
                   "send what the same version of Septet wrote");
  return lights;
}

std::vector<TrafficLight> traffic_lights_of(const Snapshot& snapshot) {
  const auto found = std::ranges::lower_bound(snapshot.effects, traffic_light_effect_id, {}, &EffectKeyframe::id);
  if (found == snapshot.effects.end() || found->id != traffic_light_effect_id ||
      found->kind != traffic_light_keyframe_kind)
    return {};
  auto lights = decode_traffic_lights(found->data);
  return lights ? std::move(*lights) : std::vector<TrafficLight>{};
}

}  // namespace septet
