/// A town: its lane graph at load, and vehicle updates a second on all of its lanes; items are vehicles times ticks.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <benchmark/benchmark.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "engine/traffic/network/town.hpp"
#include "engine/traffic/traffic.hpp"
#include "tests/checkout.hpp"

namespace septet::traffic {
namespace {

road::RoadNetwork largest_town() {
  const auto path = std::filesystem::path(source_folder()) / "tests/conformance/data/towns/Town03.xodr";
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return road::read_opendrive(text, path.string()).value();
}

/// Lanes, links and conflicts; the counter is what 50 km of such roads take.
void lane_graph(benchmark::State& bench) {
  const road::RoadNetwork network = largest_town();
  double roads_m = 0.0;
  for (const road::Road& road : network.roads) roads_m += road.length_m;
  for (auto _ : bench) benchmark::DoNotOptimize(build_lane_graph(network).conflicts.size());
  bench.counters["s_for_50_km"] = benchmark::Counter(static_cast<double>(bench.iterations()) * roads_m / 50'000.0,
                                                     benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(lane_graph)->Name("town_lane_graph")->Unit(benchmark::kMillisecond);

/// Views at all junctions past the town's houses and walls.
void look_past(benchmark::State& bench) {
  const road::RoadNetwork network = largest_town();
  const roadside::Obstacles obstacles(network, 1);
  LaneGraph graph = build_lane_graph(network);
  for (auto _ : bench) look_past_walls(obstacles.walls(), graph);
  bench.counters["junctions"] = static_cast<double>(network.junctions.size());
  bench.counters["hidden"] = static_cast<double>(
      std::ranges::count_if(graph.conflicts, [](const WayConflict& c) { return std::isfinite(c.seen_from_m); }));
}
BENCHMARK(look_past)->Name("town_look_past_walls")->Unit(benchmark::kMillisecond);

/// At 120 Hz after a minute; arguments: the number of vehicles asked for; 1: houses and walls hide junctions.
void update(benchmark::State& bench) {
  const road::RoadNetwork network = largest_town();
  LaneGraph graph = build_lane_graph(network);
  if (bench.range(1) != 0) look_past_walls(roadside::Obstacles(network, 1).walls(), graph);
  const TrafficParameters parameters = motorway_traffic(static_cast<std::uint32_t>(bench.range(0)), 3000.0);
  Random random(1);
  TownState town = populate_town(parameters, network, graph, {}, random);
  for (int tick = 0; tick < 1200; ++tick) advance_town(parameters, network, graph, {}, {}, 0.05, random, town);
  for (auto _ : bench) advance_town(parameters, network, graph, {}, {}, 1.0 / 120.0, random, town);
  bench.SetItemsProcessed(bench.iterations() * bench.range(0));
}
BENCHMARK(update)->Name("town_update")->Args({100, 0})->Args({300, 0})->Args({100, 1})->Args({300, 1});

}  // namespace
}  // namespace septet::traffic
