#include "engine/world/limited_sight.hpp"

#include <algorithm>
#include <cmath>

#include "engine/world/ascending_ids.hpp"
#include "engine/world/find_effect.hpp"

namespace septet {
namespace {

constexpr std::uint8_t sights_version = 1;
constexpr std::size_t most_sights = 4096;
constexpr auto most_tenths = static_cast<std::uint64_t>(10.0 * farthest_sight_m);

}  // namespace

Bytes encode_limited_sights(std::span<const LimitedSight> sights) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(sights_version);
  out.put_varint(sights.size());
  AscendingIdWriter drivers;
  for (const LimitedSight& sight : sights) {
    drivers.put(sight.driver, out);
    out.put_varint(static_cast<std::uint64_t>(std::lround(10.0 * sight.seen_m)));
  }
  return bytes;
}

Expected<std::vector<LimitedSight>> decode_limited_sights(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != sights_version) in.fail();
  const std::uint64_t count = in.get_varint();
  if (count == 0 || count > most_sights) in.fail();
  std::vector<LimitedSight> sights;
  AscendingIdReader drivers;
  for (std::uint64_t i = 0; in.ok() && i < count; ++i) {
    const ParticipantId driver = drivers.get(in);
    const std::uint64_t tenths = in.get_varint();
    if (tenths > most_tenths) in.fail();
    sights.push_back({driver, 0.1 * static_cast<double>(tenths)});
  }
  if (!in.ok() || in.remaining() != 0)
    return failure("these are no drivers' sights", "limited sight keyframe",
                   "check that both programs are of the same build");
  return sights;
}

std::optional<double> limited_sight_m(const Snapshot& snapshot, ParticipantId driver) {
  const EffectKeyframe* found = find_effect(snapshot, limited_sight_effect_id, limited_sight_keyframe_kind);
  if (!found) return std::nullopt;
  const auto sights = decode_limited_sights(found->data);
  if (!sights) return std::nullopt;
  const auto own = std::ranges::find(*sights, driver, &LimitedSight::driver);
  if (own == sights->end()) return std::nullopt;
  return own->seen_m;
}

}  // namespace septet
