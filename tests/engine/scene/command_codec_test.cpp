#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "engine/scene/command_codec.hpp"
#include "engine/scene/command_validation.hpp"
#include "engine/scene/world_bounds.hpp"
#include "tests/engine/scene/sample_commands.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

Bytes bytes_of(const Command& command) {
  Bytes bytes;
  encode(command, bytes);
  return bytes;
}

}  // namespace

TEST_CASE("every kind of command comes back from its bytes") {
  std::set<std::size_t> kinds;
  for (const Command& command : sample_commands()) {
    CAPTURE(name_of(command));
    kinds.insert(command.index());
    const auto back = decode(bytes_of(command));
    REQUIRE(back.has_value());
    CHECK(*back == command);
  }
  CHECK(kinds.size() == std::variant_size_v<Command>);
}

TEST_CASE("the bytes of a transform are those of the specification") {
  const Bytes bytes = bytes_of(TransformSet{5, {{1.0, 0.0, 0.0}}});
  REQUIRE(bytes.size() == 1 + 1 + 24 + 1);
  CHECK(bytes[0] == std::byte{10});
  CHECK(bytes[1] == std::byte{6});     // Node + 1.
  CHECK(bytes[9] == std::byte{0x3f});  // Highest byte of 1.0.
  CHECK(bytes[26] == std::byte{0});    // Neither rotation nor scale.
}

TEST_CASE("a command that is cut anywhere is refused") {
  for (const Command& command : sample_commands()) {
    const Bytes whole = bytes_of(command);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      CAPTURE(name_of(command));
      CHECK_FALSE(decode(std::span(whole).first(size)).has_value());
    }
  }
}

TEST_CASE("bytes after a command are refused") {
  Bytes bytes = bytes_of(HideSet{1, true});
  bytes.push_back(std::byte{0});
  CHECK_FALSE(decode(bytes).has_value());
}

TEST_CASE("mutated bytes are refused or give a command that is written and read again alike") {
  Random random(1);
  const auto commands = sample_commands();
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = bytes_of(commands[random.below(commands.size())]);
    for (std::uint64_t changes = 1 + random.below(3); changes > 0; --changes)
      bytes[random.below(bytes.size())] = static_cast<std::byte>(random.below(256));
    const auto command = decode(bytes);
    if (!command) continue;
    ++accepted;
    const auto again = decode(bytes_of(*command));
    REQUIRE(again.has_value());
    CHECK(*again == *command);
  }
  CHECK(accepted > 100);
}

TEST_CASE("numbers that are not finite are refused") {
  CHECK_FALSE(decode(bytes_of(VerticesSet{1, 0, {{0, INFINITY, 0}}})).has_value());
  CHECK_FALSE(decode(bytes_of(TransformSet{1, {{NAN, 0.0, 0.0}}})).has_value());
  CHECK_FALSE(decode(bytes_of(TagSet{1, 0, 0, {"x", double{NAN}}})).has_value());
}

TEST_CASE("a place, size, speed or value beyond any world is refused with its bound and what to do") {
  const double infinite = std::numeric_limits<double>::infinity(), no_number = std::numeric_limits<double>::quiet_NaN();
  const auto why = [](const Command& command) {
    const auto valid = validate(command);
    const auto decoded = decode(bytes_of(command));
    CHECK(valid.has_value() == decoded.has_value());
    if (!valid) CHECK_FALSE(valid.error().remedy.empty());
    return valid ? std::string() : valid.error().what;
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  for (const double wrong : {1e9, -1e9, 1e300, infinite, no_number}) {
    CAPTURE(wrong);
    const auto real = static_cast<float>(wrong);
    CHECK(has(why(TransformSet{1, {{0.0, wrong, 0.0}}}), "more than 250,000 km"));
    CHECK(has(why(TransformSet{1, {{}, {1, 0, 0, 0}, {1.0f, 1.0f, real}}}), "a scale is over 10,000"));
    CHECK(has(why(MotionSet{1, {{wrong, 0, 0}, {1, 0, 0, 0}, {MotionLeg{}}}}), "more than 250,000 km"));
    CHECK(has(why(MotionSet{1, {{}, {1, 0, 0, 0}, {{0.0, {0, 0, wrong}, {}, {}}}}}), "faster than 10 km/s"));
    CHECK(has(why(MotionSet{1, {{}, {1, 0, 0, 0}, {{0.0, {}, {wrong, 0, 0}, {}}}}}), "accelerated by more"));
    CHECK(has(why(MotionSet{1, {{}, {1, 0, 0, 0}, {{0.0, {}, {}, {0, 0, wrong}}}}}), "turns by more"));
    CHECK(has(why(VerticesSet{1, 0, {{0, 0, 0}, {0, real, 0}}}), "a vertex lies more than 250,000 km"));
    CHECK(has(why(LayerRealsSet{1, 0, 0, {0.0f, 2.0f * real}}), "a value of a layer"));
    CHECK(has(why(GeometryLayerSet{1, 0, "n", LayerType::vertex_real, 0, 2.0f * real}), "a value of a layer"));
  }
  for (const double late : {2e9, -1.0, 1e300, infinite, no_number})
    CHECK(has(why(MotionSet{1, {{}, {1, 0, 0, 0}, {{late, {}, {}, {}}}}}), "between 0 and 1e9 s"));
  for (const double turn : {infinite, no_number, 1e300, 2.0})
    CHECK(has(why(TransformSet{1, {{}, {turn, 0.0, 0.0, 0.0}}}), "unit quaternion"));
  CHECK(why(TransformSet{1, {{farthest_m, -farthest_m, 0.0}, {1, 0, 0, 0}, glm::vec3(1e4f)}}).empty());
}

TEST_CASE("a motion whose legs lead out of the world, or out and back, is refused; its last leg goes on") {
  const auto is_valid = [](const std::vector<MotionLeg>& legs) {
    return validate(MotionSet{1, {{}, {1, 0, 0, 0}, legs}}).has_value();
  };
  CHECK(is_valid({{0.0, {1e4, 0, 0}, {}, {}}}));
  CHECK(is_valid({{10.0, {1e4, 0, 0}, {}, {}}, {2e4, {}, {}, {}}}));
  CHECK_FALSE(is_valid({{10.0, {1e4, 0, 0}, {}, {}}, {4e4, {}, {}, {}}}));
  // Slowed evenly, it is farthest after half of the time, 5e7 or 5e8 m out, and at its beginning after all of it.
  CHECK(is_valid({{0.0, {1e3, 0, 0}, {-0.01, 0, 0}, {}}, {2e5, {}, {}, {}}}));
  CHECK_FALSE(is_valid({{0.0, {1e4, 0, 0}, {-0.1, 0, 0}, {}}, {2e5, {}, {}, {}}}));
}

TEST_CASE("opcode 13 is of no command and those behind it stay what they were") {
  CHECK_FALSE(decode(Bytes{std::byte{13}, std::byte{2}, std::byte{1}}).has_value());
  CHECK(decode(Bytes{std::byte{14}, std::byte{2}, std::byte{1}}).value() == Command(HideSet{1, true}));
  CHECK(bytes_of(LinkDestroy{1, 2})[0] == std::byte{12});
  CHECK(bytes_of(HideSet{1, true})[0] == std::byte{14});
  CHECK(bytes_of(BitmapTilesSet{1, 0, 0, {}})[0] == std::byte{28});
}

TEST_CASE("a claimed length beyond the limit is refused before it is allocated") {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(std::uint8_t{18});  // Opcode of "vertices set".
  out.put_varint(2), out.put_varint(0), out.put_varint(std::uint64_t{1} << 40);
  CHECK_FALSE(decode(bytes).has_value());
}

TEST_CASE("vertices on a grid of a millimetre take less than half of their floats") {
  VerticesSet strip{1, 0, {}};
  for (int i = 0; i < 1000; ++i)
    strip.positions_m.push_back({i / 2 * 5.0f, i % 2 * 3.5f, std::nearbyint(std::sin(i * 0.01f) * 1024) / 1024});
  const Bytes bytes = bytes_of(strip);
  CHECK(bytes.size() < 1000 * 12 / 2);
  CHECK(std::get<VerticesSet>(*decode(bytes)).positions_m == strip.positions_m);
}
