#include "engine/world/limited_sight.hpp"

#include <algorithm>
#include <cmath>

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
  ParticipantId before = 0;
  for (const LimitedSight& sight : sights) {
    out.put_varint(sight.driver - before);
    out.put_varint(static_cast<std::uint64_t>(std::lround(10.0 * sight.seen_m)));
    before = sight.driver;
  }
  return bytes;
}

Expected<std::vector<LimitedSight>> decode_limited_sights(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != sights_version) in.fail();
  const std::uint64_t count = in.get_varint();
  if (count == 0 || count > most_sights) in.fail();
  std::vector<LimitedSight> sights;
  std::uint64_t driver = 0;
  for (std::uint64_t i = 0; in.ok() && i < count; ++i) {
    const std::uint64_t gap = in.get_varint(), tenths = in.get_varint();
    if ((gap == 0 && i > 0) || gap > 0xffffffffu || (driver += gap) > 0xffffffffu || tenths > most_tenths) in.fail();
    sights.push_back({static_cast<ParticipantId>(driver), 0.1 * static_cast<double>(tenths)});
  }
  if (!in.ok() || in.remaining() != 0)
    return failure("these are no drivers' sights", "limited sight keyframe",
                   "check that both programs are of the same build");
  return sights;
}

std::optional<double> limited_sight_m(const Snapshot& snapshot, ParticipantId driver) {
  const auto found = std::ranges::find(snapshot.effects, limited_sight_effect_id, &EffectKeyframe::id);
  if (found == snapshot.effects.end() || found->kind != limited_sight_keyframe_kind) return std::nullopt;
  const auto sights = decode_limited_sights(found->data);
  if (!sights) return std::nullopt;
  const auto own = std::ranges::find(*sights, driver, &LimitedSight::driver);
  if (own == sights->end()) return std::nullopt;
  return own->seen_m;
}

}  // namespace septet
