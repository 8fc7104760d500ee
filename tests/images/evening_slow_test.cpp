/// An overcast evening as pictures, from the driver's eyes on the shipped lesson's country road, lights on: it darkens, and the road stays seen.

#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <glm/trigonometric.hpp>

#include "engine/image/png.hpp"
#include "engine/image/srgb.hpp"
#include "engine/render/renderer.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/world/vehicle_model.hpp"
#include "tests/images/place_codes.hpp"
#include "tests/shipped_files.hpp"

namespace septet {
namespace {

constexpr std::uint32_t evening_width_px = 240, evening_height_px = 158;

struct EveningCodes {
  double sky, land, road;  ///< Mean codes of green.
};

class Evening {
 public:
  Evening()
      : renderer_(*render::Renderer::create({evening_width_px, evening_height_px, render::DevicePreference::software,
                                             false, render::Antialiasing::automatic})) {
    const auto network =
        road::read_opendrive(shipped_text("scenarios/first-lesson/first-lesson.xodr"), "first-lesson.xodr");
    REQUIRE(network.has_value());
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder);
    scenery::build_road_world(builder, *network, 1);
    scene_ = scene::resolve(store);
    REQUIRE(renderer_.upload(scene_).has_value());
    Participant own{.id = 1, .model = *find_vehicle_model("volvo-s80")};
    own.world_from_vehicle = road::world_from_lane(road::evaluate_lane(*network, {0, -1, 900.0, 0.0}));
    own.lamps.set(Lamp::low_beam, true);
    std::uint32_t prototype = 0;
    while (scene_.prototypes.at(prototype).name != "volvo-s80") ++prototype;
    input_.participants = {instant::drawn_participant(own, prototype)};
    input_.participants.front().shown = instant::Shown::shadow_and_light;
    instant::FrameView view;
    view.projection = instant::symmetric_view(Vec3(1.35, 0.37, 1.17), 0.0, 0.0, 0.9, 0.6);
    view.world_from_car = own.world_from_vehicle;
    view.viewport = {0, 0, evening_width_px, evening_height_px};
    input_.views = {view};
    input_.environment.sun_azimuth_rad = 2.2;
    input_.environment.cloud_cover = 1.0;
    input_.simulated_time_s = 2.0;
  }

  EveningCodes at(double sun_elevation_deg) {
    input_.environment.sun_elevation_rad = glm::radians(sun_elevation_deg);
    input_.environment.sun_illuminance_lux = 75000.0;
    REQUIRE(renderer_.draw(input_).has_value());
    const image::Image picture = *renderer_.read_back();
    if (const char* folder = std::getenv("SEPTET_PICTURES"))
      CHECK(image::write_png(fmt::format("{}/evening{:+05.1f}.png", folder, sun_elevation_deg), picture).has_value());
    return {mean(picture, {Vec3(400, 60, 90), Vec3(400, -60, 90), Vec3(400, 0, 110)}),
            mean(picture, {Vec3(25, 11, 0), Vec3(28, 11.5, 0), Vec3(25, -9, 0), Vec3(28, -9.5, 0)}),
            mean(picture, {Vec3(15, -0.6, 0), Vec3(15, 0.0, 0), Vec3(15, 0.6, 0)})};
  }

 private:
  double mean(const image::Image& picture, std::initializer_list<Vec3> places_m) const {
    double sum = 0.0;
    for (const Vec3& place_m : places_m) sum += green_at(picture, input_.views.front().projection, place_m);
    return sum / static_cast<double>(places_m.size());
  }

  render::Renderer renderer_;
  scene::ResolvedScene scene_;
  instant::FrameInput input_;
};

}  // namespace

TEST_CASE("in pictures of an overcast evening neither sky nor land grows brighter as the sun sinks, to midnight") {
  Evening evening;
  constexpr double noise = 0.5;  // Codes are whole.
  EveningCodes before{255.0, 255.0, 255.0};
  double sky_at_dusk = 0.0;
  for (const double elevation_deg : {17.0, 5.7, 2.9, 1.1, 0.0, -1.7, -3.4, -5.7, -11.0, -40.0}) {
    const EveningCodes now = evening.at(elevation_deg);
    CAPTURE(elevation_deg);
    CAPTURE(now.sky);
    CAPTURE(now.land);
    CAPTURE(now.road);
    CHECK(now.sky <= before.sky + noise);
    CHECK(now.land <= before.land + noise);
    if (elevation_deg == 1.1) CHECK(now.road >= 45.0);
    if (elevation_deg == -1.7) sky_at_dusk = now.sky;
    before = now;
  }
  CHECK(image::light_of_srgb(before.sky / 255.0) <= 0.5 * image::light_of_srgb(sky_at_dusk / 255.0));
}

}  // namespace septet
