/// Facades of a village that no sun reaches, drawn by both renderers from one description of the instant: how alike
/// their hue is.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/image/png.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/displayed.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "engine/render/renderer.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/roadside/road_shape.hpp"
#include "engine/roadside/street.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/images/lab.hpp"
#include "tests/shipped_files.hpp"

namespace septet {
namespace {

constexpr std::uint32_t facade_width_px = 96, facade_height_px = 64, facade_samples = 96;
constexpr double before_wall_m = 14.0;

/// Mean of L*a*b* over the picture's middle, which the wall fills with its windows.
glm::dvec3 wall_lab(const image::Image& picture) {
  glm::dvec3 sum(0.0);
  int count = 0;
  for (std::uint32_t y = picture.height / 4; y < 3 * picture.height / 4; ++y)
    for (std::uint32_t x = picture.width / 4; x < 3 * picture.width / 4; ++x, ++count) sum += lab(picture.at(x, y));
  return sum / double(count);
}

}  // namespace

TEST_CASE("by day a facade in shade has the same hue in both renderers") {
  const auto network =
      road::read_opendrive(shipped_text("scenarios/first-lesson/first-lesson.xodr"), "first-lesson.xodr");
  REQUIRE(network.has_value());
  scene::Store store;
  scene::SceneBuilder builder(store);
  scenery::build_road_world(builder, *network, 1);
  const scene::ResolvedScene scene = scene::resolve(store);
  render::Renderer renderer =
      *render::Renderer::create({facade_width_px, facade_height_px, render::DevicePreference::software, false,
                                 render::Antialiasing::automatic, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  raytrace::RayTracer tracer = *raytrace::RayTracer::create(scene);

  const std::vector<roadside::TownHouse> houses =
      roadside::town_houses(roadside::RoadShape(*network, roadside::usual_overrun_m), 1);
  constexpr std::size_t frames = 10;
  REQUIRE(houses.size() > frames);
  for (std::size_t n = 0; n < frames; ++n) {
    const roadside::TownHouse& house = houses[n * houses.size() / frames];
    const Vec3 street = house.world_from_house.orientation * Vec3(0, -1, 0);
    const double depth_m = roadside::size_of(house.kind).depth_m;
    instant::FrameInput input;
    instant::FrameView view;
    view.world_from_car = house.world_from_house;
    // From the street at the height of the wall's middle, beside the door.
    view.projection =
        instant::symmetric_view(Vec3(3.0, -0.5 * depth_m - before_wall_m, 1.6), 0.5 * 3.14159265, 0.0, 0.30, 0.15);
    view.viewport = {0, 0, facade_width_px, facade_height_px};
    input.views = {view};
    input.simulated_time_s = 2.0;
    input.environment.cloud_cover = 0.25;
    // Azimuth from north by the sun: behind the house, a little to the side.
    input.environment.sun_azimuth_rad = std::atan2(-street.x, -street.y) + (n % 2 == 0 ? 0.5 : -0.5);
    input.environment.sun_elevation_rad = 0.25 + 0.09 * static_cast<double>(n);
    REQUIRE(renderer.draw(input).has_value());
    const image::Image raster = *renderer.read_back();
    tracer.begin(instant::describe(input, instant::summarise(scene)), {.samples = facade_samples});
    const image::Image traced = raytrace::displayed(raytrace::whole_picture(tracer, facade_width_px, facade_height_px),
                                                    tracer.instant().exposure);
    if (const char* folder = std::getenv("SEPTET_PICTURES")) {
      CHECK(image::write_png(fmt::format("{}/facade-{}-raster.png", folder, n), raster).has_value());
      CHECK(image::write_png(fmt::format("{}/facade-{}-traced.png", folder, n), traced).has_value());
    }
    const glm::dvec3 drawn = wall_lab(raster), judged = wall_lab(traced);
    CAPTURE(n);
    CAPTURE(drawn.x);
    CAPTURE(judged.x);
    // The most that was found is 2.3, where a low sun lights red houses across the street.
    constexpr double alike = 3.0;
    CHECK(std::abs(drawn.z - judged.z) <= alike);
  }
}

}  // namespace septet
