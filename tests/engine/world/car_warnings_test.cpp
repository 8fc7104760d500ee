#include <doctest/doctest.h>

#include "engine/world/car_warnings.hpp"

namespace septet {

TEST_CASE("warning lamps come back from their keyframe, and anything else is refused") {
  for (int bits = 1; bits < 16; ++bits) {
    const CarWarnings warnings{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
    const auto read = decode_car_warnings(encode_car_warnings(warnings));
    REQUIRE(read.has_value());
    CHECK(*read == warnings);
    Snapshot snapshot;
    snapshot.effects.push_back({car_warning_effect_id, car_warning_keyframe_kind, encode_car_warnings(warnings), 0});
    CHECK(car_warnings_of(snapshot) == warnings);
  }
  for (const Bytes& bytes :
       {Bytes{}, Bytes{std::byte{1}}, Bytes{std::byte{1}, std::byte{0}}, Bytes{std::byte{1}, std::byte{16}},
        Bytes{std::byte{2}, std::byte{1}}, Bytes{std::byte{1}, std::byte{1}, std::byte{0}}})
    CHECK_FALSE(decode_car_warnings(bytes).has_value());
  CHECK(car_warnings_of({}) == CarWarnings{});
}

}  // namespace septet
