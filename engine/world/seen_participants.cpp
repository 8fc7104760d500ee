#include "engine/world/seen_participants.hpp"

#include <utility>

#include "engine/world/ascending_ids.hpp"
#include "engine/world/find_effect.hpp"

namespace septet {
namespace {

constexpr std::uint8_t seen_version = 1;
constexpr std::size_t most_seen = 65536;

}  // namespace

Bytes encode_seen(std::span<const ParticipantId> seen) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(seen_version);
  out.put_varint(seen.size());
  AscendingIdWriter ids;
  for (const ParticipantId id : seen) ids.put(id, out);
  return bytes;
}

Expected<std::vector<ParticipantId>> decode_seen(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != seen_version) in.fail();
  const std::uint64_t count = in.get_varint();
  if (count > most_seen) in.fail();
  std::vector<ParticipantId> seen;
  AscendingIdReader ids;
  for (std::uint64_t i = 0; in.ok() && i < count; ++i) seen.push_back(ids.get(in));
  if (!in.ok() || in.remaining() != 0)
    return failure("this is no list of those whom the driver sees", "keyframe of the seen",
                   "check that both programs are of the same build");
  return seen;
}

std::optional<std::vector<ParticipantId>> seen_by_driver(const Snapshot& snapshot) {
  const EffectKeyframe* found = find_effect(snapshot, seen_effect_id, seen_keyframe_kind);
  if (!found) return std::nullopt;
  auto seen = decode_seen(found->data);
  if (!seen) return std::nullopt;
  return std::move(*seen);
}

}  // namespace septet
