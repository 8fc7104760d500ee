/// A long piece of debris in flight across two screens that share an edge, each screen with its own ticks.

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include <doctest/doctest.h>

#include "engine/control/control_message.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/screen/client_frame.hpp"
#include "sim-client/screen/debris_drawing.hpp"

namespace septet::screen {
namespace {

constexpr double tick_s = 1.0 / 120.0;
const Vec3 car_m(3000.0, -2000.0, 35.0);

/// A prototype whose material glows, so that its pixels are told from everything else.
scene::ResolvedScene glowing_debris() {
  scene::ResolvedScene scene;
  scene.revision = 1;
  scene::SurfaceMaterial glowing;
  glowing.revision = 1;
  glowing.base_color = glm::vec3(0.0f);
  glowing.emission = glm::vec3(30.0f);
  scene.materials = {glowing};
  scene::SurfaceMesh plate;
  plate.revision = 1;
  plate.vertices = {{{0, 0, 0}, {0, 0, 1}, {}}, {{1, 0, 0}, {0, 0, 1}, {}}, {{0, 1, 0}, {0, 0, 1}, {}}};
  plate.indices = {0, 1, 2};
  plate.parts = {{0, 3, 0}};
  scene.meshes = {plate};
  scene.prototypes = {{"debris/ice", {scene::Instance{}}}};
  return scene;
}

/// A bar of 16 m across the view that falls and turns.
debris::Keyframe bar_at(double tick) {
  debris::Keyframe keyframe;
  keyframe.part = debris::Part::ice_slab;
  keyframe.material = debris::Material::ice;
  const Vec3 middle = car_m + Vec3(12.0, 1.0, 2.6 - 0.02 * tick);
  const Quat turn = orientation_from_angles(0.0, 0.0, 0.005 * tick);
  for (int i = 0; i < 8; ++i)
    keyframe.vertices_m.push_back(middle + turn * Vec3(i & 1 ? 0.05 : -0.05, i & 2 ? 8.0 : -8.0, i & 4 ? 0.05 : -0.05));
  keyframe.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {4, 5, 7}, {4, 7, 6}, {0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
  return keyframe;
}

Snapshot instant(Tick tick) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = static_cast<double>(tick) * tick_s;
  snapshot.environment.sun_elevation_rad = -0.4;
  Participant car;
  car.id = 1;
  car.world_from_vehicle.position_m = car_m;
  snapshot.participants = {car};
  snapshot.driver_car.participant = 1;
  const Tick shows = (tick + 2) / 4 * 4;
  snapshot.effects.push_back({debris::first_effect_id + 1, debris::keyframe_kind, encode(bar_at(static_cast<double>(shows))), shows});
  return snapshot;
}

std::optional<double> row_in(const image::Image& picture, std::uint32_t x) {
  double sum = 0.0, weight = 0.0;
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    const double bright = std::max(0, int(picture.at(x, y).red) - 60);
    sum += bright * (y + 0.5);
    weight += bright;
  }
  return weight < 100.0 ? std::nullopt : std::optional(sum / weight);
}

/// The bar's height at a screen's edge, from a straight fit over the columns next to it.
double row_at_edge(const image::Image& picture, bool right_edge) {
  constexpr int columns = 40;
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < columns; ++i) {
    const double x = i + 0.5;
    const auto row = row_in(picture, right_edge ? picture.width - 1 - static_cast<std::uint32_t>(i) : static_cast<std::uint32_t>(i));
    REQUIRE(row.has_value());
    sx += x, sy += *row, sxx += x * x, sxy += x * *row;
  }
  const double slope = (columns * sxy - sx * sy) / (columns * sxx - sx * sx);
  return (sy - slope * sx) / columns;
}

image::Image picture_of(const rig::Rig& rig, const rig::Screen& screen, const TickHistory& history, double tick) {
  auto renderer = render::Renderer::create({screen.width_px, screen.height_px, render::DevicePreference::software});
  REQUIRE(renderer.has_value());
  const scene::ResolvedScene scene = glowing_debris();
  REQUIRE(renderer->upload(scene).has_value());
  const auto views = screen_views(rig, screen);
  REQUIRE(views.has_value());
  render::FrameInput frame = client_frame(history.newest().snapshot, *views, scene);
  DebrisDrawing drawing;
  frame.meshes = drawing.draw(effects_at(history, tick * tick_s, tick_s), tick, scene);
  REQUIRE(frame.meshes.size() == 1);
  REQUIRE(renderer->draw(frame).has_value());
  return *renderer->read_back();
}

}  // namespace

TEST_CASE("debris in flight meets within a pixel at the edge of two screens of which each has lost other ticks") {
  std::ifstream file(std::string(SEPTET_SOURCE_DIR) + "/rigs/seven-screens.toml");
  std::stringstream text;
  text << file.rdbuf();
  const auto rig = rig::read_rig(text.str(), "seven-screens.toml");
  REQUIRE(rig.has_value());
  TickHistory left, right;
  for (Tick tick = 4; tick <= 24; ++tick) {
    Bytes payload;
    ByteWriter writer(payload);
    control::put_tick_header(writer, {});
    encode_snapshot(to_wire(instant(tick)), nullptr, payload);
    if (tick % 3 != 0) left.add(payload);
    if (tick % 4 != 1 || tick == 24) right.add(payload);
  }
  for (const double tick : {17.3, 19.0, 21.6}) {
    const double on_left = row_at_edge(picture_of(*rig, rig->screens[1], left, tick), true);
    const double on_right = row_at_edge(picture_of(*rig, rig->screens[2], right, tick), false);
    CHECK(std::abs(on_left - on_right) <= 1.0);
    MESSAGE("at tick ", tick, " the bar meets within ", std::abs(on_left - on_right), " px");
  }
}

}  // namespace septet::screen
