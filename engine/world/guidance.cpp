#include "engine/world/guidance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/world/find_effect.hpp"

namespace septet {
namespace {

constexpr std::uint8_t guidance_version = 1, route_version = 1;
constexpr std::array<std::string_view, 12> names{"straight_on", "left",      "right",      "bear_left",
                                                 "bear_right",  "turn_back", "roundabout", "keep_left",
                                                 "keep_right",  "arrive",    "new_route",  "no_way"};
constexpr std::uint8_t most_exits = 99;
constexpr std::uint64_t most_distance_m = 1'000'000, most_lane = 1000;
constexpr std::uint64_t most_count = std::numeric_limits<std::uint32_t>::max();

void put_word(ByteWriter& out, const GuidanceWord& word) {
  out.put(static_cast<std::uint8_t>(word.what));
  out.put(static_cast<std::uint8_t>(word.now ? 1 : 0));
  out.put(word.exit);
}

GuidanceWord get_word(ByteReader& in) {
  GuidanceWord word;
  const auto what = in.get<std::uint8_t>(), now = in.get<std::uint8_t>();
  word.exit = in.get<std::uint8_t>();
  if (what >= names.size() || now > 1 || word.exit > most_exits) in.fail();
  word.what = in.ok() ? static_cast<Guided>(what) : Guided::straight_on;
  word.now = now == 1;
  return word;
}

std::int32_t get_lane(ByteReader& in) {
  const std::int64_t lane = in.get_signed_varint();
  if (lane < -static_cast<std::int64_t>(most_lane) || lane > static_cast<std::int64_t>(most_lane)) in.fail();
  return in.ok() ? static_cast<std::int32_t>(lane) : 0;
}

template <class What>
Expected<What> refused(const char* where) {
  return failure("this is no guidance", where, "check that both programs are of the same build");
}

}  // namespace

std::string_view name_of(Guided what) { return names[static_cast<std::size_t>(what)]; }

Bytes encode_guidance(const Guidance& guidance) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(guidance_version);
  put_word(out, guidance.next);
  out.put_varint(guidance.to_next_m);
  put_word(out, guidance.told);
  out.put_varint(guidance.told_count);
  out.put_varint(guidance.told_at);
  return bytes;
}

Expected<Guidance> decode_guidance(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != guidance_version) in.fail();
  Guidance guidance;
  guidance.next = get_word(in);
  const std::uint64_t to_next_m = in.get_varint();
  guidance.told = get_word(in);
  const std::uint64_t count = in.get_varint();
  guidance.told_at = in.get_varint();
  if (!in.ok() || in.remaining() != 0 || guidance.next.now || to_next_m > most_distance_m || count > most_count)
    return refused<Guidance>("guidance keyframe");
  guidance.to_next_m = static_cast<std::uint32_t>(to_next_m);
  guidance.told_count = static_cast<std::uint32_t>(count);
  return guidance;
}

Bytes encode_guided_route(const GuidedRoute& route) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(route_version);
  out.put_varint(static_cast<std::uint64_t>(std::llround(100.0 * route.ends_m)));
  out.put_varint(route.sections.size());
  for (const GuidedSection& section : route.sections) {
    out.put_varint(section.road);
    out.put_varint(section.section);
    out.put_signed_varint(section.enters);
    out.put_signed_varint(section.leaves);
  }
  return bytes;
}

Expected<GuidedRoute> decode_guided_route(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != route_version) in.fail();
  GuidedRoute route;
  const std::uint64_t ends_cm = in.get_varint();
  if (ends_cm > 100 * most_distance_m) in.fail();
  route.ends_m = 0.01 * static_cast<double>(ends_cm);
  const std::uint64_t count = in.get_varint();
  if (count == 0 || count > most_guided_sections || count > in.remaining()) in.fail();
  for (std::uint64_t i = 0; in.ok() && i < count; ++i) {
    GuidedSection& section = route.sections.emplace_back();
    const std::uint64_t road = in.get_varint(), number = in.get_varint();
    if (road > most_count || number > most_count) in.fail();
    section.road = static_cast<std::uint32_t>(road);
    section.section = static_cast<std::uint32_t>(number);
    section.enters = get_lane(in);
    section.leaves = get_lane(in);
  }
  if (!in.ok() || in.remaining() != 0) return refused<GuidedRoute>("guided route keyframe");
  return route;
}

std::optional<Guidance> guidance_of(const Snapshot& snapshot) {
  const EffectKeyframe* found = find_effect(snapshot, guidance_effect_id, guidance_keyframe_kind);
  if (!found) return std::nullopt;
  auto guidance = decode_guidance(found->data);
  if (!guidance) return std::nullopt;
  return *guidance;
}

}  // namespace septet
