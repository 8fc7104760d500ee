// Cost of ice in a drive: the front screen of 640 × 420 of the scenario winter-lorry on lavapipe while slabs lie,
// slide, break and lie in pieces, through a windscreen in frost, and the same frames without ice and frost. Processor
// time of drawing and reading back; `times` is the factor of ice.
#include <ctime>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "engine/core/check.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/debris_looks.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "program/resources.hpp"
#include "sim-client/frame/client_frame.hpp"
#include "sim-client/frame/effects_drawing.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"

namespace septet::server {
namespace {

template <class T>
T must(Expected<T> result) {
  if (!result) throw std::runtime_error(describe(result.error()));
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// Frames of the drive, a second apart, and their content.
struct WinterDrive {
  scene::ResolvedScene scene;
  std::vector<instant::FrameInput> frames;
};

const WinterDrive& winter_drive() {
  static const WinterDrive made = [] {
    constexpr int first_s = 3, last_s = 12, ticks_apart = 120;
    const auto scenario = program::find_resource("winter-lorry", "scenarios", ".xosc");
    const auto rig = program::find_resource("desktop", "rigs", ".toml");
    SEPTET_CHECK(scenario && rig, "the shipped scenario and rig are missing");
    const LoadedDrive loaded = must(load_drive(DriveFiles{scenario->string(), rig->string(), 1}));
    WinterDrive result;
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder);
    scenery::build_debris_looks(builder);
    scenery::build_road_world(builder, loaded.model->roads, 1, {.raised = loaded.model->raised.get()});
    result.scene = scene::resolve(store);
    rig::Screen screen = loaded.rig.screens.front();
    screen.width_px = 640;
    screen.height_px = 420;
    const frame::ScreenViews views = must(frame::screen_views(loaded.rig, screen));
    auto drive = must(LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, 1),
                                       must(open_driver_seat(rig::Car{}, 1, loaded.model))));
    frame::TickHistory history;
    frame::EffectsDrawing effects;
    for (int tick = 1; tick <= 120 * last_s; ++tick) {
      const auto taken = must(drive->next(std::nullopt));
      const Snapshot& snapshot = taken->snapshot();
      history.add(frame::HistoryTick{{}, taken->wire(), snapshot});
      history.forget_before(snapshot.simulated_time_s - 0.5);
      if (tick < 120 * first_s || tick % ticks_apart != 0) continue;
      effects.show(snapshot, history, 1.0 / 120.0, result.scene);
      result.frames.push_back(frame::client_frame(snapshot, views, frame::driver_viewpoint(snapshot), result.scene));
      effects.add_to(result.frames.back());
    }
    return result;
  }();
  return made;
}

double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double lower_quartile(std::vector<double> of) {
  std::ranges::sort(of);
  return of[of.size() / 4];
}

instant::FrameInput without_ice(instant::FrameInput frame) {
  frame.ice.clear();
  frame.glass.clear();
  for (instant::DynamicMesh& mesh : frame.meshes) mesh.seen = true;
  return frame;
}

/// Each frame in turn with and without ice, some rounds of it; of each the lower quartile of the processor's time, so
/// that other load disturbs both alike.
void winter_lorry(benchmark::State& state) {
  const WinterDrive& drive = winter_drive();
  auto renderer = must(render::Renderer::create(
      {640, 420, render::DevicePreference::software, false, render::Antialiasing::automatic, nullptr}));
  must(renderer.upload(drive.scene));
  const auto cost_of = [&](instant::FrameInput frame) {
    const double begin_s = processor_s();
    must(renderer.draw(std::move(frame)));
    benchmark::DoNotOptimize(must(renderer.read_back()));
    return processor_s() - begin_s;
  };
  for (const instant::FrameInput& frame : drive.frames) cost_of(frame), cost_of(without_ice(frame));
  double with_ms = 0.0, without_ms = 0.0, most = 0.0;
  for (auto unused : state)
    for (const instant::FrameInput& frame : drive.frames) {
      constexpr int rounds = 7;
      std::vector<double> with, without;
      for (int round = 0; round < rounds; ++round) {
        with.push_back(1e3 * cost_of(frame));
        without.push_back(1e3 * cost_of(without_ice(frame)));
      }
      with_ms += lower_quartile(with);
      without_ms += lower_quartile(without);
      most = std::max(most, lower_quartile(with) / lower_quartile(without));
    }
  const auto frames = static_cast<double>(drive.frames.size());
  state.counters["with_ms"] = with_ms / frames;
  state.counters["without_ms"] = without_ms / frames;
  state.counters["times"] = with_ms / without_ms;
  state.counters["most"] = most;
}
BENCHMARK(winter_lorry)->Name("ice_frame/winter_lorry")->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace septet::server
