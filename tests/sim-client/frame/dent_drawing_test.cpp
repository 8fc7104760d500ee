#include "sim-client/frame/dent_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/world/vehicle_model.hpp"
#include "sim-client/frame/dented_mesh.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::frame;

namespace {

/// One large sheet across the front of a vehicle at x = 2 m, in two triangles; it looks forward. Its object is turned
/// and stretched.
const RigidTransform vehicle_from_sheet{{2.0, 0.0, 0.5}, orientation_from_angles(0.5 * std::numbers::pi, 0.0, 0.0)};
const glm::vec3 sheet_scale(2.0f, 1.0f, 0.5f);

scene::ResolvedScene scene_of_sheet(const std::string& name) {
  scene::ResolvedScene scene;
  scene.revision = 1;
  scene.materials.resize(1);
  scene::SurfaceMesh& mesh = scene.meshes.emplace_back();
  // The sheet's x lies along the vehicle's y, and its −y along the vehicle's x.
  for (const glm::vec2& corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
    mesh.vertices.push_back({{corner.x, 0.0f, corner.y}, {0, -1, 0}, corner});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.parts = {{0, 6, 0}};
  scene.prototypes.resize(2);
  scene.prototypes[0] = {name, {scene::Instance{}, scene::Instance{}}};
  for (scene::Instance& part : scene.prototypes[0].parts) {
    part.world_from_object = vehicle_from_sheet;
    part.scale = sheet_scale;
  }
  scene.prototypes[0].parts[1].role = scene::PartRole::wheel_front_left;
  scene.prototypes[1] = {"interior/" + name, {scene.prototypes[0].parts[0]}};
  return scene;
}

const debris::Dent middle{{2.0, 0.0}, std::numbers::pi, 0.3, 0.4, 0.6};

Snapshot with_dents(const std::vector<debris::DentedVehicle>& vehicles) {
  Snapshot snapshot;
  Participant car;
  car.id = 2;
  snapshot.participants.push_back(car);
  snapshot.effects.push_back({debris::dent_effect_id, debris::dent_keyframe_kind, debris::encode_dents(vehicles), 4});
  return snapshot;
}

instant::FrameInput frame_of(std::uint32_t number, std::uint32_t prototype) {
  instant::FrameInput frame;
  instant::DrawnParticipant& drawn = frame.participants.emplace_back();
  drawn.number = number;
  drawn.prototype = prototype;
  return frame;
}

}  // namespace

TEST_CASE("a sheet is divided where a dent bends it, keeps its outline, and is as deep in as it was pushed") {
  const scene::ResolvedScene scene = scene_of_sheet("any");
  const std::vector<debris::Dent> dents{middle};
  const auto bent = dented_mesh(scene.meshes[0], vehicle_from_sheet, sheet_scale, dents);
  REQUIRE(bent.has_value());
  CHECK(bent->vertices.size() > 100);
  CHECK(bent->vertices.size() < 8000);
  double deepest = 0.0, area_m2 = 0.0;
  const auto in_vehicle = [&](std::uint32_t i) {
    return vehicle_from_sheet * Vec3(bent->vertices[i].position_m * sheet_scale);
  };
  for (std::uint32_t i = 0; i < bent->vertices.size(); ++i) {
    const Vec3 at = in_vehicle(i);
    deepest = std::max(deepest, 2.0 - at.x);
    if (std::abs(at.y) > 0.8) CHECK(std::abs(at.x - 2.0) < 1e-5);
    CHECK(glm::length(bent->vertices[i].normal) == relative(1.0, 1e-4));
  }
  CHECK(deepest == relative(0.3, 0.08));
  // The triangles cover the same area: seen from the front there is neither a hole nor an overlap.
  std::uint32_t in_parts = 0;
  for (const scene::MeshPart& part : bent->parts) in_parts += part.index_count;
  CHECK(in_parts == bent->indices.size());
  for (std::size_t i = 0; i < bent->indices.size(); i += 3) {
    const Vec3 a = in_vehicle(bent->indices[i]), b = in_vehicle(bent->indices[i + 1]),
               c = in_vehicle(bent->indices[i + 2]);
    area_m2 += 0.5 * glm::cross(b - a, c - a).x;
    if (debris::reaches(dents, 0.5 * (a + b) + Vec3(0.3, 0, 0)))
      CHECK(std::hypot(b.y - a.y, b.z - a.z) < 2.5 * longest_bent_edge_m);
  }
  CHECK(area_m2 == relative(4.0 * 2.0 * 0.5, 1e-3));
}

TEST_CASE("a mesh that no dent reaches, or that makes no sense, stays as it is") {
  scene::SurfaceMesh mesh = scene_of_sheet("any").meshes[0];
  const std::vector<debris::Dent> behind{{{-8.0, 0.0}, 0.0, 0.3, 0.4, 0.6}}, dents{middle};
  CHECK_FALSE(dented_mesh(mesh, vehicle_from_sheet, sheet_scale, behind).has_value());
  CHECK_FALSE(dented_mesh(mesh, vehicle_from_sheet, sheet_scale, {}).has_value());
  CHECK_FALSE(dented_mesh(mesh, vehicle_from_sheet, {1.0f, 0.0f, 1.0f}, dents).has_value());
  mesh.indices[4] = 77;
  CHECK_FALSE(dented_mesh(mesh, vehicle_from_sheet, sheet_scale, dents).has_value());
  mesh.indices[4] = 2;
  mesh.parts[0].index_count = 9;
  CHECK_FALSE(dented_mesh(mesh, vehicle_from_sheet, sheet_scale, dents).has_value());
}

TEST_CASE("the vehicle that crashed is drawn with its dents, outside and inside, its wheels and all others without") {
  const scene::ResolvedScene scene = scene_of_sheet(std::string(vehicle_models()[Participant{}.model].name));
  DentDrawing drawing;
  drawing.show(with_dents({{2, {middle}}}), scene);
  for (const std::uint32_t prototype : {0u, 1u}) {
    instant::FrameInput frame = frame_of(2, prototype);
    drawing.add_to(frame);
    REQUIRE(frame.participants[0].reshaped);
    CHECK(frame.participants[0].reshaped->size() == scene.prototypes[prototype].parts.size());
    CHECK(frame.participants[0].reshaped->at(0));
    if (prototype == 0) CHECK_FALSE(frame.participants[0].reshaped->at(1));
  }
  const auto is_reshaped = [&](std::uint32_t number) {
    instant::FrameInput frame = frame_of(number, 0);
    drawing.add_to(frame);
    return frame.participants[0].reshaped;
  };
  CHECK_FALSE(is_reshaped(3));
  // Built once, and not again for other vehicles' dents.
  const auto before = is_reshaped(2);
  drawing.show(with_dents({{2, {middle}}, {9, {middle}}}), scene);
  CHECK(is_reshaped(2) == before);
  debris::Dent deeper = middle;
  deeper.depth_m = 0.4;
  drawing.show(with_dents({{2, {deeper}}}), scene);
  CHECK(is_reshaped(2) != before);
  // Damaged, and of a session before there were dents.
  Snapshot damaged = with_dents({{2, {middle}}});
  damaged.effects[0].data.pop_back();
  drawing.show(damaged, scene);
  CHECK_FALSE(is_reshaped(2));
  drawing.show(with_dents({{2, {middle}}}), scene);
  CHECK(is_reshaped(2));
  damaged.effects.clear();
  drawing.show(damaged, scene);
  CHECK_FALSE(is_reshaped(2));
}
