// One virtual screen on lavapipe, from the scenario's motorway with traffic: CPU time of drawing a frame and reading it
// back, the shaders' compilation not counted. LP_NUM_THREADS=0 keeps Mesa on one thread. By day, and in each weather by
// its name.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "engine/core/random.hpp"
#include "engine/instant/atmosphere.hpp"
#include "engine/render/passes/smoke_pass.hpp"
#include "engine/render/passes/smoke_shade.hpp"
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

struct Weather {
  Environment environment;
  bool lamps = false;
  double s_m = 500.0;    ///< Where the road is looked at.
  bool smoking = false;  ///< A plume of 20,000 puffs crosses the road in the sun.
};

Weather weather_named(std::string_view name) {
  Weather weather{reference_day()};
  Environment& environment = weather.environment;
  weather.lamps = name != "day";
  if (name == "dusk" || name == "rain_at_dusk") {
    environment.sun_elevation_rad = 0.02;
    environment.sun_illuminance_lux = 1500.0;
  }
  if (name == "rain_at_dusk") {
    environment.rain_mm_per_h = 8.0;
    environment.road_wetness = 0.8;
    environment.cloud_cover = 1.0;
    environment.visibility_m = 3000.0;
    environment.temperature_k = 280.0;
    environment.wind_speed_mps = 4.0;
  } else if (name == "night") {
    environment.sun_elevation_rad = -0.4;
    environment.sun_illuminance_lux = 0.0;
  } else if (name == "snow") {
    environment.rain_mm_per_h = 2.0;
    environment.snow_cover = 1.0;
    environment.cloud_cover = 1.0;
    environment.visibility_m = 1500.0;
    environment.temperature_k = 268.0;
    environment.wind_speed_mps = 4.0;
  } else if (name == "fog") {
    environment.cloud_cover = 1.0;
    environment.visibility_m = 150.0;
  } else if (name == "tunnel") {
    weather.s_m = 3350.0;
  } else if (name == "smoke") {
    weather.lamps = false;
    weather.smoking = true;
  }
  return weather;
}

/// 60 m long, aslant over the road from 60 m ahead on.
std::vector<SmokePuff> plume_over(const RigidTransform& world_from_lane) {
  Random random(4);
  std::vector<SmokePuff> puffs(20'000);
  for (std::uint32_t i = 0; i < puffs.size(); ++i) {
    const double along = random.uniform(0.0, 60.0);
    puffs[i].position_m = world_from_lane * Vec3(60.0 + 0.8 * along + random.uniform(-4.0, 4.0),
                                                 0.6 * along - 20.0 + random.uniform(-4.0, 4.0),
                                                 4.0 + 0.2 * along + random.uniform(-3.0, 3.0));
    puffs[i].radius_m = 1.0f;
    puffs[i].extinction_area_m2 = 0.1f;
    puffs[i].seed = i;
  }
  return puffs;
}

/// The motorway in a weather, with traffic from where it is looked at on; without views.
FrameInput traffic_in(const Weather& weather) {
  const Motorway& world = motorway();
  FrameInput input;
  input.environment = weather.environment;
  if (weather.smoking) input.smoke = plume_over(in_lane(-4, weather.s_m));
  for (int i = 0; i < 24; ++i) {
    DrawnParticipant car;
    car.prototype = static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(world.scene.prototypes.size());
    car.world_from_vehicle = in_lane(-2 - i % 5, weather.s_m + 25.0 * i);
    car.paint = body_color(static_cast<std::uint8_t>(i));
    car.lamps.set(Lamp::low_beam, weather.lamps);
    car.velocity_mps = car.world_from_vehicle.orientation * Vec3(25.0, 0.0, 0.0);
    car.raises_spray = true;
    car.number = static_cast<std::uint32_t>(i);
    input.participants.push_back(car);
  }
  return input;
}

/// Map of the shade below the plume, from its puffs as they are merged.
void smoke_shade_map(benchmark::State& state) {
  const RigidTransform eye = in_lane(-4, 500.0);
  const std::vector<SmokePuff> puffs = merged_puffs(plume_over(eye), eye.position_m);
  const ShadowCascades sun = shadow_cascades(eye.position_m, sky_light(reference_day()).light_direction);
  for (auto unused : state) benchmark::DoNotOptimize(smoke_shade(puffs, {}, sun));
  state.counters["merged_puffs"] = static_cast<double>(puffs.size());
}
BENCHMARK(smoke_shade_map)->Unit(benchmark::kMicrosecond);

void virtual_screen_frame(benchmark::State& state, std::uint32_t width, std::uint32_t height, std::string_view name,
                          bool timed = false, Antialiasing antialiasing = Antialiasing::automatic) {
  auto renderer =
      must(Renderer::create({width, height, DevicePreference::software, false, antialiasing, nullptr, timed}));
  must(renderer.upload(motorway().scene));
  const Weather weather = weather_named(name);
  FrameInput input = traffic_in(weather);
  double s_m = weather.s_m - 10.0;
  const auto draw = [&] {
    input.simulated_time_s += 0.1;
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

/// Seven screens of 1920 × 1080 around the eye on a graphics card, each with all its effects, one after the other:
/// frames of all seven a second, and the time of each pass of the seven by the device's clock.
void seven_screens(benchmark::State& state, std::string_view name, bool validated) {
  constexpr std::uint32_t width = 1920, height = 1080, screens = 7;
  std::vector<Renderer> renderers;
  for (std::uint32_t i = 0; i < screens; ++i) {
    renderers.push_back(
        must(Renderer::create({.width = width, .height = height, .validation = validated, .timed = true})));
    if (renderers.back().device_name().starts_with("llvmpipe")) {
      state.SkipWithError("no graphics card");
      return;
    }
    must(renderers.back().upload(motorway().scene));
  }
  const Weather weather = weather_named(name);
  FrameInput input = traffic_in(weather);
  double s_m = weather.s_m - 10.0;
  const auto draw_all = [&] {
    input.simulated_time_s += 1.0 / 60.0;
    s_m += 0.4;
    for (std::uint32_t i = 0; i < screens; ++i) {
      // Five of 44° ahead, two of 30° behind.
      const double heading_deg = i < 5 ? 44.0 * (i - 2.0) : i == 5 ? 150.0 : -150.0, across_deg = i < 5 ? 44.0 : 30.0;
      constexpr double rad = std::numbers::pi / 180.0;
      input.views = {forward_view({0, 0, 0}, width, height)};
      input.views[0].projection =
          symmetric_view({1.35, 0.37, 1.17}, heading_deg * rad, 0.0, across_deg * rad,
                         2.0 * std::atan(std::tan(0.5 * across_deg * rad) * static_cast<double>(height) / width));
      input.views[0].world_from_car = in_lane(-4, s_m);
      must(renderers[i].draw(input));
    }
  };
  for (int warm = 0; warm < 3; ++warm) draw_all();
  for (auto unused : state) draw_all();
  double sum_ms = 0.0, messages = 0.0;
  for (const Renderer& renderer : renderers) {
    messages += renderer.statistics().validation_messages;
    for (const PassTime& pass : renderer.statistics().pass_times) {
      state.counters[std::string(pass.name)].value += pass.time_ms;
      sum_ms += pass.time_ms;
    }
  }
  state.counters["all_passes"] = sum_ms;
  if (validated) state.counters["validation_messages"] = messages;
  state.counters["frames_of_all"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.SetLabel(std::string(renderers.front().device_name()));
}

void thirty_frames_thrice(benchmark::internal::Benchmark* frame) {
  frame->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Iterations(30)
      ->Repetitions(3)
      ->ReportAggregatesOnly();
}

BENCHMARK_CAPTURE(virtual_screen_frame, 640x420, 640, 420, "day")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 320x240, 320, 240, "day")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_temporal, 640, 420, "day", false, Antialiasing::temporal)
    ->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_dusk, 640, 420, "dusk")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_rain_at_dusk, 640, 420, "rain_at_dusk")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_night, 640, 420, "night")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_snow, 640, 420, "snow")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_fog, 640, 420, "fog")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_smoke, 640, 420, "smoke")->Apply(thirty_frames_thrice);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_tunnel, 640, 420, "tunnel")->Apply(thirty_frames_thrice);

void ten_frames(benchmark::internal::Benchmark* frames) { frames->Unit(benchmark::kMillisecond)->Iterations(10); }
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_by_passes_ms, 640, 420, "day", true)->Apply(ten_frames);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_rain_at_dusk_by_passes_ms, 640, 420, "rain_at_dusk", true)
    ->Apply(ten_frames);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_smoke_by_passes_ms, 640, 420, "smoke", true)->Apply(ten_frames);
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_tunnel_by_passes_ms, 640, 420, "tunnel", true)->Apply(ten_frames);

void on_a_card(benchmark::internal::Benchmark* frames) {
  frames->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(240);
}
BENCHMARK_CAPTURE(seven_screens, 1920x1080_by_passes_ms, "day", false)->Apply(on_a_card);
BENCHMARK_CAPTURE(seven_screens, 1920x1080_rain_at_dusk_by_passes_ms, "rain_at_dusk", false)->Apply(on_a_card);
BENCHMARK_CAPTURE(seven_screens, 1920x1080_night_by_passes_ms, "night", false)->Apply(on_a_card);
BENCHMARK_CAPTURE(seven_screens, 1920x1080_tunnel_by_passes_ms, "tunnel", false)->Apply(on_a_card);
BENCHMARK_CAPTURE(seven_screens, 1920x1080_rain_at_dusk_validated, "rain_at_dusk", true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(5);

}  // namespace
}  // namespace septet::render
