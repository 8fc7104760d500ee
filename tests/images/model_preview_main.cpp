/// Draws a model's file at three instants, by the rasteriser above and by the ray tracer below, for people to judge:
///
///     model_preview FILE.glb PERIOD_S OUT.png       at a tenth, 45 and 80 % of the period

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <glm/gtc/quaternion.hpp>

#include "engine/editor/shapes.hpp"
#include "engine/image/png.hpp"
#include "engine/instant/instant.hpp"
#include "engine/instant/off_axis_view.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/displayed.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/own_models.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"

namespace septet {
namespace {

constexpr std::uint32_t side_px = 224;

template <typename T>
T must(Expected<T> value) {
  if (value) return std::move(*value);
  std::fprintf(stderr, "model_preview: %s: %s\n", value.error().where.c_str(), value.error().what.c_str());
  std::exit(1);
}
void must(const Expected<void>& done) {
  if (!done) must(Expected<int>(tl::unexpected(done.error())));
}

/// The model, four metres large, before the eye, a little from its left.
scene::ResolvedScene scene_of(const std::filesystem::path& file) {
  const gltf::Model model = must(scenery::read_own_model(file));
  const glm::vec3 size = model.most_m - model.least_m;
  const double scale = 4.0 / double{std::max({size.x, size.y, size.z})};
  const Quat turned = glm::angleAxis(2.5, Vec3(0.0, 0.0, 1.0));
  const Vec3 middle = turned * (scale * 0.5 * Vec3(model.most_m + model.least_m));
  const editor::Made made =
      must(editor::make_model("model", file, {Vec3(9.0, 0.0, 3.0) - middle, turned, glm::vec3(scale)}, 1000));
  for (const std::string& told : made.messages) std::printf("  %s\n", told.c_str());
  scene::Store store;
  for (const scene::Command& command : made.commands) (void)store.apply(command);
  return scene::resolve(store);
}

instant::FrameInput input_at(const scene::ResolvedScene& scene, double time_s) {
  instant::FrameInput input;
  input.environment.sun_azimuth_rad = 4.3;  // From behind the eye, to its right.
  input.environment.sun_elevation_rad = 0.7;
  input.simulated_time_s = time_s;
  instant::FrameView view;
  view.projection = instant::symmetric_view({0.0, 0.0, 3.6}, 0.0, -0.07, 0.8, 0.8);
  view.viewport = {0, 0, side_px, side_px};
  input.views = {view};
  for (std::uint32_t i = 0; i < scene.prototypes.size(); ++i) {
    instant::DrawnParticipant& drawn = input.participants.emplace_back();
    drawn.prototype = i;
    drawn.world_from_vehicle = scene::pose_at(scene.prototypes[i].motion, time_s).world_from_object;
  }
  return input;
}

void paste(const image::Image& picture, std::uint32_t x, std::uint32_t y, image::Image& sheet) {
  for (std::uint32_t row = 0; row < side_px; ++row)
    for (std::uint32_t column = 0; column < side_px; ++column) sheet.set(x + column, y + row, picture.at(column, row));
}

void draw(const std::filesystem::path& file, double period_s, const std::filesystem::path& out) {
  const scene::ResolvedScene scene = scene_of(file);
  auto rasteriser = must(render::Renderer::create(
      {side_px, side_px, render::DevicePreference::software, false, render::Antialiasing::automatic, nullptr}));
  must(rasteriser.upload(scene));
  auto tracer = must(raytrace::RayTracer::create(scene));
  constexpr std::array<double, 3> shares{0.1, 0.45, 0.8};
  image::Image sheet(3 * side_px, 2 * side_px, {0, 0, 0, 255});
  for (std::uint32_t i = 0; i < shares.size(); ++i) {
    const instant::FrameInput input = input_at(scene, shares[i] * period_s);
    must(rasteriser.draw(input));
    paste(must(rasteriser.read_back()), i * side_px, 0, sheet);
    constexpr std::uint32_t samples = 24;
    tracer.begin(instant::describe(input, instant::summarise(scene)), {.samples = samples});
    paste(raytrace::displayed(raytrace::whole_picture(tracer, side_px, side_px), tracer.instant().exposure),
          i * side_px, side_px, sheet);
  }
  must(image::write_png(out, sheet));
}

}  // namespace
}  // namespace septet

int main(int count, char** arguments) {
  if (count != 4) return std::fputs("model_preview FILE.glb PERIOD_S OUT.png\n", stderr), 2;
  septet::draw(arguments[1], std::strtod(arguments[2], nullptr), arguments[3]);
}
