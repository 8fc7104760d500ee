// The road as traffic asks for it: a thousand vehicles on the motorway, each a metre on from where
// it was.
#include <stdexcept>
#include <vector>

#include <benchmark/benchmark.h>

#include "engine/core/random.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_locate.hpp"
#include "tests/shipped_files.hpp"

namespace septet::road {
namespace {

const RoadNetwork& motorway() {
  static const RoadNetwork network = [] {
    auto read = read_opendrive(shipped_text("scenarios/motorway-ambulance/motorway.xodr"), "motorway.xodr");
    if (!read) throw std::runtime_error(describe(read.error()));
    return *read;
  }();
  return network;
}

struct Vehicle {
  RoadPosition before;
  Vec2 now_m;
};

std::vector<Vehicle> vehicles() {
  const RoadNetwork& network = motorway();
  Random random(1);
  std::vector<Vehicle> all;
  for (int i = 0; i < 1000; ++i) {
    const auto road = static_cast<RoadIndex>(random.below(3));
    const double s = random.uniform(1.0, network.roads[road].length_m - 1.0);
    const auto lane = static_cast<int>(random.below(5)) + 3;
    const LanePoint point =
        evaluate_lane(network, {road, random.below(2) == 0 ? lane : -lane, s, random.uniform(-0.5, 0.5)});
    const RoadPosition before{road, s - random.uniform(0.0, 1.0), point.t_m};
    all.push_back({before, Vec2(point.road.position_m)});
  }
  return all;
}

template <class Each>
void for_a_thousand(benchmark::State& state, Each each) {
  const auto all = vehicles();
  std::size_t i = 0;
  for (auto _ : state) {
    each(all[i]);
    i = i + 1 < all.size() ? i + 1 : 0;
  }
  state.SetItemsProcessed(state.iterations());
}

void locate_with_hint(benchmark::State& state) {
  for_a_thousand(state, [](const Vehicle& v) { benchmark::DoNotOptimize(locate(motorway(), v.now_m, &v.before)); });
}
BENCHMARK(locate_with_hint)->Name("road_locate/hint");

void locate_cold(benchmark::State& state) {
  for_a_thousand(state, [](const Vehicle& v) { benchmark::DoNotOptimize(locate(motorway(), v.now_m)); });
}
BENCHMARK(locate_cold)->Name("road_locate/cold");

void surface_with_hint(benchmark::State& state) {
  for_a_thousand(state, [](const Vehicle& v) { benchmark::DoNotOptimize(surface_at(motorway(), v.now_m, &v.before)); });
}
BENCHMARK(surface_with_hint)->Name("road_surface/hint");

void evaluate_point(benchmark::State& state) {
  for_a_thousand(state, [](const Vehicle& v) { benchmark::DoNotOptimize(evaluate(motorway(), v.before)); });
}
BENCHMARK(evaluate_point)->Name("road_evaluate");

void evaluate_in_lane(benchmark::State& state) {
  for_a_thousand(state, [](const Vehicle& v) {
    benchmark::DoNotOptimize(evaluate_lane(motorway(), {v.before.road, -5, v.before.s_m, 0.0}));
  });
}
BENCHMARK(evaluate_in_lane)->Name("road_evaluate/lane");

}  // namespace
}  // namespace septet::road
