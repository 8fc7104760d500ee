#include <linux/input.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/games/force_effects.hpp"
#include "car-io/games/game_drive.hpp"
#include "car-io/games/telemetry.hpp"
#include "car-io/games/uinput_wheel.hpp"
#include "engine/core/bytes.hpp"
#include "engine/core/random.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::car_io {
namespace {

/// A datagram that is written as the game's C structure lies in memory.
class Datagram {
 public:
  explicit Datagram(std::size_t size) : bytes_(size) {}
  template <class T>
  Datagram& put(std::size_t at, T value) {
    std::memcpy(bytes_.data() + at, &value, sizeof value);
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

const TelemetryFormat& format(const char* name) { return **find_telemetry_format(name); }

Bytes outgauge(float speed_mps, float rpm, std::uint32_t lamps = 0) {
  return Datagram(96)
      .put(10, std::uint8_t{4})
      .put(12, speed_mps)
      .put(16, rpm)
      .put(24, 88.0f)
      .put(28, 0.5f)
      .put(44, lamps)
      .put(48, 0.75f)
      .put(52, 0.25f)
      .bytes();
}

CarReading reading(double wheel_rad = 0.0) {
  CarReading reading;
  reading.input.steering_wheel_rad = wheel_rad;
  reading.is_connected = true;
  return reading;
}

}  // namespace

TEST_CASE("OutGauge, OutSim and Codemasters' packets are read where their structures have them") {
  const auto gauge = decode_telemetry(format("outgauge"), outgauge(25.0f, 3000.0f, 1u << 5 | 1u << 10), {});
  REQUIRE(gauge);
  CHECK(gauge->speed_mps == 25.0);
  CHECK(gauge->engine_rpm == 3000.0);
  CHECK(gauge->gear == 3.0);
  CHECK(gauge->accelerator == 0.75);
  CHECK(gauge->brake == 0.25);
  CHECK(gauge->indicator_left == 1.0);
  CHECK(gauge->indicator_right == 0.0);
  CHECK(gauge->anti_lock == 1.0);
  const Instruments shown = instruments_of(*gauge);
  CHECK(shown.speed_kmh == 90.0);
  CHECK(shown.fuel_percent == 50.0);
  CHECK(shown.coolant_temperature_c == 88.0);
  const auto both = decode_telemetry(format("outsim"), Datagram(64).put(36, 9.5f).bytes(), *gauge);
  REQUIRE(both);
  CHECK(both->vertical_mps2 == 9.5);
  CHECK(both->speed_mps == 25.0);
  const auto rally = decode_telemetry(
      format("codemasters"), Datagram(264).put(4 * 7, 31.0f).put(4 * 33, 2.0f).put(4 * 37, 512.0f).bytes(), {});
  REQUIRE(rally);
  CHECK(rally->speed_mps == 31.0);
  CHECK(rally->gear == 2.0);
  CHECK(rally->engine_rpm == 5120.0);
}

TEST_CASE("Codemasters' gear 10 is reverse, as -1 is, and 0 is neutral") {
  const auto gear = [](float sent) {
    return decode_telemetry(format("codemasters"), Datagram(264).put(4 * 33, sent).bytes(), {}).value().gear;
  };
  CHECK(gear(10.0f) == -1.0);
  CHECK(gear(-1.0f) == -1.0);
  CHECK(gear(0.0f) == 0.0);
  CHECK(gear(6.0f) == 6.0);
}

TEST_CASE("a format of one's own says which numbers of the datagram mean reverse and neutral") {
  const auto forza = [](const char* gear) {
    return read_telemetry_format(
        std::string("least_bytes = 324\nmost_bytes = 324\n[fields.gear]\nbyte = 307\ntype = \"u8\"\n") + gear,
        "forza.toml");
  };
  const auto gear = [&](const char* keys, std::uint8_t sent) {
    return decode_telemetry(forza(keys).value(), Datagram(324).put(307, sent).bytes(), {}).value().gear;
  };
  constexpr const char* keys = "reverse = 0\nneutral = 11\n";
  CHECK(gear(keys, 0) == -1.0);
  CHECK(gear(keys, 11) == 0.0);
  CHECK(gear(keys, 1) == 1.0);
  CHECK(gear(keys, 6) == 6.0);
  CHECK(gear("", 0) == 0.0);
  // A game that counts from one more names its numbers as sent, before any offset.
  CHECK(gear("offset = -1\nreverse = 0\n", 0) == -1.0);
  CHECK(gear("offset = -1\nreverse = 255\n", 255) == -1.0);
  CHECK(gear("offset = -1\nreverse = 255\n", 1) == 0.0);
  CHECK(gear("scale = 0.5\nneutral = 7\n", 7) == 0.0);
  CHECK_FALSE(forza("reverse = 3\nneutral = 3\n").has_value());
  CHECK_FALSE(forza("reverse = \"R\"\n").has_value());
  CHECK_FALSE(read_telemetry_format("[fields.speed_mps]\nbyte = 0\nreverse = 0\n", "speed.toml").has_value());
}

TEST_CASE("a datagram of another length or with a number that is none changes nothing") {
  for (const std::size_t size : {0u, 1u, 91u, 97u, 1500u})
    CHECK_FALSE(decode_telemetry(format("outgauge"), Bytes(size), {}).has_value());
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -3e30f})
    CHECK_FALSE(decode_telemetry(format("outgauge"), outgauge(bad, 1000.0f), {}).has_value());
  GameDrive drive({}, 7.85);
  drive.receive(format("outgauge"), outgauge(25.0f, 3000.0f), 1.0);
  for (int i = 0; i < 1000; ++i) drive.receive(format("outgauge"), Bytes(static_cast<std::size_t>(i % 90)), 1.0);
  CHECK(drive.refused_datagrams() == 1000);
  CHECK(drive.take_messages().size() == 1);
  CHECK(drive.instruments(1.1)->speed_kmh == 90.0);
}

TEST_CASE("any other format is a TOML file, whose mistakes are told by their place") {
  const auto own = read_telemetry_format(
      "name = \"mine\"\nleast_bytes = 8\nmost_bytes = 8\nbyte_order = \"big\"\nport = 4444\n"
      "[fields.speed_mps]\nbyte = 2\ntype = \"u16\"\nscale = 0.01\n"
      "[fields.indicator_left]\nbyte = 7\ntype = \"u8\"\nbit = 3\n",
      "mine.toml");
  REQUIRE_MESSAGE(own.has_value(), why_not(own));
  const auto read = decode_telemetry(
      *own, Datagram(8).put(2, std::uint8_t{0x0a}).put(3, std::uint8_t{0x28}).put(7, std::uint8_t{8}).bytes(), {});
  REQUIRE(read);
  CHECK(read->speed_mps == doctest::Approx(26.0));
  CHECK(read->indicator_left == 1.0);
  CHECK(own->port == 4444);
  for (const char* wrong :
       {"", "name = 3", "[fields]", "[fields.speed_mps]\nbyte = 65507\n", "[fields.altitude]\nbyte = 0\n",
        "[fields.speed_mps]\nbyte = 0\ntype = \"f16\"\n", "[fields.speed_mps]\nbyte = 0\ntype = \"u8\"\nbit = 8\n",
        "least_bytes = 9\nmost_bytes = 8\n[fields.speed_mps]\nbyte = 0\n", "speed = 1\n[fields.speed_mps]\nbyte = 0\n"})
    CHECK_MESSAGE(!read_telemetry_format(wrong, "mine.toml").has_value(), wrong);
}

TEST_CASE("a field without its byte is refused with line and column") {
  const auto read =
      read_telemetry_format("[fields.engine_rpm]\nbyte = 4\n[fields.speed_mps]\ntype = \"f32\"\n", "mine.toml");
  REQUIRE_FALSE(read.has_value());
  CHECK(read.error().what == "speed_mps has no byte");
  CHECK(read.error().where.starts_with("mine.toml:3:"));
}

TEST_CASE("braking is no blow where another format's datagrams come between those that tell the speed, and a wall is") {
  for (const bool hits : {false, true}) {
    CAPTURE(hits);
    GameDrive drive({}, 7.85);
    double most = 0.0, calm = 0.0, speed_mps = 40.0;
    for (int ms = 0; ms < 3000; ++ms) {
      const double now_s = 0.001 * ms;
      if (ms % 20 == 0) drive.receive(format("outsim"), Datagram(64).put(36, 0.5f).bytes(), now_s);
      if (ms % 20 == 2) {
        if (ms > 1500) speed_mps = std::max(speed_mps - (hits && ms < 1600 ? 3.0 : 8.0 * 0.02), 0.0);
        drive.receive(format("outgauge"), outgauge(static_cast<float>(speed_mps), 3000.0f), now_s);
      }
      const double vibration = drive.actuate(reading(), {}, now_s).vibration;
      (ms <= 1500 ? calm : most) = std::max(ms <= 1500 ? calm : most, vibration);
    }
    CHECK((most > 1.2 * calm) == hits);
  }
}

TEST_CASE("a kerb ends though the speed goes on where the format that told of it is silent") {
  GameDrive drive({}, 7.85);
  Actuators told;
  const auto run = [&](int from_ms, int to_ms, float vertical_mps2) {
    for (int ms = from_ms; ms < to_ms; ++ms) {
      drive.receive(format("outgauge"), outgauge(25.0f, 3000.0f), 0.001 * ms);
      if (vertical_mps2 > 0.0f)
        drive.receive(format("outsim"), Datagram(64).put(36, vertical_mps2).bytes(), 0.001 * ms);
      told = drive.actuate(reading(), {}, 0.001 * ms);
    }
  };
  run(0, 2000, 0.1f);
  const double calm = told.vibration;
  run(2000, 2200, 30.0f);
  CHECK(told.vibration > 1.2 * calm);
  run(2200, 4200, 0.0f);
  CHECK(told.vibration == doctest::Approx(calm));
}

TEST_CASE("a game whose speed falls silent is silent though another format goes on") {
  GameDrive drive({.fan_full_speed_mps = 50.0, .fan_least = 0.2}, 7.85);
  Actuators told;
  const auto run = [&](int from_ms, int to_ms, bool tells_speed) {
    for (int ms = from_ms; ms < to_ms; ms += 10) {
      if (tells_speed) drive.receive(format("outgauge"), outgauge(25.0f, 3000.0f), 0.001 * ms);
      drive.receive(format("outsim"), Datagram(64).put(36, 0.5f).bytes(), 0.001 * ms);
      told = drive.actuate(reading(), {}, 0.001 * ms);
    }
  };
  run(0, 2000, true);
  CHECK(told.fan == doctest::Approx(0.6));
  run(2000, 2420, false);
  CHECK(told.fan == 0.0);
  CHECK(told.vibration == 0.0);
  CHECK_FALSE(drive.instruments(2.42).has_value());
}

TEST_CASE("a lost CAN bus cuts a game's fan and force with its reason, and nobody re-arms before it is back") {
  GameDrive drive({.fan_full_speed_mps = 50.0, .fan_least = 0.2}, 7.85);
  Actuators told;
  double now_s = 0.0;
  bool is_lost = false;
  const auto run = [&](double seconds) {
    for (const double end_s = now_s + seconds; now_s < end_s; now_s += 0.01) {
      drive.receive(format("outgauge"), outgauge(25.0f, 3000.0f), now_s);
      drive.set_bus_lost(is_lost);
      told = drive.actuate(reading(), {}, now_s);
    }
  };
  run(2.0);
  CHECK(told.fan == doctest::Approx(0.6));
  is_lost = true;
  run(0.22);
  CHECK(told.fan == 0.0);
  const auto why = drive.take_messages();
  REQUIRE(why.size() == 1);
  CHECK(why[0].find("the CAN bus is lost") != std::string::npos);
  drive.rearm();
  run(1.0);
  CHECK(told.fan == 0.0);
  CHECK(drive.take_messages() == std::vector<std::string>{"not re-armed: the CAN bus is still lost"});
  is_lost = false;
  run(1.0);
  CHECK(told.fan == 0.0);
  drive.rearm();
  run(2.0);
  CHECK(told.fan == doctest::Approx(0.6));
}

TEST_CASE("fan and shaker follow a game's telemetry and rest 200 ms after its last word, with the cluster") {
  GameDrive drive({.fan_full_speed_mps = 50.0, .fan_least = 0.2}, 7.85);
  const ForceEffects none;
  double now_s = 0.0;
  Actuators told;
  const auto run = [&](double seconds, bool talks) {
    for (const double end_s = now_s + seconds; now_s < end_s; now_s += 0.01) {
      if (talks) drive.receive(format("outgauge"), outgauge(25.0f, 3000.0f), now_s);
      told = drive.actuate(reading(), none, now_s);
    }
  };
  run(2.0, true);
  CHECK(told.fan == doctest::Approx(0.6));
  CHECK(told.vibration > 0.05);
  CHECK(told.vibration_hz == doctest::Approx(100.0));  // A four-cylinder's second order at 3000 a minute.
  CHECK(drive.instruments(now_s).has_value());
  run(0.15, false);
  CHECK(told.fan == doctest::Approx(0.6));
  run(0.27, false);
  CHECK(told.fan == 0.0);
  CHECK(told.vibration == 0.0);
  CHECK_FALSE(drive.instruments(now_s).has_value());
  run(1.5, true);
  CHECK(told.fan == doctest::Approx(0.6));
}

TEST_CASE("a game that hangs leaves no force on the wheel where it has told anything, and the end of the way stays") {
  ForceEffects effects;
  effects.load(0, {.kind = ForceKind::constant, .level = 1.0});
  effects.play(0, 1, 0.0);
  for (const bool tells : {true, false}) {
    CAPTURE(tells);
    GameDrive drive({.steering_most = 1.0}, 7.85);
    Actuators told;
    double now_s = 0.0;
    const auto run = [&](double seconds, bool talks, double wheel_rad = 0.0) {
      for (const double end_s = now_s + seconds; now_s < end_s; now_s += 0.01) {
        if (talks) drive.receive(format("outgauge"), outgauge(25.0f, 3000.0f), now_s);
        told = drive.actuate(reading(wheel_rad), effects, now_s);
      }
    };
    run(2.0, tells);
    CHECK(told.steering == doctest::Approx(1.0));
    run(0.42, false);
    CHECK(told.steering == (tells ? 0.0 : doctest::Approx(1.0)));
    run(0.2, false, 7.85);
    CHECK(told.steering == doctest::Approx(-1.0));
    run(1.2, tells);
    CHECK(told.steering == doctest::Approx(1.0));
  }
}

TEST_CASE(
    "two senders, and a hundred thousand datagrams of anything, move nothing beyond the rig's limits, and then all "
    "rests") {
  const rig::CarActuators limits{.fan_full_speed_mps = 50.0, .fan_least = 0.2, .steering_most = 0.5};
  GameDrive drive(limits, 7.85);
  const ForceEffects none;
  Random random(17);
  Actuators told, most;
  double now_s = 0.0;
  const auto step = [&] {
    told = drive.actuate(reading(), none, now_s);
    for (const double value : {told.fan, told.vibration, told.vibration_hz, told.steering})
      REQUIRE(std::isfinite(value));
    most.fan = std::max(most.fan, told.fan);
    most.vibration = std::max(most.vibration, told.vibration);
    REQUIRE(told.vibration_hz <= 200.0);
    now_s += 0.01;
  };
  for (int i = 0; i < 200; ++i) {
    drive.receive(format("outgauge"), outgauge(0.0f, 900.0f), now_s);
    drive.receive(format("outgauge"), outgauge(90.0f, 9000.0f), now_s);
    step();
  }
  for (int i = 0; i < 100'000; ++i) {
    const auto& known = known_telemetry_formats()[random.next_bits() % known_telemetry_formats().size()];
    // Half of them of the length that the format has.
    Bytes bytes(random.next_bits() % 2 == 0 ? known.least_bytes : random.next_bits() % 300);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.next_bits());
    drive.receive(known, bytes, now_s);
    if (i % 10 == 0) step();
    if (const auto shown = drive.instruments(now_s)) REQUIRE(std::isfinite(shown->speed_kmh));
  }
  CHECK(drive.refused_datagrams() > 10'000);
  CHECK(most.fan <= 1.0);
  CHECK(most.vibration <= limits.vibration_most);
  for (int i = 0; i < 42; ++i) step();
  CHECK(told.fan == 0.0);
  CHECK(told.vibration == 0.0);
}

TEST_CASE("a game's shaking counts to the day's dose, which cuts the shaker and nothing else") {
  GameDrive drive({.fan_full_speed_mps = 50.0, .vibration_full_mps2 = 100.0, .vibration_dose_mps2 = 0.02}, 7.85);
  Actuators told;
  double now_s = 0.0, shaken_s = 0.0;
  std::size_t messages = 0;
  for (; now_s < 20.0; now_s += 0.01) {
    drive.receive(format("outgauge"), outgauge(25.0f, 3000.0f), now_s);
    told = drive.actuate(reading(), {}, now_s);
    if (told.vibration > 0.0) shaken_s = now_s;
    messages += drive.take_messages().size();
  }
  CHECK(shaken_s > 0.2);
  CHECK(shaken_s < 19.0);
  CHECK(told.vibration == 0.0);
  CHECK(told.fan > 0.2);
  CHECK(messages == 1);
}

TEST_CASE("an emergency stop cuts a game's force at once and it waits for the re-arm button") {
  GameDrive drive({.steering_most = 0.5}, 7.85);
  ForceEffects effects;
  effects.load(0, {.kind = ForceKind::constant, .level = 1.0});
  effects.play(0, 1, 0.0);
  double now_s = 0.0;
  Actuators told;
  CarReading car = reading();
  const auto run = [&](double seconds) {
    for (const double end_s = now_s + seconds; now_s < end_s; now_s += 0.005) told = drive.actuate(car, effects, now_s);
  };
  run(0.09);
  CHECK(is_rest(told));  // Which arms the device.
  run(1.2);
  CHECK(told.steering == doctest::Approx(0.5));
  car.switches.emergency_stop = true;
  now_s += 0.005;
  told = drive.actuate(car, effects, now_s);
  CHECK(told.steering == 0.0);
  CHECK_FALSE(is_rest(told));  // Otherwise the writer would be re-armed.
  car.switches.emergency_stop = false;
  run(2.0);
  CHECK(told.steering == 0.0);
  car.switches.rearm = true;
  run(0.9);
  CHECK(drive.is_cut());
  run(1.5);
  CHECK(told.steering == doctest::Approx(0.5));
  car.is_stale = true;
  run(0.21);
  CHECK(told.steering == 0.0);
  // From the terminal, but not while the switch is pressed.
  car = reading();
  car.switches.emergency_stop = true;
  run(0.01);
  drive.rearm();
  CHECK(drive.is_cut());
  car.switches.emergency_stop = false;
  run(0.5);
  CHECK(told.steering == 0.0);
  drive.rearm();
  run(1.5);
  CHECK(told.steering == doctest::Approx(0.5));
}

TEST_CASE("the end of the wheel's way pushes back against whatever the game pulls") {
  GameDrive drive({.steering_most = 1.0}, 7.85);
  ForceEffects effects;
  effects.load(0, {.kind = ForceKind::constant, .level = 1.0});
  effects.play(0, 1, 0.0);
  Actuators told;
  for (int i = 0; i < 150; ++i) told = drive.actuate(reading(7.85), effects, 0.01 * i);
  CHECK(told.steering == doctest::Approx(-1.0));
}

TEST_CASE("a spring pulls to its middle, a damper against the turning, friction alike at every speed") {
  ForceEffects effects;
  effects.load(1, {.kind = ForceKind::spring, .left_coefficient = 0.8, .right_coefficient = 0.4, .right_most = 0.1});
  effects.play(1, 1, 0.0);
  CHECK(effects.force({.share = 0.5}, 1.0) == doctest::Approx(-0.4));
  CHECK(effects.force({.share = -0.5}, 1.0) == doctest::Approx(0.1));
  CHECK(effects.force({}, 1.0) == 0.0);
  effects.erase(1);
  effects.load(2, {.kind = ForceKind::damper, .left_coefficient = 0.5, .right_coefficient = 0.5});
  effects.play(2, 1, 0.0);
  CHECK(effects.force({.share = 0.9, .speed_per_s = 1.0}, 1.0) == doctest::Approx(-0.5));
  CHECK(effects.force({.share = 0.9, .speed_per_s = -0.5}, 1.0) == doctest::Approx(0.25));
  effects.erase(2);
  effects.load(3, {.kind = ForceKind::friction, .left_coefficient = 0.3, .right_coefficient = 0.3});
  effects.play(3, 1, 0.0);
  CHECK(effects.force({.speed_per_s = 0.2}, 1.0) == doctest::Approx(-0.3));
  CHECK(effects.force({.speed_per_s = 3.0}, 1.0) == doctest::Approx(-0.3));
  CHECK(effects.force({}, 1.0) == 0.0);
}

TEST_CASE("effects begin, fade, repeat and end by their times, and nothing makes more than all of the motor's force") {
  ForceEffects effects;
  effects.load(
      0, {.kind = ForceKind::constant, .level = 0.8, .length_s = 1.0, .delay_s = 0.5, .attack_s = 0.2, .fade_s = 0.5});
  effects.play(0, 2, 10.0);
  CHECK(effects.force({}, 10.4) == 0.0);
  CHECK(effects.force({}, 10.6) == doctest::Approx(0.4));
  CHECK(effects.force({}, 10.9) == doctest::Approx(0.8));
  CHECK(effects.force({}, 11.25) == doctest::Approx(0.4));
  CHECK(effects.force({}, 12.0) == doctest::Approx(0.8));
  CHECK(effects.force({}, 12.6) == 0.0);
  effects.load(1, {.kind = ForceKind::periodic, .level = 1.0, .wave = ForceWave::sine, .period_s = 0.04});
  effects.play(1, 1, 0.0);
  CHECK(effects.force({}, 20.01) == doctest::Approx(1.0));
  for (int i = 2; i < 40; ++i) {
    effects.load(static_cast<std::int16_t>(i), {.kind = ForceKind::constant, .level = i % 2 == 0 ? 5.0 : std::nan("")});
    effects.play(static_cast<std::int16_t>(i), 1, 0.0);
  }
  CHECK(effects.force({.share = std::nan("")}, 30.0) == 1.0);
  effects.set_gain(0.25);
  CHECK(effects.force({}, 30.0) == 0.25);
  effects.play(77, 1, 0.0);
  for (int i = 100; i < 1000; ++i) effects.load(static_cast<std::int16_t>(i), {});
  CHECK(effects.size() <= 64);
}

TEST_CASE("Linux' effects become ours: directions, conditions, and a direction that nobody has set") {
  ff_effect effect{};
  effect.type = FF_CONSTANT;
  effect.direction = 0x4000;
  effect.u.constant.level = 16384;
  CHECK(force_effect_of(effect).level == relative(0.5, 1e-3));
  effect.direction = 0xC000;
  CHECK(force_effect_of(effect).level == relative(-0.5, 1e-3));
  effect.direction = 0;
  CHECK(force_effect_of(effect).level == relative(0.5, 1e-3));
  effect = {};
  effect.type = FF_SPRING;
  effect.u.condition[0] = {.right_saturation = 0xffff,
                           .left_saturation = 0x8000,
                           .right_coeff = 32767,
                           .left_coeff = 16384,
                           .deadband = 0,
                           .center = 3277};
  const ForceEffect spring = force_effect_of(effect);
  CHECK(spring.kind == ForceKind::spring);
  CHECK(spring.left_coefficient == relative(0.5, 1e-3));
  CHECK(spring.left_most == relative(0.5, 1e-3));
  CHECK(spring.centre == relative(-0.1, 1e-3));  // To the right.
}

TEST_CASE("a game is told once of what has changed, wheel and pedals as a wheel's axes") {
  DriverInput input;
  const auto all = wheel_events(input, nullptr, 7.85);
  CHECK(all.size() == 4 + 16 + 1);
  DriverInput next = input;
  CHECK(wheel_events(next, &input, 7.85).empty());
  next.steering_wheel_rad = 7.85;
  next.accelerator = 1.0;
  next.horn = true;
  CHECK(wheel_events(next, &input, 7.85) ==
        std::vector<WheelEvent>{
            {EV_ABS, ABS_X, -32767}, {EV_ABS, ABS_Z, 32767}, {EV_KEY, BTN_TRIGGER + 3, 1}, {EV_SYN, SYN_REPORT, 0}});
  next.brake = std::nan("");
  CHECK(wheel_events(next, &input, 7.85).size() == 4);
}

}  // namespace septet::car_io
