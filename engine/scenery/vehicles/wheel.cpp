#include "engine/scenery/vehicles/wheel.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"

namespace septet::scenery {
namespace {

using geometry::LathePoint;
using geometry::MeshBuilder;
using geometry::PolygonMesh;
using scene::PartRole;

/// Turns the lathe's axis z to −y, so that its high end is outside (+y).
glm::mat4 axis_to_y() { return glm::rotate(glm::mat4(1.0f), -std::numbers::pi_v<float> / 2, glm::vec3(1, 0, 0)); }

void add_spokes(MeshBuilder& builder, const WheelSize& size, float hub, float rim, float depth) {
  for (int i = 0; i < size.spokes; ++i) {
    const glm::mat4 turn = glm::rotate(
        glm::mat4(1.0f), 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(size.spokes),
        glm::vec3(0, 1, 0));
    const float wide = 0.17f * size.radius_m, narrow = 0.10f * size.radius_m, low = depth - 0.05f;
    const auto at = [&](float x, float y, float z) {
      return builder.vertex(glm::vec3(turn * glm::vec4(x, y, z, 1.0f)));
    };
    // Bar from hub to rim: its face and its two flanks.
    const std::array<std::uint32_t, 8> v{
        at(-wide, depth + 0.012f, hub), at(wide, depth + 0.012f, hub), at(narrow, depth, rim),
        at(-narrow, depth, rim),        at(-wide, low, hub),           at(wide, low, hub),
        at(narrow, low, rim),           at(-narrow, low, rim)};
    builder.quad(v[0], v[3], v[2], v[1]);
    builder.quad(v[0], v[4], v[7], v[3]);
    builder.quad(v[1], v[2], v[6], v[5]);
  }
}

PolygonMesh near_wheel(const WheelSize& size) {
  const float r = size.radius_m, half = size.width_m / 2, rim = 0.66f * r;
  MeshBuilder builder;
  builder.material = index_of(Finish::tyre);
  const std::array<LathePoint, 6> tyre{{{0.60f * r, -0.7f * half},
                                        {0.90f * r, -half},
                                        {r, -0.66f * half},
                                        {r, 0.66f * half},
                                        {0.90f * r, half},
                                        {rim, 0.86f * half}}};
  builder.append(geometry::lathe(tyre, 20), axis_to_y(), true);
  builder.material = index_of(Finish::rim);
  const std::array<LathePoint, 3> flange{{{rim, 0.86f * half}, {0.615f * r, 0.80f * half}, {0.585f * r, 0.45f * half}}};
  builder.append(geometry::lathe(flange, 20), axis_to_y(), true);
  builder.material = index_of(Finish::underbody);
  const std::array<LathePoint, 2> drum{{{0.60f * r, 0.42f * half}, {0.0f, 0.42f * half}}};
  builder.append(geometry::lathe(drum, 12), axis_to_y(), true);
  const std::array<LathePoint, 2> inside{{{0.0f, -0.7f * half}, {0.62f * r, -0.7f * half}}};
  builder.append(geometry::lathe(inside, 10), axis_to_y(), true);
  builder.material = index_of(Finish::rim);
  add_spokes(builder, size, 0.12f * r, 0.61f * r, 0.74f * half);
  const std::array<LathePoint, 3> hub{{{0.20f * r, 0.5f * half}, {0.18f * r, 0.86f * half}, {0.0f, 0.9f * half}}};
  builder.append(geometry::lathe(hub, 8), axis_to_y(), true);
  PolygonMesh mesh = builder.take();
  geometry::crease_by_angle(mesh, 0.6f);
  return mesh;
}

PolygonMesh middle_wheel(const WheelSize& size) {
  const float r = size.radius_m, half = size.width_m / 2;
  MeshBuilder builder;
  builder.material = index_of(Finish::tyre);
  const std::array<LathePoint, 3> tyre{{{r, -half}, {r, 0.8f * half}, {0.64f * r, half}}};
  builder.append(geometry::lathe(tyre, 10), axis_to_y(), true);
  builder.material = index_of(Finish::rim);
  const std::array<LathePoint, 2> disc{{{0.64f * r, half}, {0.0f, 0.7f * half}}};
  builder.append(geometry::lathe(disc, 10), axis_to_y(), true);
  PolygonMesh mesh = builder.take();
  geometry::crease_by_angle(mesh, 0.6f);
  return mesh;
}

Placement at(float x, float y, float z, PartRole role) {
  Placement place;
  place.parent_from_object.position_m = Vec3(x, y, z);
  place.role = role;
  return place;
}

}  // namespace

PolygonMesh wheel_mesh(const WheelSize& size, DetailLevel level) {
  return level == DetailLevel::near ? near_wheel(size) : middle_wheel(size);
}

void add_axle(VehicleParts& parts, const WheelSize& size, float x_m, float half_track_m, bool front) {
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle}) {
    // Middle wheels of all vehicles share one mesh, stretched, so that they are drawn together.
    const bool shared = level == DetailLevel::middle;
    const PolygonMesh left = shared ? middle_wheel({1.0f, 1.0f}) : wheel_mesh(size, level);
    const std::string suffix = level == DetailLevel::near ? "near" : "middle";
    VehiclePart left_part{"wheel left " + suffix, left, 0, {}},
        right_part{"wheel right " + suffix, geometry::mirrored_y(left), 0, {}};
    left_part.places.push_back(
        at(x_m, half_track_m, size.radius_m, front ? PartRole::wheel_front_left : PartRole::wheel_rear_left));
    right_part.places.push_back(
        at(x_m, -half_track_m, size.radius_m, front ? PartRole::wheel_front_right : PartRole::wheel_rear_right));
    for (VehiclePart* part : {&left_part, &right_part}) {
      if (shared) part->places.front().scale = {size.radius_m, size.width_m, size.radius_m};
      set_detail(*part, level);
      // One mesh carries all equal wheels.
      bool merged = false;
      for (VehiclePart& existing : parts)
        if (existing.name == part->name && existing.mesh.vertices_m == part->mesh.vertices_m) {
          existing.places.insert(existing.places.end(), part->places.begin(), part->places.end());
          merged = true;
        }
      if (!merged) parts.push_back(std::move(*part));
    }
  }
}

void add_wheels(VehicleParts& parts, const VehicleModel& model, const WheelSize& size) {
  const auto half_track = static_cast<float>(model.track_m / 2);
  add_axle(parts, size, static_cast<float>(model.wheelbase_m), half_track, true);
  add_axle(parts, size, 0.0f, half_track, false);
}

}  // namespace septet::scenery
