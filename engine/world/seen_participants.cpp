#include "engine/world/seen_participants.hpp"

#include <algorithm>
#include <utility>

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
  ParticipantId before = 0;
  for (const ParticipantId id : seen) {
    out.put_varint(id - before);
    before = id;
  }
  return bytes;
}

Expected<std::vector<ParticipantId>> decode_seen(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  if (in.get<std::uint8_t>() != seen_version) in.fail();
  const std::uint64_t count = in.get_varint();
  if (count > most_seen) in.fail();
  std::vector<ParticipantId> seen;
  std::uint64_t id = 0;
  for (std::uint64_t i = 0; in.ok() && i < count; ++i) {
    const std::uint64_t gap = in.get_varint();
    if ((gap == 0 && i > 0) || gap > 0xffffffffu || (id += gap) > 0xffffffffu) in.fail();
    seen.push_back(static_cast<ParticipantId>(id));
  }
  if (!in.ok() || in.remaining() != 0)
    return failure("this is no list of those whom the driver sees", "keyframe of the seen",
                   "check that both programs are of the same build");
  return seen;
}

std::optional<std::vector<ParticipantId>> seen_by_driver(const Snapshot& snapshot) {
  const auto found = std::ranges::find(snapshot.effects, seen_effect_id, &EffectKeyframe::id);
  if (found == snapshot.effects.end() || found->kind != seen_keyframe_kind) return std::nullopt;
  auto seen = decode_seen(found->data);
  if (!seen) return std::nullopt;
  return std::move(*seen);
}

}  // namespace septet
