/// A long piece of debris in flight across two screens that share an edge, each screen with its own ticks.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/control/control_message.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/frame/client_frame.hpp"
#include "sim-client/frame/debris_drawing.hpp"
#include "tests/engine/render/glowing_bar.hpp"
#include "tests/shipped_files.hpp"

namespace septet::frame {
namespace {

constexpr double seam_tick_s = 1.0 / 120.0;
const Vec3 car_m(3000.0, -2000.0, 35.0);

/// A prototype whose material glows, so that its pixels are unambiguous.
scene::ResolvedScene glowing_debris() {
  scene::ResolvedScene scene;
  scene.revision = 1;
  scene.materials = {render::glowing_material()};
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
  for (std::uint16_t i = 0; i < render::bar_corners; ++i)
    keyframe.vertices_m.push_back(middle + turn * render::bar_corner_m(i));
  keyframe.triangles.assign(render::bar_triangles.begin(), render::bar_triangles.end());
  return keyframe;
}

Snapshot instant(Tick tick) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = static_cast<double>(tick) * seam_tick_s;
  snapshot.environment.sun_elevation_rad = -0.4;
  Participant car;
  car.id = 1;
  car.world_from_vehicle.position_m = car_m;
  snapshot.participants = {car};
  snapshot.driver_car.participant = 1;
  const Tick shows = (tick + 2) / 4 * 4;
  snapshot.effects.push_back(
      {debris::first_effect_id + 1, debris::keyframe_kind, encode(bar_at(static_cast<double>(shows))), shows});
  return snapshot;
}

image::Image picture_of(render::Renderer& renderer, const scene::ResolvedScene& scene, const rig::Rig& rig,
                        const rig::Screen& screen, const TickHistory& history, double tick) {
  const auto views = screen_views(rig, screen);
  REQUIRE(views.has_value());
  instant::FrameInput frame =
      client_frame(history.newest().snapshot, *views, driver_viewpoint(history.newest().snapshot), scene);
  DebrisDrawing drawing;
  frame.meshes = drawing.draw(effects_at(history, tick * seam_tick_s, seam_tick_s), tick, scene).meshes;
  REQUIRE(frame.meshes.size() == 1);
  REQUIRE(renderer.draw(frame).has_value());
  return *renderer.read_back();
}

}  // namespace

TEST_CASE("debris in flight meets within a pixel at the edge of two screens of which each has lost other ticks") {
  const auto rig = rig::read_rig(shipped_text("rigs/seven-screens.toml"), "seven-screens.toml");
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
  const rig::Screen &left_screen = rig->screens[1], &right_screen = rig->screens[2];
  REQUIRE(left_screen.width_px == right_screen.width_px);
  REQUIRE(left_screen.height_px == right_screen.height_px);
  auto renderer =
      render::Renderer::create({left_screen.width_px, left_screen.height_px, render::DevicePreference::software});
  REQUIRE(renderer.has_value());
  const scene::ResolvedScene scene = glowing_debris();
  REQUIRE(renderer->upload(scene).has_value());
  for (const double tick : {17.3, 19.0, 21.6}) {
    const double on_left = render::row_at_edge(picture_of(*renderer, scene, *rig, left_screen, left, tick), true);
    const double on_right = render::row_at_edge(picture_of(*renderer, scene, *rig, right_screen, right, tick), false);
    CHECK(std::abs(on_left - on_right) <= 1.0);
    MESSAGE("at tick ", tick, " the bar meets within ", std::abs(on_left - on_right), " px");
  }
}

}  // namespace septet::frame
