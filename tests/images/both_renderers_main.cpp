/// Draws the motorway in one weather by both renderers, from one description of the instant:
///
///     both_renderers noon|dusk|night|rain|snow|tunnel|frost FOLDER SAMPLES     FOLDER/raster.png, FOLDER/traced.png

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "engine/effects/ice/glass.hpp"
#include "engine/image/png.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/displayed.hpp"
#include "engine/render/renderer.hpp"
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

instant::FrameInput frame(const Motorway& motorway, std::string_view weather) {
  const bool night = weather == "night", rain = weather == "rain", tunnel = weather == "tunnel";
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
