// Cost of the effects in the server's tick and in the tick lane: ten seconds of each scenario that has them, with a
// simulated driver. Bytes are those of a snapshot as a difference to the one of three ticks before, as a screen
// acknowledges them on a local network; without repetition.

#include <algorithm>
#include <chrono>
#include <deque>

#include <benchmark/benchmark.h>

#include "engine/core/check.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "program/resources.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "tests/engine/effects/smoke/puffs_of.hpp"

namespace septet::server {
namespace {

constexpr std::size_t baseline_age = 3;

void effects_tick(benchmark::State& bench, const char* name, int seconds_before) {
  const auto scenario = program::find_resource(name, "scenarios", ".xosc");
  const auto rig = program::find_resource("seven-screens", "rigs", ".toml");
  SEPTET_CHECK(scenario && rig, "the shipped scenario and rig are missing");
  const auto loaded = load_drive(DriveFiles{scenario->string(), rig->string(), 1});
  SEPTET_CHECK(loaded.has_value(), "{}", describe(loaded.error()));
  auto seat = open_driver_seat(rig::Car{}, 1, loaded->model);
  auto drive = LiveDrive::start(loaded->model, traffic::own_traffic(loaded->model->roads, 1), std::move(*seat));
  for (int tick = 0; tick < 120 * seconds_before; ++tick)
    SEPTET_CHECK((*drive)->next(std::nullopt).has_value(), "tick {}", tick);
  std::deque<std::shared_ptr<const TakenSnapshot>> sent;
  double bytes = 0.0, most = 0.0, keyframe = 0.0, worst_ms = 0.0;
  for (auto _ : bench) {
    const auto begun = std::chrono::steady_clock::now();
    auto snapshot = *(*drive)->next(std::nullopt);
    worst_ms =
        std::max(worst_ms, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count());
    bench.PauseTiming();
    Bytes out, whole;
    encode_snapshot(snapshot->wire(), sent.size() < baseline_age ? nullptr : &sent.front()->wire(), out);
    if (sent.size() >= baseline_age)
      bytes += static_cast<double>(out.size()), most = std::max(most, static_cast<double>(out.size()));
    encode_snapshot(snapshot->wire(), nullptr, whole);
    keyframe = std::max(keyframe, static_cast<double>(whole.size()));
    sent.push_back(std::move(snapshot));
    if (sent.size() > baseline_age) sent.pop_front();
    bench.ResumeTiming();
  }
  bench.counters["puffs"] = static_cast<double>(
      smoke::puffs_of(sent.back()->snapshot().effects, sent.back()->snapshot().simulated_time_s).size());
  bench.counters["bytes_per_s"] = bytes / static_cast<double>(bench.iterations()) * 120.0;
  bench.counters["most_bytes"] = most;
  bench.counters["keyframe_bytes"] = keyframe;
  bench.counters["worst_ms"] = worst_ms;
}
BENCHMARK_CAPTURE(effects_tick, winter_lorry, "winter-lorry", 4)
    ->Name("effects_tick/winter-lorry")
    ->Iterations(1200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(effects_tick, tunnel_fire, "tunnel-fire", 30)
    ->Name("effects_tick/tunnel-fire")
    ->Iterations(1200)
    ->Unit(benchmark::kMicrosecond);
// After 90 s the smoke is at its limit of 20,000 particles.
BENCHMARK_CAPTURE(effects_tick, tunnel_fire_full, "tunnel-fire", 90)
    ->Name("effects_tick/tunnel-fire-full")
    ->Iterations(1200)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace septet::server
