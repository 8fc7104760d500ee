#include "sim-client/frame/debris_drawing.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/control/control_message.hpp"
#include "engine/core/random.hpp"

using namespace septet;
using namespace septet::frame;

namespace {

constexpr double tick_s = 1.0 / 120.0;

debris::Keyframe tetrahedron(const Vec3& at, double turn_rad = 0.0) {
  debris::Keyframe keyframe;
  const Quat turn = orientation_from_angles(turn_rad, 0.3 * turn_rad, 0.0);
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    keyframe.vertices_m.push_back(at + turn * corner);
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
  const auto instant = debris_instant({}, {&a, 8}, {&b, 12}, 9.0);
  REQUIRE(instant);
  const DebrisWay way(*instant->from.keyframe, *instant->to.keyframe);
  for (const double share : {instant->share, 0.0, 1.0, 2.5}) {
    const instant::DynamicMesh mesh = way.at(share);
    std::array<Vec3, 4> places;
    for (std::size_t i = 0; i < 4; ++i) places[i] = (1.0 - share) * a.vertices_m[i] + share * b.vertices_m[i];
    const Vec3 middle = 0.25 * (places[0] + places[1] + places[2] + places[3]);
    const glm::vec3 inside(middle - mesh.origin_m);
    REQUIRE(mesh.vertices.size() == 12);
    for (std::size_t t = 0; t < 12; t += 3) {
      const auto &p = mesh.vertices[t], &q = mesh.vertices[t + 1], &r = mesh.vertices[t + 2];
      CHECK(glm::length(Vec3(p.position_m) + mesh.origin_m - places[a.triangles[t / 3][0]]) < 1e-6);
      CHECK(std::abs(glm::dot(p.normal, q.position_m - p.position_m)) < 1e-5f);
      CHECK(std::abs(glm::dot(p.normal, r.position_m - p.position_m)) < 1e-5f);
      CHECK(glm::dot(p.normal, p.position_m - inside) > 0.0f);
      CHECK(glm::length(p.normal) == doctest::Approx(1.0).epsilon(1e-5).scale(0.0));
    }
  }
}

TEST_CASE("a frame between two keyframes evaluates what was worked out once for the two") {
  TickHistory history;
  for (Tick tick = 4; tick <= 40; ++tick) history.add(tick_payload(flight(tick)));
  scene::ResolvedScene scene;
  scene.prototypes.push_back({"debris/bumper-plastic", {}});
  DebrisDrawing drawing;
  const auto draw = [&](double tick) { drawing.draw(effects_at(history, tick * tick_s, tick_s), tick, scene); };
  for (const double tick : {32.5, 33.0, 34.2, 35.9}) draw(tick);
  CHECK(drawing.prepared() == 1);
  draw(36.5);
  CHECK(drawing.prepared() == 2);
}

TEST_CASE("a shard that is new stands still until both keyframes have it") {
  debris::Keyframe one, two;
  one.shards = two.shards = true;
  one.vertices_m = {{600, 0, 0}, {600.03, 0, 0}, {600, 0.03, 0}};
  one.triangles = {{0, 1, 2}};
  two.vertices_m = {{601, 0, 0}, {601.03, 0, 0}, {601, 0.03, 0}, {0, 0, 0}, {0, 0.03, 0}, {0, 0, 0.03}};
  two.triangles = {{0, 1, 2}, {3, 4, 5}};
  const instant::DynamicMesh mesh = DebrisWay(one, two).at(0.5);
  REQUIRE(mesh.vertices.size() == 12);
  CHECK(mesh.origin_m.x + mesh.vertices[0].position_m.x == doctest::Approx(600.5));
  CHECK(mesh.origin_m.x + mesh.vertices[6].position_m.x == doctest::Approx(0.0).scale(1.0).epsilon(1e-4));
  CHECK(glm::length(mesh.vertices[0].normal - glm::vec3(0, 0, 1)) < 1e-5f);
  CHECK(glm::length(mesh.vertices[3].normal - glm::vec3(0, 0, -1)) < 1e-5f);
}

TEST_CASE("a piece that rested begins to move only in its last interval") {
  debris::Keyframe resting = tetrahedron({0, 0, 0});
  resting.asleep = true;
  const debris::Keyframe moved = tetrahedron({1, 0, 0});
  CHECK(debris_instant({}, {&resting, 8}, {&moved, 1000}, 995.0)->share == doctest::Approx(0.0));
  CHECK(debris_instant({}, {&resting, 8}, {&moved, 1000}, 998.0)->share == doctest::Approx(0.5));
}

TEST_CASE("until the instant of a break the piece flies on as it flew") {
  const debris::Keyframe a = tetrahedron({0, 0, 0}), b = tetrahedron({1, 0, 0});
  debris::Keyframe broken = tetrahedron({2, 0, 0});
  broken.triangles.pop_back();
  const auto instant = debris_instant({&a, 4}, {&b, 8}, {&broken, 12}, 10.0);
  REQUIRE(instant);
  CHECK(instant->from.keyframe == &a);
  CHECK(instant->to.keyframe == &b);
  CHECK(instant->share == doctest::Approx(1.5));
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
    CHECK(place(all) == doctest::Approx(0.1 * tick + 0.5).epsilon(1e-4).scale(0.0));
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
