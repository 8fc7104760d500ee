// One virtual screen on lavapipe, from the scenario's motorway with traffic: CPU time of drawing a frame and reading it
// back, the shaders' compilation not counted. LP_NUM_THREADS=0 keeps Mesa on one thread.
#include <algorithm>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>

#include "engine/render/renderer.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/world/paint.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/shipped_files.hpp"

namespace septet::render {
namespace {

template <class T>
T must(Expected<T> result) {
  if (!result) throw std::runtime_error(describe(result.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

struct Motorway {
  road::RoadNetwork network;
  scene::ResolvedScene scene;
};

const Motorway& motorway() {
  static const Motorway world = [] {
    Motorway result{
        must(road::read_opendrive(shipped_text("scenarios/motorway-ambulance/motorway.xodr"), "motorway.xodr")), {}};
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder);
    scenery::build_road_world(builder, result.network, 1);
    result.scene = scene::resolve(store);
    return result;
  }();
  return world;
}

RigidTransform in_lane(int lane, double s_m) {
  return road::world_from_lane(road::evaluate_lane(motorway().network, {0, lane, s_m, 0.0}));
}

void virtual_screen_frame(benchmark::State& state, std::uint32_t width, std::uint32_t height, Antialiasing antialiasing,
                          bool timed = false) {
  auto renderer =
      must(Renderer::create({width, height, DevicePreference::software, false, antialiasing, nullptr, timed}));
  const Motorway& world = motorway();
  must(renderer.upload(world.scene));
  FrameInput input;
  input.environment = reference_day();
  for (int i = 0; i < 24; ++i) {
    DrawnParticipant car;
    car.prototype = static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(world.scene.prototypes.size());
    car.world_from_vehicle = in_lane(-2 - i % 5, 500.0 + 25.0 * i);
    car.paint = body_color(static_cast<std::uint8_t>(i));
    input.participants.push_back(car);
  }
  double s_m = 490.0;
  const auto draw = [&] {
    input.views = {forward_view({0, 0, 0}, width, height)};
    input.views[0].world_from_car = in_lane(-4, s_m);
    must(renderer.draw(input));
    benchmark::DoNotOptimize(must(renderer.read_back()));
  };
  draw();
  double triangles = 0.0;
  for (auto unused : state) {
    s_m += 3.0;
    draw();
    triangles = std::max(triangles, double(renderer.statistics().triangles));
  }
  for (const PassTime& pass : renderer.statistics().pass_times) state.counters[std::string(pass.name)] = pass.time_ms;
  state.counters["most_triangles"] = triangles;
  state.counters["draws"] = renderer.statistics().draws;
}

BENCHMARK_CAPTURE(virtual_screen_frame, 640x420, 640, 420, Antialiasing::automatic)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(30)
    ->Repetitions(3)
    ->ReportAggregatesOnly();
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_by_passes_ms, 640, 420, Antialiasing::automatic, true)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);
BENCHMARK_CAPTURE(virtual_screen_frame, 320x240, 320, 240, Antialiasing::automatic)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(30)
    ->Repetitions(3)
    ->ReportAggregatesOnly();

}  // namespace
}  // namespace septet::render
