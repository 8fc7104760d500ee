#include "engine/world/limited_sight.hpp"

#include <doctest/doctest.h>

namespace septet {

TEST_CASE("limited sights come back from their bytes to the decimetre, each driver's own") {
  const std::vector<LimitedSight> sights{{1, 0.0}, {1000, 33.4}, {1007, 199.9}};
  Snapshot snapshot;
  snapshot.effects = {{limited_sight_effect_id, limited_sight_keyframe_kind, encode_limited_sights(sights), 30}};
  for (const LimitedSight& sight : sights)
    CHECK(*limited_sight_m(snapshot, sight.driver) == doctest::Approx(sight.seen_m));
  CHECK_FALSE(limited_sight_m(snapshot, 2).has_value());
  CHECK_FALSE(limited_sight_m(Snapshot{}, 1).has_value());
}

TEST_CASE("bytes that are no limited sights are refused") {
  const Bytes good = encode_limited_sights(std::vector<LimitedSight>{{1, 20.0}, {5, 30.0}});
  REQUIRE(decode_limited_sights(good).has_value());
  for (std::size_t cut = 0; cut < good.size(); ++cut)
    CHECK_FALSE(decode_limited_sights(std::span(good).first(cut)).has_value());
  Bytes more = good, far = encode_limited_sights(std::vector<LimitedSight>{{1, 200.1}}),
        twice = encode_limited_sights(std::vector<LimitedSight>{{1, 20.0}, {1, 20.0}});
  more.push_back(std::byte{0});
  for (const Bytes& bad : {more, far, twice, encode_limited_sights({})})
    CHECK_FALSE(decode_limited_sights(bad).has_value());
}

}  // namespace septet
