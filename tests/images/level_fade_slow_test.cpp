/// Changes between a picture and the next one as the eye drives on, where objects take another level of detail.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/image/image.hpp"
#include "engine/instant/level_fade.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet {
namespace {

constexpr std::uint32_t side_px = 128;
constexpr double tick_m = 100.0 / 3.6 / 120.0;  // At 100 km/h.

scene::ResolvedScene scene_of(const std::string& objects) {
  road::SmallRoad small;
  small.length_m = 400.0;
  const road::RoadNetwork network =
      road::read_or_fail(road::replaced(small.xml(), "</lanes>", "</lanes><objects>" + objects + "</objects>"));
  scene::Store store;
  scene::SceneBuilder builder(store);
  scenery::build_vehicles(builder);
  scenery::build_road_world(builder, network, 1);
  return scene::resolve(store);
}

/// Mean change of a pixel (of 255) from each tick to the next, with the eye at x = `from_m` and then on until `to_m`,
/// looking ahead at objects `at_m` from the road's begin. As many pixels an angle as on a screen of 640 × 420.
std::vector<double> changes(const scene::ResolvedScene& scene, instant::FrameInput input, const Vec3& at_m,
                            double from_m, double to_m) {
  render::Renderer renderer = *render::Renderer::create(
      {side_px, side_px, render::DevicePreference::software, true, render::Antialiasing::automatic, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  std::vector<double> result;
  std::vector<std::uint8_t> before;
  for (int tick = 0; from_m + tick * tick_m < to_m; ++tick) {
    const Vec3 eye_m(from_m + tick * tick_m, -1.75, 1.2);
    const Vec3 way = at_m - eye_m;
    instant::FrameView view;
    view.projection = instant::symmetric_view(Vec3(0.0), std::atan2(way.y, way.x), 0.0, 0.159, 0.159);
    view.world_from_car.position_m = eye_m;
    view.viewport = {0, 0, side_px, side_px};
    input.views = {view};
    input.simulated_time_s = 20.0;
    REQUIRE(renderer.draw(input).has_value());
    const image::Image picture = *renderer.read_back();
    if (!before.empty()) {
      double sum = 0.0;
      for (std::size_t i = 0; i < before.size(); ++i) sum += std::abs(picture.rgba[i] - before[i]);
      result.push_back(sum / (0.75 * static_cast<double>(before.size())));
    }
    before = picture.rgba;
  }
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return result;
}

/// The largest change over the median of those of twelve ticks before and behind it.
double largest_jump(const std::vector<double>& change) {
  double worst = 0.0;
  for (std::size_t i = 0; i < change.size(); ++i) {
    std::vector<double> around;
    for (std::size_t k = i < 12 ? 0 : i - 12; k < std::min(change.size(), i + 13); ++k)
      if (k != i) around.push_back(change[k]);
    std::ranges::nth_element(around, around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2));
    worst = std::max(worst, change[i] / std::max(around[around.size() / 2], 0.05));
  }
  return worst;
}

}  // namespace

TEST_CASE(
    "a tree that one drives towards does not jump where its picture gives way to its leaves, nor does its shadow") {
  const scene::ResolvedScene scene = scene_of(R"(<object id="1" type="tree" s="250" t="9" height="11"/>)");
  const std::vector<double> change = changes(scene, {}, {250.0, 9.0, 4.0}, 137.0, 163.0);
  CHECK(largest_jump(change) < 1.8);  // 5.4 where it changes at once.
}

TEST_CASE("a car that one nears does not jump where its windows become glass") {
  const scene::ResolvedScene scene = scene_of("");
  instant::FrameInput input;
  instant::DrawnParticipant car;
  const auto found = std::ranges::find(scene.prototypes, "volvo-s80", &scene::Prototype::name);
  REQUIRE(found != scene.prototypes.end());
  car.prototype = static_cast<std::uint32_t>(found - scene.prototypes.begin());
  car.world_from_vehicle.position_m = {200.0, -1.75, 0.0};
  input.participants = {car};
  const std::vector<double> change = changes(scene, input, {200.0, -1.75, 0.8}, 158.0, 170.0);
  CHECK(largest_jump(change) < 1.8);
}

}  // namespace septet
