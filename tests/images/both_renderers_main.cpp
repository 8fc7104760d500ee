/// Draws the motorway in one weather by both renderers, from one description of the instant:
///
///     both_renderers noon|dusk|night|rain|snow|tunnel|frost|fire|plume FOLDER SAMPLES     FOLDER/raster.png, FOLDER/traced.png

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "engine/core/random.hpp"
#include "engine/effects/ice/glass.hpp"
#include "engine/image/png.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/displayed.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {
namespace {

template <typename T>
T must(Expected<T> value) {
  if (value) return std::move(*value);
  std::fprintf(stderr, "both_renderers: %s: %s\n", value.error().where.c_str(), value.error().what.c_str());
  std::exit(1);
}
void must(const Expected<void>& done) {
  if (!done) must(Expected<int>(tl::unexpected(done.error())));
}

/// A windscreen before the eye, on which the blower has worked for two minutes.
ice::IceBody frosted_pane(const instant::FrameView& view) {
  ice::Frost frost = ice::morning_frost(268.15, 3);
  for (int i = 0; i < 480; ++i) ice::warm(frost, 268.15, 8.0, 0.25);
  const auto turned = [&](const Vec3& way) { return view.world_from_car.orientation * way; };
  ice::IceBody pane;
  pane.look.on_glass = ice::OnGlass::frost;
  pane.origin_m = instant::world_eye(view);
  pane.vertices = ice::frost_surface(ice::pane_between(turned({1.3, -0.9, -0.3}), turned({1.3, 0.9, -0.3}),
                                                       turned({1.0, -0.9, 0.6}), turned({1.0, 0.9, 0.6}), 0.0),
                                     frost);
  return pane;
}

/// Half of the light of road and vehicles ahead is lost to soot, the lamps' and signs' too, and thin smoke stands
/// beside them.
void burn(instant::FrameInput& input) {
  const RigidTransform& world_from_car = input.views.front().world_from_car;
  instant::SootField& soot = input.soot;
  soot.world_from_field = {world_from_car * Vec3(6.0, -16.0, -1.0), world_from_car.orientation};
  soot.cell_m = 2.0;
  soot.nx = 24, soot.ny = 16, soot.nz = 6;
  soot.cover.assign(static_cast<std::size_t>(soot.nx * soot.ny * soot.nz), 128);
  for (int i = 0; i < 6; ++i) {
    instant::SmokePuff puff;
    puff.position_m = world_from_car * Vec3(24.0 + 2.0 * i, 5.0 - i, 1.0 + 0.5 * i);
    puff.radius_m = 1.5f;
    puff.extinction_area_m2 = 6.0f;
    puff.seed = static_cast<std::uint32_t>(i);
    input.smoke.push_back(puff);
  }
}

/// Smoke drifts over the road from the side of the sun, which throws its shade on it.
void drift(instant::FrameInput& input) {
  const RigidTransform& world_from_car = input.views.front().world_from_car;
  Random random(6);
  for (std::uint32_t i = 0; i < 2500; ++i) {
    const double along = random.uniform();
    instant::SmokePuff puff;
    puff.position_m = world_from_car * Vec3(24.0 + 10.0 * along + random.uniform(-3.0, 3.0),
                                            14.0 - 22.0 * along + random.uniform(-3.0, 3.0),
                                            2.0 + 7.0 * along + random.uniform(-2.0, 2.0));
    puff.radius_m = 1.2f;
    puff.extinction_area_m2 = 0.3f;
    puff.seed = i;
    input.smoke.push_back(puff);
  }
}

instant::FrameInput frame(const Motorway& motorway, std::string_view weather) {
  const bool night = weather == "night" || weather == "fire", rain = weather == "rain", tunnel = weather == "tunnel";
  instant::FrameInput input = motorway.frame({"", tunnel ? 3350.0 : 800.0, 0.0, night, rain});
  if (weather == "dusk") {
    input.environment.sun_elevation_rad = 0.02;
    input.environment.sun_illuminance_lux = 1500.0;
  }
  if (weather == "snow") {
    input.environment.snow_cover = 1.0;
    input.environment.cloud_cover = 1.0;
    input.environment.temperature_k = 268.0;
    input.environment.visibility_m = 4000.0;
  }
  if (weather == "fire") burn(input);
  if (weather == "plume") {
    drift(input);
    input.environment.cloud_cover = 0.0;
  }
  if (weather == "frost") input.glass.push_back(frosted_pane(input.views.front()));
  return input;
}

void draw(std::string_view weather, const std::filesystem::path& folder, std::uint32_t samples) {
  const Motorway motorway;
  constexpr std::uint32_t width = motorway_width_px, height = motorway_height_px;
  auto rasteriser = must(render::Renderer::create(
      {width, height, render::DevicePreference::software, false, render::Antialiasing::automatic, nullptr}));
  must(rasteriser.upload(motorway.scene()));
  must(rasteriser.draw(frame(motorway, weather)));
  must(image::write_png(folder / "raster.png", must(rasteriser.read_back())));
  auto tracer = must(raytrace::RayTracer::create(motorway.scene()));
  tracer.begin(instant::describe(frame(motorway, weather), instant::summarise(motorway.scene())), {.samples = samples});
  const auto traced = raytrace::whole_picture(tracer, width, height);
  must(image::write_png(folder / "traced.png", raytrace::displayed(traced, tracer.instant().exposure)));
}

}  // namespace
}  // namespace septet

int main(int count, char** arguments) {
  if (count != 4) return std::fputs("both_renderers WEATHER FOLDER SAMPLES\n", stderr), 2;
  septet::draw(arguments[1], arguments[2], static_cast<std::uint32_t>(std::strtoul(arguments[3], nullptr, 10)));
}
