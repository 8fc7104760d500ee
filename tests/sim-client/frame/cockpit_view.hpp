#pragma once
/// The driver's car alone under the sky, seen from its seat on a shipped rig, as screens draw it. Software device.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/debris_looks.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/world/vehicle_model.hpp"
#include "sim-client/frame/client_frame.hpp"
#include "tests/shipped_files.hpp"

namespace septet::frame {

inline const scene::ResolvedScene& vehicles_scene() {
  static const scene::ResolvedScene scene = [] {
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder);
    scenery::build_debris_looks(builder);
    return scene::resolve(store);
  }();
  return scene;
}

inline Snapshot in_the_seat(double speed_kmh = 0.0, double engine_rpm = 800.0) {
  Snapshot snapshot;
  snapshot.simulated_time_s = 10.0;
  Participant car{.id = 1, .model = *find_vehicle_model("volvo-s80"), .paint = 7};
  car.world_from_vehicle = {Vec3(1200.0, -800.0, 20.0), orientation_from_angles(0.7, 0.02, 0.01)};
  snapshot.participants = {car};
  snapshot.driver_car = {
      .participant = 1, .speed_mps = speed_kmh / 3.6, .engine_radps = engine_rpm * 0.1047197551, .gear = 3};
  return snapshot;
}

inline rig::Rig rig_called(const std::string& name) {
  return *rig::read_rig(shipped_text("rigs/" + name + ".toml"), name);
}

/// A picture of one screen, and the places of the car's parts in it.
struct SeatPicture {
  image::Image image;
  ScreenViews views;
  RigidTransform world_from_car;

  /// Pixels from the upper left, for a place in the car.
  glm::dvec2 pixel(const Vec3& car_m) const {
    const instant::OffAxisView& projection = views.views.front().projection;
    const glm::dvec4 clip = projection.clip_from_eye_relative * glm::dvec4(car_m - projection.eye_m, 1.0);
    return {(0.5 + 0.5 * clip.x / clip.w) * image.width, (0.5 + 0.5 * clip.y / clip.w) * image.height};
  }
  image::Color at(const glm::dvec2& pixel_xy) const {
    return image.at(static_cast<std::uint32_t>(std::clamp(pixel_xy.x, 0.0, image.width - 1.0)),
                    static_cast<std::uint32_t>(std::clamp(pixel_xy.y, 0.0, image.height - 1.0)));
  }
};

/// Draws on the CPU. SEPTET_PICTURES: a folder for keeping the picture for people, under `name`.
inline image::Image drawn_picture(const rig::Screen& screen, instant::FrameInput input, const std::string& name) {
  auto renderer = render::Renderer::create({.width = screen.width_px,
                                            .height = screen.height_px,
                                            .device = render::DevicePreference::software,
                                            .validation = true});
  REQUIRE(renderer.has_value());
  REQUIRE(renderer->upload(vehicles_scene()).has_value());
  REQUIRE(renderer->draw(std::move(input)).has_value());
  auto picture = renderer->read_back();
  REQUIRE(picture.has_value());
  CHECK(renderer->statistics().validation_messages == 0);
  if (const char* folder = std::getenv("SEPTET_PICTURES"))
    CHECK(image::write_png(std::string(folder) + "/" + name + ".png", *picture).has_value());
  return std::move(*picture);
}

inline SeatPicture seat_picture(const Snapshot& shown, const rig::Rig& rig, const rig::Screen& screen,
                                const std::string& name) {
  auto views = screen_views(rig, screen);
  REQUIRE(views.has_value());
  const Viewpoint viewpoint = driver_viewpoint(shown);
  return {drawn_picture(screen, client_frame(shown, *views, viewpoint, vehicles_scene()), name), *views,
          viewpoint.world_from_views};
}

}  // namespace septet::frame
