#include "sim-client/frame/ice_drawing.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/effects/ice/objects.hpp"
#include "sim-client/frame/debris_drawing.hpp"

using namespace septet;
using namespace septet::frame;

namespace {

const RigidTransform lorry_stands{{812.3, -40.1, 3.5}, orientation_from_angles(0.7, 0.02, -0.01)};
const ice::LyingSlab on_roof{2, {-2.6, -0.2, 3.87}, {2.0, 1.2, 0.08}};

Snapshot winter(const ice::StillIce& ice) {
  Snapshot snapshot;
  Participant lorry;
  lorry.id = 2;
  lorry.world_from_vehicle = lorry_stands;
  snapshot.participants.push_back(lorry);
  snapshot.environment.temperature_k = 268.0;
  snapshot.effects.push_back({ice::effect_id, ice::keyframe_kind, ice::encode(ice), 4});
  return snapshot;
}

instant::FrameInput frame_at(const Vec3& eye_m) {
  instant::FrameInput frame;
  frame.views.emplace_back().world_from_car.position_m = eye_m;
  return frame;
}

}  // namespace

TEST_CASE("a slab that begins to slide lies where it lay, with its cracks within two millimetres") {
  const ice::IceBody lying = slab_body(on_roof, 0.0, lorry_stands, 0.0f);
  Random random(1);
  const RigidTransform at{lorry_stands * (on_roof.foot_m + Vec3(0.0, 0.0, 0.04)), lorry_stands.orientation};
  const debris::Piece piece = debris::make_part(debris::Part::ice_slab, at, Vec3(0.0), Vec3(0.0), random);
  const auto sent = debris::decode(debris::encode(debris::keyframe_of(piece)));
  REQUIRE(sent);
  const DebrisWay way(*sent, *sent);
  const auto sliding = way.ice_of(way.at(0.0), 0.0f);
  REQUIRE(sliding);
  REQUIRE(sliding->inside.size() == lying.inside.size());
  REQUIRE(!lying.inside.empty());
  for (std::size_t i = 0; i < lying.inside.size(); ++i) {
    CHECK(sliding->inside[i].rest_m == lying.inside[i].rest_m);
    CHECK(glm::length(sliding->origin_m + Vec3(sliding->inside[i].position_m) - lying.origin_m -
                      Vec3(lying.inside[i].position_m)) < 2e-3);
  }
  const auto extent = [](const ice::IceBody& body) {
    Vec3 low(INFINITY), high(-INFINITY);
    for (const ice::IceVertex& vertex : body.vertices) {
      low = glm::min(low, body.origin_m + Vec3(vertex.position_m));
      high = glm::max(high, body.origin_m + Vec3(vertex.position_m));
    }
    return std::pair{low, high};
  };
  CHECK(glm::length(extent(*sliding).first - extent(lying).first) < 2e-3);
  CHECK(glm::length(extent(*sliding).second - extent(lying).second) < 2e-3);
}

TEST_CASE("a slab goes with its vehicle, throws a shadow, thins as it thaws and is gone with its vehicle") {
  ice::StillIce ice;
  ice.slabs = {on_roof};
  scene::ResolvedScene scene;
  scene.prototypes.push_back({"debris/ice", {}});
  IceDrawing drawing;
  const auto shown = [&](const Snapshot& snapshot) {
    drawing.show(snapshot, scene);
    instant::FrameInput frame = frame_at(lorry_stands.position_m);
    drawing.add_to(frame);
    return frame;
  };
  Snapshot snapshot = winter(ice);
  const auto first = shown(snapshot);
  REQUIRE(first.ice.size() == 1);
  REQUIRE(first.meshes.size() == 1);
  CHECK_FALSE(first.meshes[0].seen);
  snapshot.participants[0].world_from_vehicle.position_m.x += 5.0;
  CHECK(glm::length(shown(snapshot).ice.at(0).origin_m - first.ice[0].origin_m - Vec3(5, 0, 0)) < 1e-9);
  ice.thawed_kh = 120.0;
  const ice::IceBody thin = slab_body(on_roof, ice.thawed_kh, {}, 0.0f), whole = slab_body(on_roof, 0.0, {}, 0.0f);
  CHECK(whole.origin_m.z - thin.origin_m.z == doctest::Approx(0.02));
  CHECK(slab_body(on_roof, 241.0, {}, 0.0f).vertices.empty());
  snapshot.participants[0].id = 3;
  CHECK(shown(snapshot).ice.empty());
}

TEST_CASE("a sheet lies just over its road in bodies with cracks, wet ice shines and far ice is not drawn") {
  ice::Sheet sheet;
  for (int i = 0; i < 21; ++i) {
    sheet.left_m.emplace_back(900.0 + i, 3.25, 12.0);
    sheet.right_m.emplace_back(900.0 + i, 0.5, 12.0);
  }
  const auto bodies = sheet_bodies(sheet, 0.0, 0.0f);
  REQUIRE(bodies.size() == 3);
  for (ice::IceBody body : bodies) {
    CHECK(body.inside.size() > 500);
    for (const ice::IceVertex& vertex : body.vertices) {
      const double over_m = body.origin_m.z + vertex.position_m.z - 12.0;
      CHECK(over_m > 0.005);
      CHECK(over_m < 0.013);
    }
    for (const ice::IceVertex& vertex : body.inside)
      CHECK(std::abs(body.origin_m.z + vertex.position_m.z - 12.0) < 1.5);
    CHECK_FALSE(ice::faults(body.vertices).inverted);
  }
  CHECK(sheet_bodies(sheet, 12.1, 0.0f).empty());
  CHECK(sheet_bodies(sheet, 0.0, 1.0f)[0].look.roughness < bodies[0].look.roughness);
  ice::StillIce ice;
  ice.sheets = {sheet};
  ice.rows = {{{900, 0, 17}, {904, 0, 17}, 0.8, 1}};
  IceDrawing drawing;
  drawing.show(winter(ice), {});
  instant::FrameInput near = frame_at({880, 0, 13}), between = frame_at({820, 0, 13}), far = frame_at({700, 0, 13});
  for (instant::FrameInput* frame : {&near, &between, &far}) drawing.add_to(*frame);
  CHECK(near.ice.size() == 4);
  CHECK(between.ice.size() == 3);
  CHECK(far.ice.empty());
}

TEST_CASE("still ice that cannot be read is left out") {
  Snapshot snapshot = winter({});
  snapshot.effects[0].data.resize(2);
  IceDrawing drawing;
  for (int i = 0; i < 3; ++i) {
    drawing.show(snapshot, {});
    instant::FrameInput frame = frame_at({880, 0, 13});
    drawing.add_to(frame);
    CHECK(frame.ice.empty());
  }
}
