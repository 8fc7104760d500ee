/// Dents as pixels: the body is drawn as deep as it was dented, and at the same place; from the seat the bonnet is,
/// too.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/world/instrument_panel.hpp"
#include "sim-client/frame/dent_drawing.hpp"
#include "tests/relative.hpp"
#include "tests/sim-client/frame/cockpit_view.hpp"

namespace septet::frame {
namespace {

constexpr std::uint32_t width_px = 480, height_px = 320;

image::Image drawn(const instant::FrameInput& frame, std::uint32_t width, std::uint32_t height,
                   const std::string& name) {
  auto renderer = render::Renderer::create(
      {.width = width, .height = height, .device = render::DevicePreference::software, .validation = true});
  REQUIRE(renderer.has_value());
  REQUIRE(renderer->upload(vehicles_scene()).has_value());
  REQUIRE(renderer->draw(frame).has_value());
  auto picture = renderer->read_back();
  REQUIRE(picture.has_value());
  CHECK(renderer->statistics().validation_messages == 0);
  if (const char* folder = std::getenv("SEPTET_PICTURES"))
    CHECK(image::write_png(std::string(folder) + "/" + name + ".png", *picture).has_value());
  return std::move(*picture);
}

Snapshot with_dents(Snapshot snapshot, const std::vector<debris::Dent>& dents) {
  if (!dents.empty())
    snapshot.effects.push_back({debris::dent_effect_id, debris::dent_keyframe_kind,
                                debris::encode_dents(std::vector<debris::DentedVehicle>{{1, dents}}), 0});
  return snapshot;
}

/// Picture from outside, `azimuth_deg` counted from straight ahead of the vehicle.
image::Image from_outside(const std::string& model, const std::vector<debris::Dent>& dents, double azimuth_deg,
                          double elevation_deg, const std::string& name) {
  Snapshot snapshot;
  snapshot.simulated_time_s = 10.0;
  Participant vehicle{.id = 1, .model = *find_vehicle_model(model), .paint = 7};
  vehicle.world_from_vehicle.position_m = {400.0, 300.0, 10.0};
  const VehicleModel& shape = vehicle_models()[vehicle.model];
  if (name != "nothing") snapshot.participants = {vehicle};
  snapshot = with_dents(std::move(snapshot), dents);
  const double a = azimuth_deg * std::numbers::pi / 180.0, e = elevation_deg * std::numbers::pi / 180.0;
  const double away_m = 1.3 * shape.length_m + 1.0;
  const Vec3 middle = vehicle.world_from_vehicle.position_m + Vec3(shape.centre_x_m(), 0.0, 0.45 * shape.height_m);
  const Vec3 eye = middle + away_m * Vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  ScreenViews views;
  instant::FrameView view;
  const double across = 2.0 * std::atan(0.62 * shape.length_m / away_m);
  view.projection = instant::symmetric_view(Vec3(0.0), 0.0, 0.0, across,
                                            2.0 * std::atan(std::tan(0.5 * across) * height_px / width_px));
  view.viewport = {0, 0, width_px, height_px};
  views.views.push_back(view);
  const Viewpoint viewpoint{.world_from_views = {eye, orientation_from_angles(a + std::numbers::pi, e, 0.0)}};
  auto frame = client_frame(snapshot, views, viewpoint, vehicles_scene());
  DentDrawing drawing;
  drawing.show(snapshot, vehicles_scene());
  drawing.add_to(frame);
  return drawn(frame, width_px, height_px, name);
}

bool differ(const image::Color& a, const image::Color& b, int by) {
  return std::abs(a.red - b.red) > by || std::abs(a.green - b.green) > by || std::abs(a.blue - b.blue) > by;
}

/// First column from the left, in these rows, with a pixel of the vehicle.
double first_column(const image::Image& picture, const image::Image& nothing, std::uint32_t from_row,
                    std::uint32_t to_row) {
  for (std::uint32_t x = 0; x < picture.width; ++x)
    for (std::uint32_t y = from_row; y < to_row; ++y)
      if (differ(picture.at(x, y), nothing.at(x, y), 24)) return x;
  return picture.width;
}

debris::Dent dent(double x_m, double y_m, double heading_deg, double depth_m, double half_width_m, double top_m) {
  return {{x_m, y_m}, heading_deg * std::numbers::pi / 180.0, depth_m, half_width_m, top_m};
}

}  // namespace

TEST_CASE("a front that was pushed in is seen from the side as far back as its dent is deep") {
  const VehicleModel& shape = vehicle_models()[*find_vehicle_model("saloon")];
  const auto nothing = from_outside("saloon", {}, 90.0, 0.0, "nothing");
  const auto whole = from_outside("saloon", {}, 90.0, 0.0, "dents-side-whole");
  // Seen from its left, its front is to the left. A metre in the middle of the picture:
  const double px_per_m = width_px / (2.0 * 0.62 * shape.length_m);
  const auto row = [&](double height_m) {
    return static_cast<std::uint32_t>(0.5 * height_px - (height_m - 0.45 * shape.height_m) * px_per_m);
  };
  const double front = first_column(whole, nothing, row(0.65), row(0.45));
  REQUIRE(front < 100.0);
  for (const double depth_m : {0.15, 0.4}) {
    const auto picture = from_outside("saloon", {dent(shape.front_m(), 0.0, 180.0, depth_m, 0.9, 0.9)}, 90.0, 0.0,
                                      "dents-side-" + std::to_string(int(100 * depth_m)));
    const double moved_m = (first_column(picture, nothing, row(0.65), row(0.45)) - front) / px_per_m;
    CHECK(moved_m == relative(depth_m, 0.2));
    // Behind the doors nothing has moved.
    int changed = 0;
    for (std::uint32_t x = width_px / 2; x < width_px; ++x)
      for (std::uint32_t y = row(1.2); y < row(0.4); ++y) changed += differ(picture.at(x, y), whole.at(x, y), 6);
    CHECK(changed < 20);
  }
}

TEST_CASE("doors, tails and the sides of lorries show where they were hit") {
  const VehicleModel &saloon = vehicle_models()[*find_vehicle_model("saloon")],
                     &lorry = vehicle_models()[*find_vehicle_model("lorry")];
  struct Row {
    const char *name, *model;
    double azimuth_deg;
    debris::Dent dent;
  };
  for (const Row& row :
       {Row{"dents-front", "saloon", 35.0, dent(saloon.front_m(), 0.35, 180.0, 0.35, 0.5, 0.8)},
        Row{"dents-pole", "hatchback", 25.0, dent(vehicle_models()[1].front_m(), 0.1, 180.0, 0.5, 0.15, 1.4)},
        Row{"dents-door", "saloon", 70.0, dent(1.6, 0.5 * saloon.width_m, -90.0, 0.25, 0.7, 0.8)},
        Row{"dents-tail", "saloon", 150.0, dent(-saloon.rear_overhang_m, -0.2, 0.0, 0.3, 0.6, 0.8)},
        Row{"dents-lorry", "lorry", 60.0, dent(1.0, 0.5 * lorry.width_m, -90.0, 0.3, 0.9, 1.5)}}) {
    CAPTURE(row.name);
    const auto whole = from_outside(row.model, {}, row.azimuth_deg, 12.0, std::string(row.name) + "-whole");
    const auto picture = from_outside(row.model, {row.dent}, row.azimuth_deg, 12.0, row.name);
    int changed = 0;
    for (std::uint32_t x = 0; x < width_px; ++x)
      for (std::uint32_t y = 0; y < height_px; ++y) changed += differ(picture.at(x, y), whole.at(x, y), 12);
    CHECK(changed > 400);
    CHECK(changed < 30'000);
  }
}

TEST_CASE("the driver sees his own bonnet dented, and his instruments as they were") {
  const rig::Rig rig = rig_called("desktop");
  rig::Screen screen = rig::screen_ahead(rig);
  const VehicleModel& shape = vehicle_models()[*find_vehicle_model("volvo-s80")];
  screen.width_px = 640, screen.height_px = 360;
  std::optional<image::Image> whole;
  for (const double depth_m : {0.0, 0.35}) {
    std::vector<debris::Dent> dents;
    if (depth_m > 0.0) dents.push_back(dent(shape.front_m(), 0.2, 180.0, depth_m, 0.7, 0.9));
    const Snapshot snapshot = with_dents(in_the_seat(), dents);
    const auto views = screen_views(rig, screen);
    REQUIRE(views.has_value());
    auto frame = client_frame(snapshot, *views, driver_viewpoint(snapshot), vehicles_scene());
    DentDrawing drawing;
    drawing.show(snapshot, vehicles_scene());
    drawing.add_to(frame);
    const SeatPicture picture{
        drawn(frame, screen.width_px, screen.height_px, depth_m > 0.0 ? "dents-seat" : "dents-seat-whole"), *views,
        driver_viewpoint(snapshot).world_from_views};
    if (!whole) {
      whole = picture.image;
      continue;
    }
    int bonnet = 0, below = 0;
    const double panel_row = picture.pixel(instrument_panel::middle_m).y;
    for (std::uint32_t x = 0; x < screen.width_px; ++x)
      for (std::uint32_t y = 0; y < screen.height_px; ++y)
        (y < panel_row ? bonnet : below) += differ(picture.image.at(x, y), whole->at(x, y), 16);
    CHECK(bonnet > 300);
    CHECK(below == 0);
  }
}

}  // namespace septet::frame
