#pragma once
/// Guidance of the driver to a goal, as a snapshot carries it: two EffectKeyframes, present while somebody guides him.
///
/// `Guidance` is what he is told, renewed when its text changes; the route is what a simulated driver goes by, renewed
/// when another one is found. Written down in SNAPSHOT.md. Threads: none of its own.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

enum class Guided : std::uint8_t {
  straight_on,
  left,
  right,
  bear_left,  ///< At a fork of which both branches lead on.
  bear_right,
  turn_back,
  roundabout,
  keep_left,  ///< To a lane further left.
  keep_right,
  arrive,
  new_route,  ///< Off the route another one was found…
  no_way,     ///< …or there is none.
};
/// As events name it: "straight_on", ….
std::string_view name_of(Guided what);

struct GuidanceWord {
  Guided what = Guided::straight_on;
  bool now = false;       ///< Here; else soon. Of `arrive`: has arrived.
  std::uint8_t exit = 0;  ///< Of a roundabout, 1 the first; 0: it is not left.
  bool operator==(const GuidanceWord&) const = default;
};

struct Guidance {
  GuidanceWord next;             ///< The next turn, lanes left aside; `now` is false.
  std::uint32_t to_next_m = 0;   ///< In steps of 10 m.
  GuidanceWord told;             ///< Said last…
  std::uint32_t told_count = 0;  ///< …as this one; 0: nothing was said yet…
  Tick told_at = 0;              ///< …at this tick.
  bool operator==(const Guidance&) const = default;
};

/// A lane section of the route: its lane by which it is entered, and by which it is left.
struct GuidedSection {
  std::uint32_t road = 0, section = 0;
  std::int32_t enters = 0, leaves = 0;
  bool operator==(const GuidedSection&) const = default;
};
struct GuidedRoute {
  std::vector<GuidedSection> sections;
  double ends_m = 0.0;  ///< Where the goal lies on the last section, from where that is entered; whole centimetres.
  bool operator==(const GuidedRoute&) const = default;
};
inline constexpr std::size_t most_guided_sections = 4096;

inline constexpr std::uint16_t guidance_keyframe_kind = 11, guided_route_keyframe_kind = 12;
inline constexpr std::uint32_t guidance_effect_id = 0x04000004, guided_route_effect_id = 0x04000005;

Bytes encode_guidance(const Guidance& guidance);
Bytes encode_guided_route(const GuidedRoute& route);
/// Both refuse anything that their encoder would not write; safe on hostile bytes.
Expected<Guidance> decode_guidance(std::span<const std::byte> bytes);
Expected<GuidedRoute> decode_guided_route(std::span<const std::byte> bytes);
/// Empty where nobody guides, or the keyframe is damaged.
std::optional<Guidance> guidance_of(const Snapshot& snapshot);

}  // namespace septet
