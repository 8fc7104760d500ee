#include <doctest/doctest.h>

#include "engine/audio/engine_orders.hpp"
#include "engine/audio/levels.hpp"
#include "engine/audio/siren.hpp"
#include "tests/engine/audio/sound_fixture.hpp"
#include "tests/engine/audio/spectrum.hpp"
#include "tests/relative.hpp"

namespace septet::audio {
namespace {

/// Total level in dB(A) at the ear: independent voices add by their powers.
double level_inside_db(double speed_kmh, double engine_hz, double load) {
  const auto voices = voices_of(360, [&](int) { return cruising(speed_kmh / 3.6, engine_hz, load); });
  double power = 0.0;
  for (std::size_t i = 0; i < own_voices; ++i)
    if (i != std::size_t(OwnVoice::low)) power += a_weighted_power(voices[i]);
  return level_db(std::sqrt(power));
}

}  // namespace

TEST_CASE("An engine of four, five and six cylinders sings at its firing order, 10 dB over what lies beside it") {
  for (const int cylinders : {4, 5, 6}) {
    CAPTURE(cylinders);
    CarSound car;
    car.cylinders = cylinders;
    const auto sound = played(
        300, [](int) { return cruising(0.0, 2000.0 / 60.0, 0.5); }, {}, car);
    const auto left = after(sound[0], 0.5);
    const double expected_hz = cylinders / 2.0 * 2000.0 / 60.0;
    const double found_hz = peak_hz(left, 0.8 * expected_hz, 1.2 * expected_hz);
    CHECK(found_hz == relative(expected_hz, 0.01));
    CHECK(decibels(power_at(left, found_hz) / power_at(left, found_hz * 1.1)) > 10.0);
    CHECK(peak_hz(left, 1.6 * expected_hz, 2.4 * expected_hz) == relative(2.0 * expected_hz, 0.01));
  }
}

TEST_CASE(
    "With load an engine is louder by 6 dB and brighter by a fifth, and on the overrun its firing order falls by 10 "
    "dB") {
  const auto engine = [](double load, bool cut) {
    return voices_of(240, [=](int) {
      Heard heard = cruising(0.0, 40.0, load);
      heard.car.fuel_cut = cut;
      return heard;
    })[std::size_t(OwnVoice::engine)];
  };
  const auto light = engine(0.1, false), full = engine(1.0, false), cut = engine(0.0, true);
  CHECK(decibels(mean_square(full) / mean_square(light)) > 6.0);
  const auto centroid = [](std::span<const float> samples) {
    const auto spectrum = power_spectrum(samples, 8192);
    double power = 0.0, moment = 0.0;
    for (std::size_t i = 1; i < spectrum.size(); ++i) power += spectrum[i], moment += spectrum[i] * double(i);
    return moment / power;
  };
  CHECK(centroid(full) > 1.2 * centroid(light));
  CHECK(decibels(power_at(cut, 120.0) / power_at(light, 120.0)) < -10.0);
}

TEST_CASE("A car that stands with its engine off is silent, also through the device") {
  const auto sound = played(30, [](int) { return quiet(); });
  CHECK(mean_square(sound[0]) == 0.0);
  CHECK(mean_square(sound[1]) == 0.0);
  // An engine that was switched off, half a second ago.
  const auto stopped = played(240, [](int tick) { return tick < 60 ? cruising(0.0, 12.0, 0.0) : quiet(); });
  CHECK(mean_square(after(stopped[0], 0.2).first(9600)) > 1e-6);
  CHECK(mean_square(after(stopped[0], 1.6)) == 0.0);
}

TEST_CASE(
    "Inside it is as loud as in a middle-class car, and wind grows by 16 dB as the speed doubles, rolling by 34 dB a "
    "decade") {
  const double at_50 = level_inside_db(50, 1800.0 / 60, 0.2), at_100 = level_inside_db(100, 2500.0 / 60, 0.3),
               at_130 = level_inside_db(130, 3100.0 / 60, 0.4);
  CHECK(at_50 >= 57.0);
  CHECK(at_50 <= 60.0);
  CHECK(at_100 >= 64.0);
  CHECK(at_100 <= 67.0);
  CHECK(at_130 >= 68.0);
  CHECK(at_130 <= 71.0);
  const double idle = level_inside_db(0, 700.0 / 60, 0.0);
  CHECK(idle >= 37.0);
  CHECK(idle <= 46.0);

  const auto layer = [](double speed_mps, OwnVoice voice) {
    return decibels(
        a_weighted_power(voices_of(480, [=](int) { return cruising(speed_mps, 0.0, 0.0); })[std::size_t(voice)]));
  };
  CHECK(layer(30.0, OwnVoice::wind_left) - layer(15.0, OwnVoice::wind_left) == relative(16.0, 0.1));
  CHECK(layer(36.0, OwnVoice::rear_left) - layer(14.4, OwnVoice::rear_left) == relative(34.0 * std::log10(2.5), 0.08));
  CHECK(wind_inside_db(31.0) > rolling_inside_db(31.0));
  CHECK(wind_inside_db(25.0) < rolling_inside_db(25.0));
}

TEST_CASE("Nothing clicks: not at a change of gear, load, ground, rain, horn, or as a tunnel begins") {
  const auto calm = [](int) {
    Heard heard = cruising(20.0, 50.0, 0.9);
    heard.car.horn = true;
    heard.car.rain_mm_per_h = 5.0;
    return heard;
  };
  const auto stepped = [](int tick) {
    const bool other = tick / 15 % 2 == 1;
    Heard heard = cruising(20.0, other ? 30.0 : 50.0, other ? 0.0 : 0.9);
    heard.car.fuel_cut = other;
    heard.car.horn = !other;
    heard.car.rain_mm_per_h = other ? 0.0 : 5.0;
    heard.car.tunnel = other ? 1.0 : 0.0;
    heard.car.wetness = other ? 1.0 : 0.0;
    return heard;
  };
  const auto steady = played(240, calm), changing = played(240, stepped);
  CHECK(loudest_step(after(changing[0], 0.1)) < 1.5 * loudest_step(after(steady[0], 0.1)));
  // Pure tones have a slope of their own: nothing is steeper than twice that.
  const auto horn = [](bool steps) {
    return voices_of(120, [=](int tick) {
      Heard heard;
      heard.car.horn = !steps || tick / 10 % 2 == 0;
      return heard;
    })[std::size_t(OwnVoice::horn)];
  };
  CHECK(loudest_step(horn(true)) < 1.1 * loudest_step(horn(false)));
}

TEST_CASE(
    "A tone whose pitch jumps from block to block is never steeper than its highest pitch, and a layer's loudness "
    "never steps") {
  Tone tone;
  Harmonics one{};
  one[0] = 1.0f;
  std::vector<float> glides;
  for (int i = 0; i < 60; ++i) {
    Block block{};
    add_harmonics(tone, i % 2 ? 200.0 : 113.0, one, 1, block);
    if (i > 0) glides.insert(glides.end(), block.begin(), block.end());
  }
  CHECK(loudest_step(glides) < 1.01 * 2.0 * 3.14159265 * 200.0 / sample_rate_hz);

  const Shape slow(Section::low_pass(20.0, 0.7), Section::low_pass(20.0, 0.7));
  const auto layer = [&](bool toggles) {
    NoiseLayer noise;
    std::vector<float> samples;
    for (int i = 0; i < 200; ++i) {
      Block block{};
      add_noise(noise, slow, toggles && i % 2 ? 0.1 : 1.0, block);
      samples.insert(samples.end(), block.begin(), block.end());
    }
    return loudest_step(samples);
  };
  CHECK(layer(true) < 3.0 * layer(false));
}

TEST_CASE("Numbers that are none are counted and silent, and nonsense never exceeds full scale") {
  Snapshot snapshot = with_ambulance(-5.0, 10.0);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  snapshot.participants[1].world_from_vehicle.position_m.x = nan;
  snapshot.driver_car.engine_radps = infinite;
  snapshot.driver_car.speed_mps = nan;
  snapshot.participants[0].velocity_mps = {nan, nan, nan};
  snapshot.participants[0].wheel_spin_radps = -infinite;
  snapshot.environment.wind_speed_mps = nan;
  const auto heard = hear(snapshot, nullptr, {}, {});
  CHECK(heard.bad_numbers == 8);
  CHECK(heard.others.empty());
  const auto silent = played(30, [&](int) { return heard; });
  CHECK(mean_square(silent[0]) == 0.0);

  const auto wild = played(60, [&](int tick) {
    Heard loud = cruising(1e9, 1e9, 1e9);
    loud.car.blow_mps = 1e9;
    loud.car.front_slip = tick % 2 ? nan : -infinite;
    loud.car.rain_mm_per_h = 1e12;
    loud.car.horn = true;
    loud.others.push_back({.id = 3, .position_m = {nan, 0, 0}, .doppler = infinite, .siren = true, .blow_mps = nan});
    return loud;
  });
  for (const auto& channel : wild)
    for (const float sample : channel) {
      REQUIRE(std::isfinite(sample));
      REQUIRE(std::abs(sample) <= 1.0f);
    }
}

TEST_CASE("The road's unevenness shakes as ISO 8608 says: 3 dB for twice the speed, 6 dB a class, as white velocity") {
  const auto low = [](double speed_mps, const GroundFeel& ground) {
    const auto sound = voices_of(600, [=](int) {
      Heard heard = cruising(speed_mps, 0.0, 0.0);
      heard.car.wheel_hz = 0.0;
      heard.car.ground = ground;
      return heard;
    });
    return power_spectrum(sound[static_cast<std::size_t>(OwnVoice::low)], 32768);
  };
  const auto band = [](const std::vector<double>& spectrum, double from_hz, double to_hz) {
    double power = 0.0;
    for (std::size_t i = 1; i < spectrum.size(); ++i)
      if (const double hz = double(i) * sample_rate_hz / 32768.0; hz >= from_hz && hz < to_hz) power += spectrum[i];
    return power;
  };
  const auto good = low(15.0, {.unevenness_m3 = class_a_m3});
  const double at_15 = band(good, 8.0, 40.0);
  CHECK(decibels(band(low(30.0, {.unevenness_m3 = class_a_m3}), 8.0, 40.0) / at_15) == relative(3.0, 0.2));
  CHECK(decibels(band(low(15.0, {.unevenness_m3 = class_b_m3}), 8.0, 40.0) / at_15) == relative(6.0, 0.1));
  CHECK(decibels(band(low(15.0, {.unevenness_m3 = class_d_m3}), 8.0, 40.0) / at_15) == relative(18.0, 0.1));
  // Equal power per hertz of a shaker's share.
  CHECK(std::abs(decibels(band(good, 10.0, 18.0) / band(good, 20.0, 28.0))) < 3.0);
  CHECK(decibels(band(good, 150.0, 1000.0) / at_15) < -30.0);
}

TEST_CASE("A line under a wheel hums at the speed over its profile's 0.305 m, and a kerb thumps at the wheel's hop") {
  const auto low = [](const HeardAt& at, int ticks) {
    return voices_of(ticks, at)[static_cast<std::size_t>(OwnVoice::low)];
  };
  const auto line = low(
      [](int) {
        Heard heard = cruising(20.0, 0.0, 0.0);
        heard.car.ground.on_line = true;
        return heard;
      },
      240);
  CHECK(peak_hz(line, 40.0, 110.0) == relative(20.0 / 0.3048, 0.01));
  const auto kerb = low(
      [](int tick) {
        Heard heard = cruising(0.0, 0.0, 0.0);
        heard.car.bump_mps = tick == 70 ? 0.5 : 0.0;
        return heard;
      },
      120);
  CHECK(peak_hz(kerb, 5.0, 60.0) == relative(13.0, 0.15));
  const auto [least, most] = std::ranges::minmax(kerb);
  CHECK(most > 0.2f);
  CHECK(std::abs(kerb.back()) < 0.01f * most);
}

TEST_CASE("A jolt upwards that no road gives is a bump, and braking and hills are none") {
  Snapshot before = with_ambulance(400.0, 0.0), now = before;
  now.simulated_time_s = before.simulated_time_s + 1.0 / 120.0;
  now.participants[0].velocity_mps = {1.0, 0.0, 0.2};
  CHECK(felt(now, before).bump_mps == doctest::Approx(0.2));
  CHECK(hear(now, &before, {}, {}).car.bump_mps == doctest::Approx(0.2));
  now.participants[0].velocity_mps = {-0.08, 0.0, 0.03};
  CHECK(felt(now, before).bump_mps == 0.0);
  now.participants[0].velocity_mps.z = std::numeric_limits<double>::quiet_NaN();
  CHECK(felt(now, before).bump_mps == 0.0);
}

TEST_CASE("The indicator's relay clicks where the lamp goes on and off") {
  const auto relay = voices_of(
      84,
      [](int tick) {
        Heard heard;
        heard.car.indicator_lit = tick >= 24 && tick < 64;
        return heard;
      },
      {}, 0)[std::size_t(OwnVoice::relay)];
  const auto block = [&](int tick) {
    return mean_square(std::span(relay).subspan(std::size_t(tick) * block_samples, block_samples));
  };
  CHECK(block(23) == 0.0);
  CHECK(block(24) > 1e-6);
  CHECK(block(50) < 1e-12);
  CHECK(block(64) > 1e-6);
}

TEST_CASE("A blow is what no tyre can do, and whoever was moved by hand is not struck") {
  Snapshot before = with_ambulance(-20.0, 10.0), now = before;
  now.simulated_time_s = 1.0 / 120.0;
  now.participants[0].velocity_mps.x = before.participants[0].velocity_mps.x - 3.0;
  CHECK(hear(now, &before, {}, {}).car.blow_mps == doctest::Approx(3.0));
  now.participants[0].velocity_mps.x = before.participants[0].velocity_mps.x - 0.1;  // 12 m/s².
  CHECK(hear(now, &before, {}, {}).car.blow_mps == 0.0);
  now.participants[0].velocity_mps.x = 200.0;
  CHECK(hear(now, &before, {}, {}).car.blow_mps == 0.0);
}

TEST_CASE("The same drive gives the same samples, bit for bit") {
  const Snapshot snapshot = with_ambulance(-20.0, 10.0);
  const auto sound = [&] { return played(60, [&](int) { return hear(snapshot, nullptr, {}, {}); }); };
  CHECK(sound() == sound());
}

}  // namespace septet::audio
