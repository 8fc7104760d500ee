/// A town: its lane graph at load, and vehicle updates a second on all of its lanes; items are vehicles times ticks.

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <benchmark/benchmark.h>

#include "engine/road/opendrive_reader.hpp"
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

/// At 120 Hz after a minute; the argument is the number of vehicles asked for.
void update(benchmark::State& bench) {
  const road::RoadNetwork network = largest_town();
  const LaneGraph graph = build_lane_graph(network);
  const TrafficParameters parameters = motorway_traffic(static_cast<std::uint32_t>(bench.range(0)), 3000.0);
  Random random(1);
  TownState town = populate_town(parameters, network, graph, {}, random);
  for (int tick = 0; tick < 1200; ++tick) advance_town(parameters, network, graph, {}, {}, 0.05, random, town);
  for (auto _ : bench) advance_town(parameters, network, graph, {}, {}, 1.0 / 120.0, random, town);
  bench.SetItemsProcessed(bench.iterations() * bench.range(0));
}
BENCHMARK(update)->Name("town_update")->Arg(100)->Arg(300);

}  // namespace
}  // namespace septet::traffic
