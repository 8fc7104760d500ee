#include "sim-client/screen/debris_drawing.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/control/control_message.hpp"
#include "engine/core/random.hpp"

using namespace septet;
using namespace septet::screen;

namespace {

constexpr double tick_s = 1.0 / 120.0;

debris::Keyframe tetrahedron(const Vec3& at, double turn_rad = 0.0) {
  debris::Keyframe keyframe;
  const Quat turn = orientation_from_angles(turn_rad, 0.3 * turn_rad, 0.0);
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) keyframe.vertices_m.push_back(at + turn * corner);
  keyframe.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return keyframe;
}

Bytes tick_payload(const Snapshot& snapshot) {
  Bytes payload;
  ByteWriter writer(payload);
  control::put_tick_header(writer, {});
  encode_snapshot(to_wire(snapshot), nullptr, payload);
  return payload;
}

/// A tetrahedron that flies along x at 12 m/s: its keyframe of tick n is published at n − 2, every fourth tick.
Snapshot flight(Tick tick) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = static_cast<double>(tick) * tick_s;
  const Tick shows = (tick + 2) / 4 * 4;
  snapshot.effects.push_back({debris::first_effect_id + 1, debris::keyframe_kind,
                              encode(tetrahedron(Vec3(0.1 * static_cast<double>(shows), 0.0, 0.0))), shows});
  return snapshot;
}

}  // namespace

TEST_CASE("between two keyframes vertices go straight and normals stand upright on their triangles") {
  const debris::Keyframe a = tetrahedron({0, 0, 0}), b = tetrahedron({1, 2, 0}, 0.8);
  const auto shape = debris_at({}, {&a, 8}, {&b, 12}, 9.0);
  REQUIRE(shape);
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(glm::length(shape->vertices_m[i] - (0.75 * a.vertices_m[i] + 0.25 * b.vertices_m[i])) < 1e-12);
  const render::DynamicMesh mesh = debris_mesh(*shape);
  Vec3 middle(0.0);
  for (const Vec3& v : shape->vertices_m) middle += 0.25 * v;
  const glm::vec3 inside(middle - mesh.origin_m);
  REQUIRE(mesh.vertices.size() == 12);
  for (std::size_t t = 0; t < 12; t += 3) {
    const auto &p = mesh.vertices[t], &q = mesh.vertices[t + 1], &r = mesh.vertices[t + 2];
    CHECK(std::abs(glm::dot(p.normal, q.position_m - p.position_m)) < 1e-5f);
    CHECK(std::abs(glm::dot(p.normal, r.position_m - p.position_m)) < 1e-5f);
    CHECK(glm::dot(p.normal, p.position_m - inside) > 0.0f);
  }
}

TEST_CASE("a piece that rested begins to move only in its last interval") {
  debris::Keyframe resting = tetrahedron({0, 0, 0});
  resting.asleep = true;
  const debris::Keyframe moved = tetrahedron({1, 0, 0});
  CHECK(debris_at({}, {&resting, 8}, {&moved, 1000}, 995.0)->vertices_m[0].x == doctest::Approx(0.0));
  CHECK(debris_at({}, {&resting, 8}, {&moved, 1000}, 998.0)->vertices_m[0].x == doctest::Approx(0.5));
}

TEST_CASE("until the instant of a break the piece flies on as it flew") {
  const debris::Keyframe a = tetrahedron({0, 0, 0}), b = tetrahedron({1, 0, 0});
  debris::Keyframe broken = tetrahedron({2, 0, 0});
  broken.triangles.pop_back();
  const auto shape = debris_at({&a, 4}, {&b, 8}, {&broken, 12}, 10.0);
  REQUIRE(shape);
  CHECK(shape->triangles.size() == 4);
  CHECK(shape->vertices_m[0].x == doctest::Approx(1.5));
}

TEST_CASE("screens that lost different ticks show the same debris at the same instant") {
  TickHistory all, some, late;
  for (Tick tick = 4; tick <= 40; ++tick) {
    all.add(tick_payload(flight(tick)));
    if (tick % 4 != 2) some.add(tick_payload(flight(tick)));  // Without each tick that brought a new keyframe.
    if (tick >= 33) late.add(tick_payload(flight(tick)));
  }
  for (const double tick : {35.0, 36.3, 37.5, 38.0}) {
    const auto place = [&](const TickHistory& history) {
      DebrisDrawing drawing;
      scene::ResolvedScene scene;
      scene.prototypes.push_back({"debris/bumper-plastic", {}});
      const auto meshes = drawing.draw(effects_at(history, tick * tick_s, tick_s), tick, scene);
      REQUIRE(meshes.size() == 1);
      return meshes.front().origin_m.x;
    };
    CHECK(place(all) == doctest::Approx(0.1 * tick + 0.5).epsilon(1e-4));
    CHECK(place(some) == place(all));
    CHECK(place(late) == place(all));
  }
}

TEST_CASE("a keyframe that cannot be read is left out and counted") {
  Snapshot snapshot = flight(4);
  snapshot.effects.front().data.resize(9);
  TickHistory history;
  history.add(tick_payload(snapshot));
  DebrisDrawing drawing;
  CHECK(drawing.draw(effects_at(history, 4 * tick_s, tick_s), 4.0, {}).empty());
  CHECK(drawing.refused() == 1);
}
