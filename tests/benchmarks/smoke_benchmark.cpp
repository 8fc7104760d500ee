#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "engine/core/random.hpp"
#include "engine/effects/smoke/attraction.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/effects/smoke/velocity_field.hpp"
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

/// Bytes that the part of a tick must move at the least where nothing stays in a cache from tick to tick; what is
/// written is fetched first.
struct Moved {
  double field_bytes = 0.0, particle_bytes = 0.0;
};
Moved moved_by(const State& state) {
  const auto cells = static_cast<double>(state.grid.cells()), particles = static_cast<double>(state.particles.size());
  constexpr double written = 2.0;
  Moved moved;
  moved.field_bytes =
      cells * (sizeof(std::uint16_t) + sizeof(std::uint8_t) + written * sizeof(float) + written * sizeof(CellVelocity));
  // x, y, z and age change; emitter, births and number are read; of each cell the velocity and the density, which changes.
  moved.particle_bytes = particles * (written * 4.0 * sizeof(float) + sizeof(std::uint8_t) + sizeof(std::uint16_t) +
                                      sizeof(std::uint32_t)) +
                         cells * (sizeof(CellVelocity) + written * sizeof(std::uint16_t));
  return moved;
}

void report_bytes(benchmark::State& run, double bytes) {
  run.counters["MB"] = 1e-6 * bytes;
  run.SetBytesProcessed(static_cast<std::int64_t>(bytes * static_cast<double>(run.iterations())));
}

/// What this machine's memory gives one thread: McCalpin's triad over 3 × 64 MB, its writes fetched first too.
void smoke_stream(benchmark::State& run) {
  constexpr std::size_t count = 16'000'000;
  std::vector<float> a(count, 1.0f), b(count, 2.0f), c(count, 3.0f);
  for (auto _ : run) {
    for (std::size_t n = 0; n < count; ++n) a[n] = b[n] + 0.5f * c[n];
    benchmark::ClobberMemory();
  }
  report_bytes(run, 4.0 * sizeof(float) * count);
}

/// The convolution alone.
void smoke_field(benchmark::State& run) {
  State state = settled_tunnel(static_cast<std::size_t>(run.range(0)));
  const std::vector<float> table = attraction_table(state.parameters);
  for (auto _ : run) update_velocity_field(state, table, state.field);
  report_bytes(run, moved_by(state).field_bytes);
}

void smoke_tick(benchmark::State& run) {
  State state = settled_tunnel(static_cast<std::size_t>(run.range(0)));
  const std::array<Obstacle, 2> cars{Obstacle{RigidTransform{{40.0, 2.0, 0.8}}, {2.2, 0.9, 0.8}},
                                     Obstacle{RigidTransform{{60.0, -2.0, 2.0}}, {8.0, 1.25, 2.0}}};
  for (auto _ : run) advance_smoke(state, Vec3(1.0, 0.0, 0.0), cars, step_s);
  run.SetItemsProcessed(run.iterations() * run.range(0));
  const Moved moved = moved_by(state);
  report_bytes(run, moved.field_bytes + moved.particle_bytes);
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

BENCHMARK(smoke_stream)->Unit(benchmark::kMillisecond);
BENCHMARK(smoke_field)->Arg(300'000)->Unit(benchmark::kMillisecond);
BENCHMARK(smoke_tick)->Arg(20'000)->Arg(100'000)->Arg(300'000)->Unit(benchmark::kMillisecond);
BENCHMARK(smoke_tick_literal)->Arg(20'000)->Unit(benchmark::kMillisecond);
BENCHMARK(smoke_keyframes)->Arg(20'000)->Unit(benchmark::kMicrosecond);

}  // namespace
