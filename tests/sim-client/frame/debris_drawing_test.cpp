#include "sim-client/frame/debris_drawing.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/control/control_message.hpp"
#include "engine/core/random.hpp"
#include "tests/relative.hpp"

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
      CHECK(glm::length(p.normal) == relative(1.0, 1e-5));
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
      const auto meshes = drawing.draw(effects_at(history, tick * tick_s, tick_s), tick, scene).meshes;
      REQUIRE(meshes.size() == 1);
      return meshes.front().origin_m.x;
    };
    CHECK(place(all) == relative(0.1 * tick + 0.5, 1e-4));
    CHECK(place(some) == place(all));
    CHECK(place(late) == place(all));
  }
}

TEST_CASE("a keyframe that cannot be read is left out") {
  Snapshot snapshot = flight(4);
  snapshot.effects.front().data.resize(9);
  TickHistory history;
  history.add(tick_payload(snapshot));
  DebrisDrawing drawing;
  CHECK(drawing.draw(effects_at(history, 4 * tick_s, tick_s), 4.0, {}).meshes.empty());
}

namespace {

/// A box of ice in the slab's frame at rest that lies turned in the world.
debris::Keyframe ice_box(const Vec3& low_m, const Vec3& high_m, const RigidTransform& world_from_slab) {
  debris::Keyframe keyframe;
  keyframe.part = debris::Part::ice_slab;
  keyframe.material = debris::Material::ice;
  for (int i = 0; i < 8; ++i) {
    keyframe.rest_m.emplace_back(i & 1 ? high_m.x : low_m.x, i & 2 ? high_m.y : low_m.y, i & 4 ? high_m.z : low_m.z);
    keyframe.vertices_m.push_back(world_from_slab * keyframe.rest_m.back());
  }
  keyframe.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return keyframe;
}

ice::IceBody ice_of(const debris::Keyframe& keyframe) {
  const auto sent = debris::decode(debris::encode(keyframe));
  REQUIRE(sent.has_value());
  const DebrisWay way(*sent, *sent);
  const auto body = way.ice_of(way.at(0.0), 0.0f);
  REQUIRE(body.has_value());
  return *body;
}

}  // namespace

TEST_CASE("a crack of a slab of ice stays in its place within two millimetres when the slab breaks") {
  const RigidTransform lying{{812.3, -40.1, 3.5}, orientation_from_angles(0.7, 0.1, -0.2)};
  const ice::IceBody whole = ice_of(ice_box({-1.0, -0.6, -0.05}, {1.0, 0.6, 0.05}, lying));
  REQUIRE(!whole.inside.empty());
  std::size_t compared = 0;
  for (const auto& [low_x, high_x] : {std::pair{-1.0, 0.2}, std::pair{0.2, 1.0}}) {
    const ice::IceBody half = ice_of(ice_box({low_x, -0.6, -0.05}, {high_x, 0.6, 0.05}, lying));
    for (const ice::IceVertex& vertex : half.inside) {
      // Texture coordinates name the crack and the place on it.
      const Vec3 place = half.origin_m + Vec3(vertex.position_m);
      double nearest = 1e9;
      for (const ice::IceVertex& other : whole.inside)
        if (other.rest_m == vertex.rest_m)
          nearest = std::min(nearest, glm::length(whole.origin_m + Vec3(other.position_m) - place));
      CHECK(nearest < 2e-3);
      ++compared;
    }
  }
  CHECK(compared >= whole.inside.size());
}

TEST_CASE("ice is drawn by its own pass and throws its shadow as a mesh, and steel is drawn as it was") {
  for (const bool of_ice : {true, false}) {
    debris::Keyframe keyframe = ice_box({-1, -1, -1}, {1, 1, 1}, {});
    if (!of_ice) keyframe.material = debris::Material::steel_sheet, keyframe.rest_m.clear();
    Snapshot snapshot = flight(4);
    snapshot.effects.front().data = encode(keyframe);
    TickHistory history;
    history.add(tick_payload(snapshot));
    DebrisDrawing drawing;
    scene::ResolvedScene scene;
    scene.prototypes.push_back({std::string(debris_look(keyframe.part, keyframe.material)), {}});
    const DrawnDebris drawn = drawing.draw(effects_at(history, 4 * tick_s, tick_s), 4.0, scene);
    REQUIRE(drawn.meshes.size() == 1);
    CHECK(drawn.meshes[0].seen == !of_ice);
    CHECK(drawn.ice.size() == (of_ice ? 1 : 0));
  }
}
