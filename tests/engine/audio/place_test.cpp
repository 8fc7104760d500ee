// Places of sounds, and their paths: others, their sirens, the car's wall and the air, tunnels, loudspeakers.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/audio/levels.hpp"
#include "engine/audio/siren.hpp"
#include "tests/engine/audio/sound_fixture.hpp"
#include "tests/engine/audio/spectrum.hpp"
#include "tests/relative.hpp"

namespace septet::audio {

TEST_CASE("A siren's two tones are a fourth apart within 360 to 630 Hz") {
  CHECK(siren_hz(two_tone, 0.1) == doctest::Approx(440.0));
  CHECK(siren_hz(two_tone, 0.8) / siren_hz(two_tone, 0.1) == doctest::Approx(4.0 / 3.0));
  CHECK(siren_hz(two_tone, 1.6) == doctest::Approx(440.0));
  CHECK(siren_hz(wail, 0.75) == doctest::Approx(1000.0));
}

TEST_CASE("An ambulance that comes at 25 m/s sounds higher and one that goes lower, as the closed form says") {
  for (const double speed_mps : {25.0, -25.0}) {
    CAPTURE(speed_mps);
    // Behind the car and far off, so that its direction stays; only the first tone sounds.
    Snapshot snapshot = with_ambulance(-60.0, speed_mps);
    snapshot.simulated_time_s = 0.6;
    const auto sound = played(90, [&](int) { return hear(snapshot, nullptr, {}, {}); });
    const double expected_hz = 440.0 * 343.3 / (343.3 - speed_mps);
    CHECK(peak_hz(after(sound[0], 0.1), 380.0, 520.0) == relative(expected_hz, 0.002));
  }
  CHECK(doppler_factor({1, 0, 0}, {25, 0, 0}, {-25, 0, 0}) == relative(1.157, 0.001));
  CHECK(doppler_factor({0, 1, 0}, {25, 0, 0}, {}) == doctest::Approx(1.0));
  CHECK(std::isfinite(doppler_factor({1, 0, 0}, {343.3, 0, 0}, {})));
}

TEST_CASE("What is on the left is heard on the left") {
  const auto sides = [](double y_m) {
    const Snapshot snapshot = with_ambulance(1.0, 0.0, y_m);
    const auto sound = played(60, [&](int) { return hear(snapshot, nullptr, {}, {}); });
    return decibels(mean_square(sound[0]) / mean_square(sound[1]));
  };
  CHECK(sides(20.0) > 6.0);
  CHECK(sides(-20.0) < -6.0);
}

TEST_CASE("The car's wall takes 12 dB at 125 Hz, 25 at 1 kHz and 30 at 2 kHz") {
  CHECK(20.0 * std::log10(CabinWall::gain(125.0)) == relative(-12.0, 0.05));
  CHECK(20.0 * std::log10(CabinWall::gain(1000.0)) == relative(-25.0, 0.06));
  CHECK(20.0 * std::log10(CabinWall::gain(2000.0)) < -29.5);
}

TEST_CASE("Somebody who comes or goes fades over a block") {
  const Snapshot there = with_ambulance(-10.0, 0.0);
  Snapshot gone = there;
  gone.participants.pop_back();
  const auto steady = played(120, [&](int) { return hear(there, nullptr, {}, {}); });
  const auto changing = played(120, [&](int tick) { return hear(tick / 12 % 2 == 0 ? there : gone, nullptr, {}, {}); });
  CHECK(loudest_step(changing[0]) < 1.3 * loudest_step(after(steady[0], 0.1)));
}

TEST_CASE("Of two hundred participants the sixteen loudest are heard, the ambulance among them") {
  Snapshot snapshot = with_ambulance(-300.0, 20.0);
  for (ParticipantId id = 10; id < 210; ++id) {
    Participant car;
    car.id = id;
    car.world_from_vehicle.position_m = {20.0 + id, 4.0, 0.0};
    car.velocity_mps = {20.0, 0.0, 0.0};
    snapshot.participants.push_back(car);
  }
  const auto heard = hear(snapshot, nullptr, {}, {});
  REQUIRE(heard.others.size() == most_others);
  CHECK(heard.others.front().id == 7);
  CHECK(heard.others[1].id == 10);
  const auto sound = played(30, [&](int) { return heard; });
  CHECK(mean_square(sound[0]) > 0.0);
}

TEST_CASE("A tunnel echoes: a horn is still heard in it when it has long ended, and not in the open") {
  const auto tail = [](double tunnel) {
    const auto sound = played(180, [=](int tick) {
      Heard heard;
      heard.car.tunnel = tunnel;
      heard.car.horn = tick < 60;
      return heard;
    });
    return mean_square(after(sound[0], 1.0));
  };
  CHECK(tail(1.0) > 1e-6);
  CHECK(tail(0.0) < 1e-9);
  Snapshot snapshot = with_ambulance(-30.0, 0.0);
  const std::vector<EchoBox> boxes{{{}, {-100.0, -5.0, 0.0}, {100.0, 5.0, 6.0}}};
  CHECK(hear(snapshot, nullptr, {}, boxes).car.tunnel == doctest::Approx(1.0));
  snapshot.participants[0].world_from_vehicle.position_m.x = 98.6;  // The ear in its mouth.
  CHECK(hear(snapshot, nullptr, {}, boxes).car.tunnel == relative(0.5, 0.2));
  snapshot.participants[0].world_from_vehicle.position_m.x = 130.0;
  CHECK(hear(snapshot, nullptr, {}, boxes).car.tunnel == 0.0);
}

TEST_CASE("Of 5.1 channels the one for low frequencies has what shakes and nothing else does") {
  const StageOptions surround{Speakers::surround_51};
  const auto sound = played(
      120, [](int) { return cruising(0.0, 15.0, 0.5); }, surround);
  REQUIRE(sound.size() == 6);
  CHECK(peak_hz(after(sound[3], 0.2), 20.0, 100.0) == relative(45.0, 0.01));
  const auto low = power_spectrum(after(sound[3], 0.2), 8192);
  double below = 0.0, above = 0.0;
  for (std::size_t i = 1; i < low.size(); ++i) (double(i) * 48000.0 / 8192.0 < 150.0 ? below : above) += low[i];
  CHECK(decibels(above / below) < -30.0);
  const Snapshot behind = with_ambulance(-20.0, 0.0);
  const auto siren = played(
      60, [&](int) { return hear(behind, nullptr, {}, {}); }, surround);
  CHECK(mean_square(siren[4]) > 4.0 * mean_square(siren[0]));
  CHECK(mean_square(siren[3]) < 1e-6);
  // The shaker is cut: its channel alone is silent, and does not click in between.
  const auto cut = played(
      120,
      [](int tick) {
        Heard heard = cruising(0.0, 15.0, 0.5);
        heard.car.low_share = tick < 60 ? 1.0 : 0.0;
        return heard;
      },
      surround);
  CHECK(mean_square(after(cut[3], 0.55)) == 0.0);
  CHECK(mean_square(after(cut[0], 0.55)) == relative(mean_square(after(sound[0], 0.55)), 1e-6));
  CHECK(loudest_step(cut[3]) <= 1.5 * loudest_step(sound[3]));
}

TEST_CASE("A siren is in the same place of its melody wherever one begins to listen") {
  const auto tone_hz = [](double from_s, double to_s) {
    Snapshot snapshot = with_ambulance(20.0, 0.0);
    const auto sound = played(static_cast<int>(std::lround((to_s - from_s) * 120.0)), [&](int tick) {
      snapshot.simulated_time_s = from_s + tick / 120.0;
      return hear(snapshot, nullptr, {}, {});
    });
    return peak_hz(after(sound[0], to_s - from_s - 0.25), 400.0, 620.0);
  };
  for (const double to_s : {2.0, 2.5, 3.0, 3.5}) {
    CAPTURE(to_s);
    CHECK(tone_hz(1.0, to_s) == relative(tone_hz(to_s - 0.4, to_s), 0.01));
  }
  CHECK(std::abs(tone_hz(1.6, 2.0) - tone_hz(2.35, 2.75)) > 100.0);
}

TEST_CASE("The air takes 5 dB of 100 m at 5 kHz and hardly anything where sirens are") {
  const auto passed = [](double hz, double way_m) {
    CabinWall wall{.air_pole = air_pole(way_m)};
    std::vector<float> heard;
    for (int block = 0; block < 40; ++block) {
      Block samples;
      for (std::size_t i = 0; i < block_samples; ++i)
        samples[i] =
            static_cast<float>(std::sin(2.0 * std::numbers::pi * hz *
                                        double(static_cast<std::size_t>(block) * block_samples + i) / sample_rate_hz));
      CabinWall* const walls[] = {&wall};
      Block* const blocks[] = {&samples};
      apply_walls(walls, blocks);
      heard.insert(heard.end(), samples.begin(), samples.end());
    }
    return decibels(power_at(after(heard, 0.1), hz) / 0.5) - 20.0 * std::log10(CabinWall::gain(hz));
  };
  CHECK(std::abs(passed(5000.0, 0.0)) < 0.1);
  CHECK(passed(5000.0, 100.0) == relative(-5.0, 0.02));
  CHECK(passed(5000.0, 300.0) == relative(-15.0, 0.02));
  CHECK(passed(500.0, 100.0) > -0.2);
  CHECK(passed(440.0, 300.0) > -1.2);
  for (const double nonsense : {-1.0, std::nan(""), 1e300}) {
    const float pole = air_pole(nonsense);
    CHECK((pole >= 0.0f && pole < 1.0f));
  }
}

}  // namespace septet::audio
