/// Traffic: vehicle updates a second on a five-lane ring, one thread; items are vehicles times ticks.

#include <benchmark/benchmark.h>

#include "tests/engine/traffic/ambulance_between_lanes.hpp"
#include "tests/engine/traffic/emergency_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"

namespace septet::traffic {
namespace {

/// 20 vehicles/km/lane, ticks of 0.1 s, as the peers are measured.
void update(benchmark::State& bench) {
  const auto count = static_cast<std::uint32_t>(bench.range(0));
  const auto network = ring_road(count * 10.0, 5);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, 5, count, 1);
  Random random(1);
  for (int tick = 0; tick < 600; ++tick) advance(parameters, network, {}, 0.1, random, state);
  for (auto _ : bench) advance(parameters, network, {}, 0.1, random, state);
  bench.SetItemsProcessed(bench.iterations() * bench.range(0));
}
BENCHMARK(update)->Name("traffic_update")->Arg(100)->Arg(1000)->Arg(4000);

/// The same with an ambulance, to which all within 300 m yield.
void update_with_ambulance(benchmark::State& bench) {
  const auto count = static_cast<std::uint32_t>(bench.range(0));
  const auto network = ring_road(count * 10.0, 5);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, 5, count, 1);
  add_emergency_vehicle(state.corridors[0], 1, 0.0, 20.0);
  Random random(1);
  for (int tick = 0; tick < 600; ++tick) advance(parameters, network, {}, 0.1, random, state);
  for (auto _ : bench) advance(parameters, network, {}, 0.1, random, state);
  bench.SetItemsProcessed(bench.iterations() * bench.range(0));
}
BENCHMARK(update_with_ambulance)->Name("traffic_update_with_ambulance")->Arg(1000);

/// From the arrays to poses on the road.
void participants(benchmark::State& bench) {
  const auto count = static_cast<std::uint32_t>(bench.range(0));
  const auto network = ring_road(count * 10.0, 5);
  const TrafficState state = dense_ring(network, 5, count, 1);
  std::vector<Participant> made;
  for (auto _ : bench) {
    made.clear();
    append_participants(state, network, made);
    benchmark::DoNotOptimize(made.data());
  }
  bench.SetItemsProcessed(bench.iterations() * bench.range(0));
}
BENCHMARK(participants)->Name("traffic_participants")->Arg(1000);

/// An ambulance's 5 km through 40 vehicles/km/lane; the argument is the seed.
void emergency_run(benchmark::State& bench) {
  EmergencyRun run;
  for (auto _ : bench) run = drive_5_km(static_cast<std::uint64_t>(bench.range(0)));
  bench.counters["ambulance_mps"] = run.ambulance_mps;
  bench.counters["traffic_mps"] = run.traffic_mps;
  bench.counters["overlaps"] = run.overlaps;
}
BENCHMARK(emergency_run)
    ->Name("traffic_emergency_run")
    ->DenseRange(1, 10)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace septet::traffic
