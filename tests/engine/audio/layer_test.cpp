// Each layer of the driver's own car by its spectrum, through the device.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/audio/levels.hpp"
#include "tests/engine/audio/sound_fixture.hpp"
#include "tests/engine/audio/spectrum.hpp"
#include "tests/relative.hpp"

namespace septet::audio {
namespace {

/// A car that rolls with its engine off, changed.
template <class Change>
std::vector<float> rolling(double speed_mps, const Change& change) {
  const auto sound = played(180, [&](int) {
    Heard heard = cruising(speed_mps, 0.0, 0.0);
    heard.car.air_mps = 0.0;
    change(heard.car);
    return heard;
  });
  return {after(sound[0], 0.5).begin(), after(sound[0], 0.5).end()};
}

/// Power between two frequencies.
double power_within(std::span<const float> samples, double low_hz, double high_hz) {
  constexpr std::size_t n = 4096;
  const auto spectrum = power_spectrum(samples, n);
  double power = 0.0;
  for (std::size_t i = 1; i < spectrum.size(); ++i)
    if (const double hz = double(i) * sample_rate_hz / double(n); hz >= low_hz && hz < high_hz) power += spectrum[i];
  return power;
}

constexpr auto as_it_is = [](OwnCar&) {};

}  // namespace

TEST_CASE("The gears whine with twenty teeth before the final drive, and in reverse louder") {
  const CarSound car;
  const double speed_mps = 8.0, mesh_hz = speed_mps / (2.0 * 3.14159265 * 0.32) * car.final_ratio * 20.0;
  const auto forwards = rolling(speed_mps, as_it_is),
             backwards = rolling(speed_mps, [](OwnCar&own) { own.reversing = true; });
  CHECK(peak_hz(backwards, 0.8 * mesh_hz, 1.2 * mesh_hz) == relative(mesh_hz, 0.01));
  CHECK(decibels(power_at(backwards, mesh_hz) / power_at(forwards, mesh_hz)) == relative(reverse_whine_more_db, 0.15));
}

TEST_CASE("The horn has two tones, 400 and 500 Hz") {
  const auto horn = rolling(0.0, [](OwnCar& own) { own.horn = true; });
  CHECK(peak_hz(horn, 360.0, 440.0) == relative(400.0, 0.01));
  CHECK(peak_hz(horn, 460.0, 540.0) == relative(500.0, 0.01));
  CHECK(decibels(power_at(horn, 400.0) / power_at(horn, 440.0)) > 20.0);
}

TEST_CASE("Tyres that slide sing at 1 kHz, on a wet road less and on snow not at all") {
  const auto sliding = [](double wetness, double snow) {
    return power_within(rolling(20.0,
                                [=](OwnCar& own) {
                                  own.front_slip = own.rear_slip = 0.5;
                                  own.wetness = wetness;
                                  own.snow = snow;
                                }),
                        900.0, 1300.0);
  };
  const double rolls = power_within(rolling(20.0, as_it_is), 900.0, 1300.0), dry = sliding(0.0, 0.0);
  CHECK(decibels(dry / rolls) > 10.0);
  CHECK(decibels(sliding(1.0, 0.0) / dry) < -6.0);
  CHECK(decibels(sliding(0.0, 1.0) / dry) < -10.0);
}

TEST_CASE("A wet road hisses above 2 kHz, gravel rumbles below, and snow hushes both") {
  const auto dry = rolling(25.0, as_it_is), wet = rolling(25.0, [](OwnCar&own) { own.wetness = 1.0; }),
             loose = rolling(25.0, [](OwnCar&own) { own.looseness = 1.0; }),
             snow = rolling(25.0, [](OwnCar&own) { own.snow = 1.0; });
  CHECK(decibels(power_within(wet, 2000.0, 8000.0) / power_within(dry, 2000.0, 8000.0)) > 6.0);
  CHECK(decibels(power_within(loose, 200.0, 800.0) / power_within(dry, 200.0, 800.0)) > 5.0);
  CHECK(decibels(power_within(snow, 500.0, 4000.0) / power_within(dry, 500.0, 4000.0)) < -6.0);
}

TEST_CASE("Rain makes the roof ring at its modes, more of it louder, and none of it is silent") {
  const auto rain = [](double mm_per_h) { return rolling(0.0, [=](OwnCar& own) { own.rain_mm_per_h = mm_per_h; }); };
  const auto some = rain(5.0);
  CHECK(mean_square(rain(0.0)) == 0.0);
  for (const double mode_hz : {190.0, 340.0, 640.0}) {
    CAPTURE(mode_hz);
    CHECK(power_within(some, mode_hz - 25.0, mode_hz + 25.0) > 2.0 * power_within(some, 60.0, 110.0));
  }
  CHECK(decibels(a_weighted_power(rain(20.0)) / a_weighted_power(some)) == relative(6.0, 0.35));
}

TEST_CASE("A hard blow breaks glass, a soft one does not, and pieces clatter") {
  const auto blow = [](double blow_mps, int pieces) {
    const auto voices = voices_of(60, [=](int tick) {
      Heard heard = quiet();
      heard.car.blow_mps = tick == 60 ? blow_mps : 0.0;
      heard.car.pieces = tick == 60 ? pieces : 0;
      return heard;
    });
    return voices[std::size_t(OwnVoice::crash)];
  };
  const auto soft = blow(2.0, 0), hard = blow(8.0, 0), clatter = blow(0.0, 20);
  // After the impact itself has decayed the glass is still heard.
  const auto glassy = [](const std::vector<float>& sound) {
    const auto late = after(sound, 0.3);
    return decibels(power_within(late, 3500.0, 6000.0) / power_within(late, 200.0, 1500.0));
  };
  CHECK(glassy(hard) > glassy(soft) + 6.0);
  CHECK(decibels(mean_square(hard) / mean_square(soft)) > 9.0);
  CHECK(mean_square(clatter) > 0.0);
  CHECK(power_within(clatter, 1000.0, 2500.0) > power_within(clatter, 100.0, 900.0));
  CHECK(std::abs(hard.front()) < 0.01f);  // It begins without an edge.
}

TEST_CASE("The exhaust's pipe of 2 m rings at a quarter of its wave, 65 Hz, and not at a half, 130 Hz") {
  const auto above_engine_db = [](double firing_hz) {
    const auto voices = voices_of(180, [=](int) { return cruising(0.0, firing_hz / 3.0, 0.3); });
    return decibels(power_at(voices[std::size_t(OwnVoice::exhaust)], firing_hz) /
                    power_at(voices[std::size_t(OwnVoice::engine)], firing_hz));
  };
  CHECK(above_engine_db(65.1) - above_engine_db(130.2) == relative(20.0 * std::log10(3.0), 0.1));
}

TEST_CASE(
    "An open throttle draws air: between the engine's orders there is more below 500 Hz than its mechanics make") {
  const auto noise = [](double load, double low_hz, double high_hz) {
    const auto voices = voices_of(240, [=](int) { return cruising(0.0, 2000.0 / 60.0, load); });
    return power_within(voices[std::size_t(OwnVoice::engine)], low_hz, high_hz);
  };
  // Of a six its orders are multiples of 50 Hz.
  const double intake_db = decibels(noise(1.0, 315.0, 340.0) / noise(0.2, 315.0, 340.0)),
               mechanics_db = decibels(noise(1.0, 2000.0, 3000.0) / noise(0.2, 2000.0, 3000.0));
  CHECK(mechanics_db == relative(0.8 * 9.0, 0.15));
  CHECK(intake_db > mechanics_db + 1.0);
}

TEST_CASE("Wind has its most, A-weighted, between 180 and 700 Hz and falls off above") {
  const auto wind = voices_of(300, [](int) { return cruising(35.0, 0.0, 0.0); })[std::size_t(OwnVoice::wind_left)];
  const auto octave_db = [&](double hz) {
    return decibels(a_weight(hz) * a_weight(hz) * power_within(wind, hz / std::sqrt(2.0), hz * std::sqrt(2.0)));
  };
  const double most = std::max(octave_db(250.0), octave_db(500.0));
  for (const double hz : {63.0, 125.0, 1000.0, 2000.0, 4000.0}) {
    CAPTURE(hz);
    CHECK(octave_db(hz) < most);
  }
  CHECK(octave_db(4000.0) < octave_db(1000.0) - 10.0);
}

TEST_CASE("Another car sings at its own firing order, raised as it comes, and a lorry's horn and wheels are heard") {
  const auto heard_of = [](const OtherSound& sound) {
    const auto voices = voices_of(180, [=](int) {
      Heard heard = quiet();
      heard.others.push_back(sound);
      return heard;
    });
    return voices[own_voices];
  };
  const OtherSound car{.id = 5, .position_m = {20.0, 0.0, 0.0}, .doppler = 1.08, .engine_hz = 50.0, .load = 1.0};
  CHECK(peak_hz(heard_of(car), 90.0, 130.0) == relative(100.0 * 1.08, 0.01));
  const OtherSound rolls{.id = 5, .position_m = {20.0, 0.0, 0.0}, .speed_mps = 30.0};
  OtherSound slow = rolls, lorry = rolls;
  slow.speed_mps = 10.0;
  lorry.kind = ParticipantKind::lorry;
  const auto rolling = [&](const OtherSound& sound) { return power_within(heard_of(sound), 500.0, 1500.0); };
  CHECK(decibels(rolling(rolls) / rolling(slow)) > 8.0);
  CHECK(decibels(rolling(lorry) / rolling(rolls)) == relative(8.0, 0.2));
  OtherSound hooting = rolls;
  hooting.speed_mps = 0.0;
  const double quiet_there = power_at(heard_of(hooting), 400.0);
  hooting.horn = true;
  CHECK(power_at(heard_of(hooting), 400.0) > 100.0 * (quiet_there + 1e-15));
}

}  // namespace septet::audio
