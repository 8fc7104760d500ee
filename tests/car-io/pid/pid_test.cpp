#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/pid/pid_wheel.hpp"
#include "engine/core/random.hpp"
#include "tests/car-io/pid/simulated_pid_wheel.hpp"

namespace septet::car_io {
namespace {

std::span<const std::byte> descriptor() { return std::as_bytes(std::span(pid_wheel_descriptor)); }

PidReports reports() { return find_pid_reports(read_hid_fields(descriptor()).value()).value(); }

/// Access to a simulated wheel, by a clock set by the test.
struct Table {
  explicit Table(std::size_t room = 8) : wheel(room) {}
  SimulatedPidWheel wheel;
  double now_s = 0.0;
  bool is_there = true;

  std::unique_ptr<HidDevice> open() { return std::make_unique<Way>(*this); }

 private:
  struct Way final : HidDevice {
    explicit Way(Table& of) : table(of) {}
    Expected<std::optional<Bytes>> read_newest() override { return std::nullopt; }
    Expected<void> write(std::span<const std::byte> report) override {
      if (!table.is_there) return failure("writing failed: No such device", "HID device", "check the cable");
      table.wheel.take(report, table.now_s);
      return {};
    }
    Expected<Bytes> get_feature(std::uint8_t, std::size_t size) override {
      Bytes report = table.wheel.block_load();
      CHECK(size == report.size());
      return report;
    }
    Expected<void> send_feature(std::span<const std::byte> report) override { return write(report); }
    Table& table;
  };
};

}  // namespace

TEST_CASE("a descriptor's values lie where its maker has put them") {
  const PidReports found = reports();
  CHECK(found.effect.bytes() == 9);
  CHECK(found.condition->bytes() == 15);
  Bytes report = found.constant.empty();
  found.constant.set(report, pid::block_index, 3.0);
  found.constant.set_share(report, pid::magnitude, -0.5);
  CHECK(report == Bytes{std::byte{0x15}, std::byte{3}, std::byte{0x78}, std::byte{0xEC}});  // −5000.
  CHECK(found.constant.get(report, pid::magnitude) == -5000);
  found.constant.set_share(report, pid::magnitude, 7.0);
  CHECK(found.constant.get(report, pid::magnitude) == 10000);
  found.constant.set(report, pid::block_index, 300.0);
  CHECK(found.constant.get(report, pid::block_index) == 40);

  report = found.effect.empty();
  CHECK(found.effect.choose(report, pid::friction));
  CHECK(report[2] == std::byte{6});
  CHECK_FALSE(found.effect.choose(report, pid::page | 0x28));
  found.effect.set_seconds(report, pid::duration, 0.25);
  CHECK((report[3] == std::byte{250} && report[4] == std::byte{0}));
  found.effect.set(report, pid::direction_enable, 1.0);
  found.effect.set_part(report, pid::direction, 0.25);
  CHECK((report[7] == std::byte{2} && report[8] == std::byte{64}));
  CHECK(found.load.is_chosen(std::vector{std::byte{0x22}, std::byte{1}, std::byte{1}}, pid::load_success));
  CHECK_FALSE(found.load.is_chosen(std::vector{std::byte{0x22}, std::byte{1}, std::byte{2}}, pid::load_success));
  CHECK(found.load.get(std::vector{std::byte{0x22}}, pid::block_index) == std::nullopt);
}

TEST_CASE(
    "a wheel's motor pulls as it is told, with its own damper and friction, and lets go 250 ms after the last word") {
  Table table;
  {
    PidWheel motor(table.open(), reports());
    CHECK(motor.set_condition(PidCondition::damper, 0.1).value());
    CHECK(motor.set_condition(PidCondition::friction, 0.04).value());
    CHECK_FALSE(motor.set_condition(PidCondition::spring, 0.0).value());  // Not requested, not created.
    for (const double force : {0.25, -0.5, 1.0, 0.0, 0.75}) {
      CHECK(motor.set_force(force).value());
      CHECK(table.wheel.playing(1, table.now_s) == doctest::Approx(force));
      table.now_s += 0.01;
    }
    CHECK(table.wheel.playing(4, table.now_s) == doctest::Approx(0.1));
    CHECK(table.wheel.playing(6, table.now_s) == doctest::Approx(0.04));
    CHECK(motor.set_condition(PidCondition::spring, 0.3).value());
    CHECK(motor.set_condition(PidCondition::damper, 0.2).value());
    CHECK(motor.set_force(0.5).value());
    CHECK(table.wheel.playing(3, table.now_s) == doctest::Approx(0.3));
    CHECK(table.wheel.playing(4, table.now_s) == doctest::Approx(0.2));
    CHECK(table.wheel.effects() == 4);
    for (const int type : {1, 3, 4, 6}) {
      CHECK(table.wheel.playing(type, table.now_s + 0.249) != 0.0);
      CHECK(table.wheel.playing(type, table.now_s + 0.251) == 0.0);
    }
  }
  CHECK(table.wheel.playing(1, table.now_s) == 0.0);  // Left, it is at rest at once.
  CHECK(table.wheel.wrong() == 0);
}

TEST_CASE("a wheel without room for an effect drives without it and is asked once") {
  Table full(0);
  PidWheel motor(full.open(), reports());
  CHECK_FALSE(motor.set_force(0.5).value());
  CHECK_FALSE(motor.set_force(0.5).value());
  CHECK(full.wheel.effects() == 0);
  Table one(1);
  PidWheel other(one.open(), reports());
  CHECK(other.set_force(0.5).value());
  CHECK_FALSE(other.set_condition(PidCondition::damper, 0.1).value());
  CHECK(other.set_force(0.25).value());
  CHECK(one.wheel.playing(1, 0.0) == doctest::Approx(0.25));
}

TEST_CASE("a wheel that was pulled out is an error from every call") {
  Table table;
  PidWheel motor(table.open(), reports());
  REQUIRE(motor.set_force(0.5).value());
  table.is_there = false;
  CHECK_FALSE(motor.set_force(0.5).has_value());
  CHECK_FALSE(motor.set_condition(PidCondition::spring, 0.5).has_value());
}

TEST_CASE("a descriptor that is cut short or contradicts itself is refused with its place") {
  const auto what = [](std::vector<std::uint8_t> bytes) {
    const auto read = read_hid_fields(std::as_bytes(std::span(bytes)));
    return read ? std::string() : read.error().what;
  };
  CHECK(what({}).empty());
  CHECK(what({0x05}) == "it ends in the midst of an item");
  CHECK(what({0x27, 1, 2, 3}) == "it ends in the midst of an item");
  CHECK(what({0xa1, 0x01}) == "a collection does not end");
  CHECK(what({0xc0}) == "a collection ends that has not begun");
  CHECK(what({0x85, 0}) == "a report's id is not from 1 to 255");
  CHECK(what({0xb4}) == "it takes back what it has not kept");
  CHECK(what({0xfe, 0, 0}) == "it has a long item, of which there are none");
  CHECK(what({0x19, 9, 0x29, 3}) == "a range of usages has no end");
  CHECK(what({0x1b, 0, 0, 0, 0, 0x2b, 0xff, 0xff, 0xff, 0xff}) == "a range of usages has no end");
  CHECK(what({0x75, 64, 0x95, 1, 0x81, 2}) == "a value has more than 32 bits");
  CHECK(what({0x75, 8, 0x97, 0xff, 0xff, 0xff, 0xff, 0x81, 2}) == "a report is longer than 4096 bytes");
  CHECK(what(std::vector<std::uint8_t>(100, 0xa1)).empty() == false);
  CHECK(what(std::vector<std::uint8_t>(5000, 0)) == "it is longer than 4096 bytes");
  const auto error = read_hid_fields(descriptor().first(8)).error();
  CHECK(error.where == "HID report descriptor, byte 8");
}

TEST_CASE("no descriptor makes a report that is longer than it says, whatever of it is wrong") {
  Random random(17);
  int read = 0, usable = 0;
  for (int round = 0; round < 4000; ++round) {
    Bytes bytes(descriptor().begin(), descriptor().end());
    for (int change = 0; change <= round % 4; ++change)
      bytes[random.below(bytes.size())] = static_cast<std::byte>(random.below(256));
    const auto fields =
        read_hid_fields(std::span(bytes).first(round % 2 == 0 ? bytes.size() : random.below(bytes.size())));
    if (!fields) continue;
    ++read;
    const auto found = find_pid_reports(*fields);
    if (!found) continue;
    ++usable;
    Table table;
    PidWheel motor(table.open(), *found);
    if (found->load.bytes() != 3) continue;
    (void)motor.set_condition(PidCondition::spring, 0.5);
    (void)motor.set_force(-1.0);
    for (const double force : {-1.0, 1.0}) {
      Bytes report = found->constant.empty();
      found->constant.set_share(report, pid::magnitude, force);
      found->effect.set_part(report, pid::direction, 0.25);  // Of a report that is not its own.
      CHECK(report.size() == found->constant.bytes());
    }
  }
  CHECK(read > 200);
  CHECK(usable > 100);
}

}  // namespace septet::car_io
