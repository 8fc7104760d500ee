#pragma once
/// Sounds of a stretch of time, for tests.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/audio/sound_stage.hpp"
#include "engine/audio/soundtrack.hpp"

namespace septet::audio {

using HeardAt = std::function<Heard(int tick)>;

/// A standing car with its engine off.
inline Heard quiet() { return {}; }

/// A car rolling at a steady speed.
inline Heard cruising(double speed_mps, double engine_hz, double load) {
  Heard heard;
  heard.car.running = engine_hz > 0.0;
  heard.car.engine_hz = engine_hz;
  heard.car.load = load;
  heard.car.speed_mps = heard.car.air_mps = speed_mps;
  heard.car.wheel_hz = speed_mps / (2.0 * 3.14159265 * 0.32);
  return heard;
}

/// Each voice's samples, by its index among the own voices; other voices behind them in one.
inline std::vector<std::vector<float>> voices_of(int ticks, const HeardAt& heard, const CarSound& car = {},
                                                 int skipped = 60) {
  State state = start(car, Random(1));
  std::vector<Voice> voices;
  std::vector<std::vector<float>> samples(own_voices + 1);
  for (int tick = 0; tick < ticks + skipped; ++tick) {
    render(state, heard(tick), voices);
    if (tick < skipped) continue;
    for (std::size_t i = 0; i < voices.size(); ++i) {
      auto& mine = samples[std::min(i, own_voices)];
      mine.insert(mine.end(), voices[i].samples.begin(), voices[i].samples.end());
    }
  }
  return samples;
}

/// Each channel as the loopback device gives it.
inline std::vector<std::vector<float>> played(int ticks, const HeardAt& heard, const StageOptions& options = {},
                                              const CarSound& car = {}) {
  auto stage = SoundStage::open_loopback(options);
  REQUIRE(stage);
  State state = start(car, Random(1));
  std::vector<Voice> voices;
  std::vector<float> samples;
  const std::size_t count = channels_of(options.speakers);
  std::vector<std::vector<float>> channels(count);
  for (int tick = 0; tick < ticks; ++tick) {
    const Heard now = heard(tick);
    render(state, now, voices);
    stage->put(voices, now.car.tunnel);
    stage->render(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) channels[i % count].push_back(samples[i]);
  }
  CHECK(stage->starved() == 0);
  return channels;
}

inline std::span<const float> after(const std::vector<float>& samples, double seconds) {
  return std::span(samples).subspan(static_cast<std::size_t>(seconds * sample_rate_hz));
}

/// The driver's car at the origin, looking along x, and an ambulance with its siren on.
inline Snapshot with_ambulance(double x_m, double speed_mps, double y_m = 0.0) {
  Snapshot snapshot;
  snapshot.driver_car.participant = 1;
  Participant own;
  own.id = 1;
  Participant ambulance;
  ambulance.id = 7;
  for (std::size_t i = 0; i < vehicle_models().size(); ++i)
    if (vehicle_models()[i].kind == ParticipantKind::ambulance) ambulance.model = static_cast<ModelIndex>(i);
  ambulance.world_from_vehicle.position_m = {x_m, y_m, 0.0};
  ambulance.velocity_mps = {speed_mps, 0.0, 0.0};
  ambulance.lamps.set(Lamp::siren, true);
  snapshot.participants = {own, ambulance};
  return snapshot;
}

inline double loudest_step(std::span<const float> samples) {
  float most = 0.0f;
  for (std::size_t i = 1; i < samples.size(); ++i) most = std::max(most, std::abs(samples[i] - samples[i - 1]));
  return most;
}

}  // namespace septet::audio
