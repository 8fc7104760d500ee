/// Views out of vehicles other than the driver's car, as pixels: their cabins are light by day, and their dials show the speed.

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/scenery/vehicles/fittings.hpp"
#include "engine/world/instrument_panel.hpp"
#include "tests/sim-client/frame/cockpit_view.hpp"

namespace septet::frame {
namespace {

constexpr std::uint32_t cabin_width_px = 640, cabin_height_px = 400;

SeatPicture view_out_of(const std::string& model, double speed_mps, double sun_elevation_rad, double pitch_rad,
                        const std::string& name) {
  Snapshot snapshot;
  snapshot.simulated_time_s = 10.0;
  snapshot.environment.sun_elevation_rad = sun_elevation_rad;
  Participant vehicle{.id = 4, .model = *find_vehicle_model(model), .paint = 4};
  vehicle.world_from_vehicle.position_m = {400.0, 300.0, 10.0};
  vehicle.velocity_mps = {speed_mps, 0.0, 0.0};
  if (sun_elevation_rad < 0.0) vehicle.lamps.set(Lamp::low_beam, true);
  snapshot.participants = {vehicle};
  ScreenViews views;
  instant::FrameView view;
  view.projection = instant::symmetric_view(scenery::eye_in(vehicle_models()[vehicle.model]), 0.0, pitch_rad, 1.6,
                                            2.0 * std::atan(std::tan(0.8) * cabin_height_px / cabin_width_px));
  view.viewport = {0, 0, cabin_width_px, cabin_height_px};
  views.views.push_back(view);
  views.show_interior = true;
  const Viewpoint viewpoint{vehicle.world_from_vehicle, vehicle.id};
  rig::Screen screen;
  screen.width_px = cabin_width_px;
  screen.height_px = cabin_height_px;
  return {drawn_picture(screen, client_frame(snapshot, views, viewpoint, vehicles_scene()), name), views,
          vehicle.world_from_vehicle};
}

int luminance(const image::Color& color) { return (54 * color.red + 183 * color.green + 19 * color.blue) / 256; }

}  // namespace

TEST_CASE(
    "out of every kind of vehicle one sees its dials, whose needle follows the speed, by day and in the evening") {
  namespace panel = instrument_panel;
  for (const char* name : {"hatchback", "van", "lorry", "city-bus", "motorcycle"}) {
    CAPTURE(name);
    const RigidTransform dials = *scenery::dials_in(vehicle_models()[*find_vehicle_model(name)]);
    for (const double sun_rad : {0.7, -0.05}) {
      const std::string at = std::string("cabin-") + name + (sun_rad > 0.0 ? "-day" : "-evening");
      const SeatPicture stands = view_out_of(name, 0.0, sun_rad, -0.6, at),
                        drives = view_out_of(name, 25.0, sun_rad, -0.6, at + "-drives");
      int changed = 0, changed_elsewhere = 0, brightest = 0;
      glm::dvec2 low(1e6), high(-1e6);
      for (const double across : {-0.5, 0.5})
        for (const double upward : {-0.5, 0.5}) {
          const glm::dvec2 pixel = stands.pixel(dials * (panel::middle_m + across * panel::width_m * panel::right +
                                                         upward * panel::height_m * panel::up));
          low = glm::min(low, pixel - 2.0);
          high = glm::max(high, pixel + 2.0);
        }
      for (std::uint32_t x = 0; x < cabin_width_px; ++x)
        for (std::uint32_t y = 0; y < cabin_height_px; ++y) {
          const bool on_dials = x >= low.x && x <= high.x && y >= low.y && y <= high.y;
          const int before = luminance(stands.image.at(x, y)), after = luminance(drives.image.at(x, y));
          (on_dials ? changed : changed_elsewhere) += std::abs(after - before) > 12;
          if (on_dials) brightest = std::max(brightest, after);
        }
      CHECK(changed > 8);
      CHECK(changed_elsewhere < changed);
      CHECK(brightest > 90);
    }
  }
}

TEST_CASE("a cabin's lining is light by day") {
  for (const char* name : {"hatchback", "van", "lorry", "city-bus"}) {
    CAPTURE(name);
    const SeatPicture picture = view_out_of(name, 10.0, 0.7, 0.6, std::string("cabin-roof-") + name);
    // The roof lies above the middle of the upper edge.
    int sum = 0, count = 0;
    for (std::uint32_t x = cabin_width_px / 2 - 40; x < cabin_width_px / 2 + 40; ++x)
      for (std::uint32_t y = 0; y < 40; ++y, ++count) sum += luminance(picture.image.at(x, y));
    CHECK(sum / count > 25);
    CHECK(sum / count < 220);
  }
}

}  // namespace septet::frame
