/// A block of sound (400 samples, 1/120 s) of a car with sixteen others around it, on 5.1 loudspeakers: `audio/block`
/// with OpenAL's placement, `audio/synthesis` without. In real time 120 are due a second: 3 % of one processor are 250
/// µs.

#include <benchmark/benchmark.h>

#include "engine/audio/sound_stage.hpp"

using namespace septet;

namespace {

audio::Heard busy_road() {
  audio::Heard heard;
  heard.car.running = true;
  heard.car.engine_hz = 45.0;
  heard.car.load = 0.5;
  heard.car.speed_mps = heard.car.air_mps = 30.0;
  heard.car.wheel_hz = 15.0;
  heard.car.front_slip = 0.3;
  heard.car.rain_mm_per_h = 5.0;
  heard.car.wetness = 0.5;
  heard.car.tunnel = 0.5;
  for (ParticipantId id = 0; id < audio::most_others; ++id)
    heard.others.push_back({.id = id,
                            .position_m = {10.0 + 5.0 * id, 4.0, 0.0},
                            .doppler = 1.02,
                            .speed_mps = 28.0,
                            .engine_hz = 40.0,
                            .load = 0.3,
                            .siren = id == 0});
  return heard;
}

void time_blocks(benchmark::State& run, bool placed) {
  auto stage = audio::SoundStage::open_loopback({audio::Speakers::surround_51});
  if (!stage) return run.SkipWithError("no OpenAL");
  audio::State state = audio::start({}, Random(1));
  std::vector<audio::Voice> voices;
  std::vector<float> samples;
  const audio::Heard heard = busy_road();
  for (auto _ : run) {
    audio::render(state, heard, voices);
    if (placed) {
      stage->put(voices, heard.car.tunnel);
      stage->render(samples);
    }
    benchmark::DoNotOptimize(voices.data());
    benchmark::ClobberMemory();
  }
}

BENCHMARK_CAPTURE(time_blocks, block, true)->Name("audio/block");
BENCHMARK_CAPTURE(time_blocks, synthesis, false)->Name("audio/synthesis");

}  // namespace
