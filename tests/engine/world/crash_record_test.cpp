// A crash's record as text and back: nothing is lost, what was not measured stays missing, and altered text does no harm.

#include "engine/world/crash_record.hpp"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/world/solid.hpp"

#include "engine/core/random.hpp"
#include "tests/relative.hpp"

namespace septet {
namespace {

CrashRecord full_record() {
  CrashRecord crash;
  crash.tick = 720;
  crash.ticks = 9;
  crash.first = 1;
  crash.second = 3;
  crash.point_m = Vec3(812.5, -40.25, 0.5);
  crash.normal_rad = -0.75;
  crash.closing_speed_mps = 13.5;
  crash.sliding_mps = -2.25;
  crash.overlap_m = 1.25;
  crash.overlap_share = 0.625;
  crash.depth_m = 0.875;
  crash.of_first = {1752.0, 2900.0, 1.25, 0.5, Vec2(13.5, 0.0), 0.125, Vec2(-6.5, 0.25), -0.5, 0.0625, 0.375};
  crash.of_second = {1450.0, 2400.0, 1.5, 0.75, Vec2(0.0, 12.0), 0.0, Vec2(7.5, -0.25), 3.5, -1.5, 0.5};
  crash.ledger = CrashLedger{159651.0, 81920.0, 70000.0, 5000.0, 512.0, 2219.0};
  crash.pieces_kinetic_j = 640.0;
  crash.pulse_ns = {Vec2(100.0, -5.0), Vec2(2048.0, 64.0), Vec2(0.0, 0.0), Vec2(12.5, 0.25)};
  crash.is_unfinished = true;
  return crash;
}

}  // namespace

TEST_CASE("a record that is written as text and read again is the same") {
  const CrashRecord crash = full_record();
  const auto again = read_crash(crash.first, text_of(crash));
  REQUIRE(again.has_value());
  CHECK(*again == crash);
}

TEST_CASE("a record with a solid has its name, blanks and all, and only at its end") {
  CrashRecord crash = full_record();
  crash.stands = "stimuli/a wall depth_m=9";
  const auto again = read_crash(crash.first, text_of(crash));
  REQUIRE(again.has_value());
  CHECK(*again == crash);
  CHECK(read_crash(crash.first, text_of(full_record()) + " what=\"")->stands.empty());
}

TEST_CASE("a command that stands a solid tells its number and name, and others tell neither") {
  const auto named = named_solid("stand solid=3 x_m=1 height_m=2 name=\"stimuli/a wall\"");
  REQUIRE(named.has_value());
  CHECK(named->participant == first_solid_participant + 3);
  CHECK(named->name == "stimuli/a wall");
  for (const char* text : {"stand solid=3 x_m=1", "stand solid=64 x_m=1 name=\"a\"", "stand solid=x name=\"a\"",
                           "stand solid= name=\"a\"", "stand solid=3 name=\"", "stand solid=3 name=\"a",
                           "stand solid=3 x_m=1 name=\"\"", "clear solid=3 name=\"a\"", ""})
    CHECK_MESSAGE(!named_solid(text).has_value(), text);
}

TEST_CASE("what was not measured has no key, and is missing when it is read") {
  CrashRecord crash;
  crash.tick = 5;
  crash.first = 1;
  crash.stands = "guard rail";
  crash.closing_speed_mps = 4.0;
  const std::string text = text_of(crash);
  for (const char* key : {"delta_v", "mass", "crush", "ledger", "kinetic", "overlap", "depth", "unfinished", "pulse",
                          "with", "principal"})
    CHECK(text.find(key) == std::string::npos);
  const auto again = read_crash(1, text);
  REQUIRE(again.has_value());
  CHECK(*again == crash);
  CHECK_FALSE(impulse_ns(*again).has_value());
}

TEST_CASE("a record of another version, or without its place, is none") {
  const std::string text = text_of(full_record());
  CHECK_FALSE(read_crash(1, "version=2" + text.substr(9)).has_value());
  CHECK_FALSE(read_crash(1, "closing_speed_mps=8.00 delta_v_mps=3.00 by=driver").has_value());
  CHECK_FALSE(read_crash(1, "").has_value());
  std::string without = text;
  without.replace(without.find("point_y_m"), 9, "point_q_m");
  CHECK_FALSE(read_crash(1, without).has_value());
}

TEST_CASE("numbers that are none, or beyond all bounds, are missing, and a ledger counts whole or not at all") {
  const CrashRecord crash = full_record();
  for (const char* value : {"nan", "inf", "1e300", "", "7x", "--3"}) {
    std::string text = text_of(crash);
    const auto replace = [&](const std::string& key) {
      const std::size_t at = text.find(" " + key + "=") + key.size() + 2;
      text.replace(at, text.find(' ', at) - at, value);
    };
    for (const char* key : {"overlap_m", "its_crush_m", "delta_v_x_mps", "friction_j"}) replace(key);
    const auto read = read_crash(1, text);
    REQUIRE(read.has_value());
    CHECK_FALSE(read->overlap_m.has_value());
    CHECK_FALSE(read->of_second.crush_m.has_value());
    CHECK_FALSE(read->of_first.delta_v_mps.has_value());
    CHECK_FALSE(read->ledger.has_value());
    CHECK(read->of_second.delta_v_mps == crash.of_second.delta_v_mps);
  }
}

TEST_CASE("text with any byte altered, or cut off anywhere, is read with finite numbers or refused") {
  const std::string text = text_of(full_record());
  Random random(84);
  int read_again = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string altered = text;
    for (int i = 0; i < 3; ++i)
      altered[static_cast<std::size_t>(random.uniform() * static_cast<double>(text.size()))] =
          static_cast<char>(static_cast<unsigned char>(random.uniform() * 256.0));
    if (round % 4 == 0) altered.resize(static_cast<std::size_t>(random.uniform() * static_cast<double>(text.size())));
    const auto crash = read_crash(1, altered);
    if (!crash) continue;
    ++read_again;
    CHECK(std::isfinite(crash->point_m.x + crash->normal_rad + crash->closing_speed_mps));
    CHECK(crash->pulse_ns.size() <= most_pulse_ticks);
    CHECK(std::isfinite(impulse_ns(*crash).value_or(Vec2(0.0)).x));
    if (crash->ledger) CHECK(std::isfinite(share_missing(*crash->ledger)));
  }
  CHECK(read_again > 1000);
}

TEST_CASE("a ledger that closes misses nothing, and one that does not misses its share") {
  CrashLedger ledger{1000.0, 400.0, 500.0, 60.0, 10.0, 30.0};
  CHECK(share_missing(ledger) == 0.0);
  ledger.crush_j = 440.0;
  CHECK(share_missing(ledger) == relative(0.1, 1e-12));
}

}  // namespace septet
