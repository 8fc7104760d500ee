// Lists of members: saved, hashed, and neither.
#include "engine/core/archive.hpp"

#include <algorithm>

#include <doctest/doctest.h>

namespace septet {
namespace {

struct Inner {
  double a = 1.0;
  bool b = false;
};
SEPTET_MEMBERS(Inner, a, b)

struct Outer {
  int first = 1;
  int hint = 2;
  int picture = 3;
  std::vector<Inner> inner{{}, {}};
  std::optional<double> last;
};
SEPTET_MEMBER_GROUPS(Outer, hashed(first), kept(hint), left_out(picture), hashed(inner, last))

std::uint64_t hash_of(const Outer& outer) {
  StateHash hash;
  hash_members(hash, outer);
  return hash.value();
}

Bytes bytes_of(const Outer& outer) {
  Bytes bytes;
  StateWriter writer(bytes);
  transfer(writer, outer);
  return bytes;
}

Outer changed(void (*change)(Outer&)) {
  Outer outer;
  change(outer);
  return outer;
}

}  // namespace

TEST_CASE("every member that is not said to be otherwise is hashed and kept") {
  const Outer before;
  for (const auto change :
       {+[](Outer& o) { o.first = 5; }, +[](Outer& o) { o.inner[1].a = 5.0; }, +[](Outer& o) { o.inner[0].b = true; },
        +[](Outer& o) { o.inner.pop_back(); }, +[](Outer& o) { o.last = 0.0; }}) {
    const Outer after = changed(change);
    CHECK(hash_of(after) != hash_of(before));
    CHECK(bytes_of(after) != bytes_of(before));
  }
}

TEST_CASE("what is kept is in the bytes and not in the hash, and what is left out in neither") {
  const Outer before;
  const Outer other_hint = changed([](Outer& o) { o.hint = 5; });
  const Outer other_picture = changed([](Outer& o) { o.picture = 5; });
  CHECK(hash_of(other_hint) == hash_of(before));
  CHECK(bytes_of(other_hint) != bytes_of(before));
  CHECK(hash_of(other_picture) == hash_of(before));
  CHECK(bytes_of(other_picture) == bytes_of(before));
}

TEST_CASE("what was kept comes back, and what was left out stays as it is") {
  const Outer before = changed([](Outer& o) {
    o.hint = 7;
    o.picture = 8;
    o.inner = {{2.5, true}};
    o.last = -1.0;
  });
  const Bytes bytes = bytes_of(before);
  StateReader reader(bytes);
  Outer after;
  transfer(reader, after);
  CHECK(reader.ok());
  CHECK(reader.remaining() == 0);
  CHECK(after.hint == 7);
  CHECK(after.picture == 3);
  CHECK(bytes_of(after) == bytes);
  CHECK(hash_of(after) == hash_of(before));
}

TEST_CASE("random numbers go on from a state, but not from the one in which they would all be zero") {
  Random random(5, 2);
  random.normal();
  auto same = Random::from_state(random.state());
  REQUIRE(same.has_value());
  for (int i = 0; i < 5; ++i) CHECK(same->next_bits() == random.next_bits());
  CHECK_FALSE(Random::from_state({}).has_value());

  Random restored(1);
  Bytes bytes(sizeof(Random::State));
  StateReader zeros(bytes);
  transfer(zeros, restored);
  CHECK_FALSE(zeros.ok());
  bytes.clear();
  StateWriter writer(bytes);
  transfer(writer, std::as_const(random));
  StateReader reader(bytes);
  transfer(reader, restored);
  CHECK(reader.ok());
  CHECK(restored.next_bits() == random.next_bits());
}

TEST_CASE("bytes are hashed whole, however many they are and wherever they end") {
  std::vector<std::uint64_t> seen;
  std::string text;
  for (int length = 0; length < 40; ++length, text += 'a') {
    StateHash hash;
    hash_members(hash, text);
    seen.push_back(hash.value());
  }
  std::ranges::sort(seen);
  CHECK(std::ranges::adjacent_find(seen) == seen.end());
}

}  // namespace septet
