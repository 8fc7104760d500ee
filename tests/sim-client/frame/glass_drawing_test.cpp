#include "sim-client/frame/glass_drawing.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/glass_keyframe.hpp"
#include "engine/world/vehicle_model.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::frame;

namespace {

const RigidTransform car_stands{{812.3, -40.1, 3.5}, orientation_from_angles(0.7, 0.02, -0.01)};

/// A car of two triangles of glass that lean back, one of paint that does, and its inside.
scene::ResolvedScene scene_of_glass(const std::string& name) {
  scene::ResolvedScene scene;
  scene.revision = 1;
  scene.materials.resize(2);
  scene.materials[0].base_color = {0.012f, 0.016f, 0.018f};
  scene.materials[0].roughness = 0.06f;
  scene::SurfaceMesh& mesh = scene.meshes.emplace_back();
  for (const glm::vec3& corner : {glm::vec3(2.0f, -0.7f, 0.9f), glm::vec3(2.0f, 0.7f, 0.9f),
                                  glm::vec3(1.4f, 0.6f, 1.3f), glm::vec3(1.4f, -0.6f, 1.3f)})
    mesh.vertices.push_back({corner, {}, {}});
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 1, 2};
  mesh.parts = {{0, 6, 0}, {6, 3, 1}};
  scene.prototypes.resize(3);
  scene.prototypes[0].name = "another";
  scene.prototypes[1] = {name, {scene::Instance{}}};
  scene.prototypes[2].name = "interior/" + name;
  return scene;
}

Snapshot with_glass(const Bytes& data) {
  Snapshot snapshot;
  Participant car;
  car.id = 2;
  car.world_from_vehicle = car_stands;
  snapshot.participants.push_back(car);
  snapshot.effects.push_back({ice::glass_effect_id, ice::glass_keyframe_kind, data, 4});
  return snapshot;
}

instant::FrameInput frame_with(std::uint32_t prototype, instant::Shown shown, double away_m) {
  instant::FrameInput frame;
  frame.views.emplace_back().world_from_car.position_m = car_stands * Vec3(away_m, 0.0, 1.0);
  instant::DrawnParticipant& drawn = frame.participants.emplace_back();
  drawn.prototype = prototype;
  drawn.shown = shown;
  drawn.world_from_vehicle = car_stands;
  return frame;
}

}  // namespace

TEST_CASE(
    "frost and stars are on the glass that is looked through from within, on the car that is seen whole, and nowhere "
    "else") {
  const std::string name(vehicle_models()[Participant{}.model].name);
  const scene::ResolvedScene scene = scene_of_glass(name);
  std::vector<ice::Pane> panes(1);
  panes[0].vehicle = 2;
  panes[0].frost = ice::morning_frost(268.15, 1);
  panes[0].stars = {{0.5, 0.5, 0.3, 1}};
  GlassDrawing drawing;
  drawing.show(with_glass(ice::encode_glass(panes)), scene);
  using instant::Shown;
  const auto drawn = [&](std::uint32_t prototype, Shown shown, double away_m) {
    instant::FrameInput frame = frame_with(prototype, shown, away_m);
    drawing.add_to(frame);
    return frame.glass;
  };
  CHECK(drawn(0, Shown::whole, 0.5).empty());
  CHECK(drawn(1, Shown::shadow_and_light, 0.5).empty());
  CHECK(drawn(1, Shown::whole, 100.0).empty());
  for (const std::uint32_t prototype : {1u, 2u}) {
    const auto glass = drawn(prototype, Shown::whole, 5.0);
    REQUIRE(glass.size() == 2);
    CHECK(glass[0].look.on_glass == ice::OnGlass::frost);
    CHECK(glass[1].look.on_glass == ice::OnGlass::cracks);
    for (const ice::IceBody& body : glass)
      for (const ice::IceVertex& vertex : body.vertices) {
        const Vec3 place = inverse(car_stands) * (body.origin_m + Vec3(vertex.position_m));
        CHECK(place.x > 1.35);
        CHECK(place.x < 2.4);
        CHECK(std::abs(place.y) < 0.81);
        // On a visible car it lies on the glass, a few millimetres before it.
        const double before_m = (place.x - 2.0) * 0.5547 + (place.z - 0.9) * 0.8321;
        if (prototype == 1) CHECK(before_m == relative(0.004, 0.2));
      }
  }
  // Thawed and gone with its keyframe; a missing vehicle has no glass.
  panes[0].frost = {};
  drawing.show(with_glass(ice::encode_glass(panes)), scene);
  CHECK(drawn(1, Shown::whole, 5.0).size() == 1);
  panes[0].vehicle = 3;
  drawing.show(with_glass(ice::encode_glass(panes)), scene);
  CHECK(drawn(1, Shown::whole, 5.0).empty());
  panes[0].vehicle = 2;
  drawing.show(with_glass(ice::encode_glass(panes)), scene);
  CHECK(drawn(1, Shown::whole, 5.0).size() == 1);
  drawing.show(with_glass({std::byte{9}}), scene);
  CHECK(drawn(1, Shown::whole, 5.0).empty());
}
