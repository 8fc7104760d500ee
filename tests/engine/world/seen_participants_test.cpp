#include "engine/world/seen_participants.hpp"

#include <doctest/doctest.h>

namespace septet {

TEST_CASE(
    "those whom the driver sees come back from their bytes, also where there are none, and without them nothing is "
    "known") {
  for (const std::vector<ParticipantId>& seen : {std::vector<ParticipantId>{}, {2, 1000, 1001, 32768, 0xffffffff}}) {
    Snapshot snapshot;
    CHECK_FALSE(seen_by_driver(snapshot).has_value());
    snapshot.effects = {{seen_effect_id, seen_keyframe_kind, encode_seen(seen), 13}};
    REQUIRE(seen_by_driver(snapshot).has_value());
    CHECK(*seen_by_driver(snapshot) == seen);
  }
}

TEST_CASE("bytes that are no list of the seen are refused") {
  const Bytes good = encode_seen(std::vector<ParticipantId>{1, 300});
  REQUIRE(decode_seen(good).has_value());
  for (std::size_t cut = 0; cut < good.size(); ++cut) CHECK_FALSE(decode_seen(std::span(good).first(cut)).has_value());
  Bytes more = good, other = good;
  more.push_back(std::byte{0});
  other[0] = std::byte{9};
  for (const Bytes& bad : {more, other, encode_seen(std::vector<ParticipantId>{7, 7})})
    CHECK_FALSE(decode_seen(bad).has_value());
}

}  // namespace septet
