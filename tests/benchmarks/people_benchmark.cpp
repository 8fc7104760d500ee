/// People of a swarm: their walkways at load, and a tick of them; the counter is the share of a core that they take at 120 Hz.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <benchmark/benchmark.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/simulation/walkways_of_drive.hpp"
#include "engine/traffic/people/people.hpp"
#include "tests/checkout.hpp"

namespace septet::traffic {
namespace {

road::RoadNetwork shipped_town() {
  const auto path = std::filesystem::path(source_folder()) / "scenarios/town/town.xodr";
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return road::read_opendrive(text, path.string()).value();
}

void walkways_at_load(benchmark::State& bench) {
  const road::RoadNetwork network = shipped_town();
  const roadside::Obstacles obstacles(network, 1);
  const roadside::RaisedAreas raised(network);
  for (auto _ : bench) benchmark::DoNotOptimize(simulation::walkways_of(network, obstacles, raised, {}).walks.size());
}
BENCHMARK(walkways_at_load)->Name("people_walkways")->Unit(benchmark::kMillisecond);

/// After a minute; argument: how many are asked for within 250 m.
void update(benchmark::State& bench) {
  const road::RoadNetwork network = shipped_town();
  const WalkwayGraph graph =
      simulation::walkways_of(network, roadside::Obstacles(network, 1), roadside::RaisedAreas(network), {});
  constexpr double tick_s = 1.0 / 120.0;
  PeopleAround around;
  around.driver_eyes_m = Vec3(0.5 * (network.low_m + network.high_m), 1.2);
  const PeopleWish wish{static_cast<std::uint32_t>(bench.range(0)), 250.0};
  PeopleState people = populate_people(wish, graph, around, 1);
  for (int tick = 0; tick < 7200; ++tick) advance_people(wish, graph, around, tick_s, people);
  for (auto _ : bench) advance_people(wish, graph, around, tick_s, people);
  bench.SetItemsProcessed(bench.iterations() * bench.range(0));
  bench.counters["core_share"] = benchmark::Counter(tick_s * static_cast<double>(bench.iterations()),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(update)->Name("people_update")->Arg(100)->Arg(200)->Arg(500);

}  // namespace
}  // namespace septet::traffic
