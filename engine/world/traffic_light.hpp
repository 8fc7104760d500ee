#pragma once
/// The lights of a road's signals in a snapshot: place of each head, the traffic it applies to, its lit lamps.
///
/// All of them are one EffectKeyframe, renewed when a lamp changes, so that screens, logs and drivers see the same.
/// Written down in SNAPSHOT.md. Threads: none of its own.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/world/lamps.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

struct TrafficLight {
  std::uint32_t road = 0;  ///< Index in the road network.
  double s_m = 0.0;        ///< Station of the signal.
  bool along_s = true;     ///< Applies to traffic towards increasing s.
  bool for_walkers = false;
  RigidTransform world_from_light;  ///< x along the direction of the traffic it applies to; the lower edge of the head.
  Lamps lamps;                      ///< signal_red, signal_amber, signal_green.
};

inline constexpr std::uint16_t traffic_light_keyframe_kind = 6;
inline constexpr std::uint32_t traffic_light_effect_id = 0x04000000;
/// Limit of the lights sent.
inline constexpr std::size_t most_traffic_lights = 512;

/// Positions to the millimetre, headings to a ten-thousandth of a radian.
Bytes encode_traffic_lights(std::span<const TrafficLight> lights);
/// Refuses anything that `encode_traffic_lights` would not write; safe on hostile bytes.
Expected<std::vector<TrafficLight>> decode_traffic_lights(std::span<const std::byte> bytes);
/// Lights of a snapshot; empty if it has none, or damaged ones.
std::vector<TrafficLight> traffic_lights_of(const Snapshot& snapshot);

}  // namespace septet
