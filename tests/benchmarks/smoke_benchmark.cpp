#include <benchmark/benchmark.h>

#include "engine/core/random.hpp"
#include "engine/effects/smoke/attraction.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "tests/engine/effects/smoke/tunnel_grid.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

constexpr double step_s = 1.0 / 120.0;

/// A road tunnel of half-metre cells, long enough for two particles in a cell's volume, filled evenly and left to
/// settle.
State settled_tunnel(std::size_t count) {
  const double length_m = std::min(2000.0, static_cast<double>(count) / 500.0);
  Emitter fire;
  fire.lifetime_s = 0.0;
  State state = make_smoke(make_tunnel_grid({}, 0.5, length_m, 5.5, 4.0, 7.0), {fire}, 1, count);
  Random random(3);
  while (state.particles.size() < count)
    add_particle(
        state,
        {random.uniform(0.0, state.grid.nx), random.uniform(0.0, state.grid.ny), random.uniform(0.0, state.grid.nz)}, 0,
        static_cast<float>(random.uniform(0.0, 20.0)));
  state.grid.open_faces = 0;
  for (int tick = 0; tick < 30; ++tick) advance_smoke(state, Vec3(1.0, 0.0, 0.0), {}, step_s);
  return state;
}

void smoke_tick(benchmark::State& run) {
  State state = settled_tunnel(static_cast<std::size_t>(run.range(0)));
  const std::array<Obstacle, 2> cars{Obstacle{RigidTransform{{40.0, 2.0, 0.8}}, {2.2, 0.9, 0.8}},
                                     Obstacle{RigidTransform{{60.0, -2.0, 2.0}}, {8.0, 1.25, 2.0}}};
  for (auto _ : run) advance_smoke(state, Vec3(1.0, 0.0, 0.0), cars, step_s);
  run.SetItemsProcessed(run.iterations() * run.range(0));
}

void smoke_tick_literal(benchmark::State& run) {
  State state = settled_tunnel(static_cast<std::size_t>(run.range(0)));
  for (auto _ : run) advance_smoke_literally(state, step_s);
  run.SetItemsProcessed(run.iterations() * run.range(0));
}

void smoke_keyframes(benchmark::State& run) {
  State state = settled_tunnel(static_cast<std::size_t>(run.range(0)));
  KeyframeTrack track;
  for (auto _ : run) {
    ++state.tick;
    state.time_s += step_s;
    benchmark::DoNotOptimize(advance_keyframes(track, state));
  }
}

BENCHMARK(smoke_tick)->Arg(20'000)->Arg(100'000)->Arg(300'000)->Unit(benchmark::kMillisecond);
BENCHMARK(smoke_tick_literal)->Arg(20'000)->Unit(benchmark::kMillisecond);
BENCHMARK(smoke_keyframes)->Arg(20'000)->Unit(benchmark::kMicrosecond);

}  // namespace
