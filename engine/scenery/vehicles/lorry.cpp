#include <algorithm>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/scenery/vehicles/wheel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using scene::PartRole;

/// The few measures of a rigid lorry with a box body; x as in the vehicle frame.
struct LorrySize {
  float front, rear, half, height, cab_rear, floor = 1.08f, cab_top = 3.05f;
};

LorrySize size_of(const VehicleModel& model) {
  const auto front = static_cast<float>(model.front_m());
  return {front, static_cast<float>(-model.rear_overhang_m), static_cast<float>(model.width_m / 2),
          static_cast<float>(model.height_m), front - 2.15f};
}

void add_box(MeshBuilder& builder, Finish finish, const glm::vec3& low, const glm::vec3& high, float bevel = 0.0f) {
  builder.material = index_of(finish);
  builder.append(geometry::box(low, high, bevel), glm::mat4(1.0f), true);
}

geometry::PolygonMesh cab_box(const LorrySize& s, bool fine) {
  geometry::PolygonMesh cab =
      geometry::box({s.cab_rear, -s.half + 0.04f, 0.62f}, {s.front, s.half - 0.04f, s.cab_top}, fine ? 0.13f : 0.0f);
  // The screen leans back a little.
  for (glm::vec3& p : cab.vertices_m)
    if (p.x > s.front - 0.3f && p.z > 2.0f) p.x -= 0.16f;
  return cab;
}

void add_cab(MeshBuilder& builder, const LorrySize& s, DetailLevel level) {
  const bool fine = level == DetailLevel::near;
  const geometry::PolygonMesh cab = cab_box(s, fine);
  builder.material = index_of(Finish::paint);
  builder.append(cab, glm::mat4(1.0f), true);
  const auto patch = [&](Finish finish, Face face, const PatchOutline& outline, float lift = 0.012f) {
    builder.material = index_of(finish);
    draw_patch(builder, cab, face, outline, {lift, fine ? 0.08f : 0.0f, 0.2f});
  };
  const float half = s.half - 0.04f;
  patch(Finish::glass, Face::front, rectangle(Face::front, {-half + 0.16f, 1.72f}, {half - 0.16f, 2.68f}));
  patch(Finish::trim, Face::front, rectangle(Face::front, {-half + 0.25f, 0.98f}, {half - 0.25f, 1.52f}));
  patch(Finish::trim, Face::front, rectangle(Face::front, {-half + 0.14f, 0.76f}, {half - 0.14f, 0.93f}));
  for (const Face face : {Face::left, Face::right})
    patch(Finish::glass, face, rectangle(face, {s.front - 1.25f, 1.75f}, {s.front - 0.32f, 2.55f}));
  if (level == DetailLevel::far) return;
  for (const float z : {1.12f, 1.25f, 1.38f})
    patch(Finish::chrome, Face::front, rectangle(Face::front, {-half + 0.32f, z}, {half - 0.32f, z + 0.03f}), 0.02f);
  patch(Finish::plate, Face::front, rectangle(Face::front, {-0.26f, 0.79f}, {0.26f, 0.90f}), 0.02f);
  for (const Face face : {Face::left, Face::right})
    patch(Finish::trim, face, rectangle(face, {s.front - 1.29f, 0.95f}, {s.front - 1.27f, 2.55f}));
  for (const float side : {1.0f, -1.0f}) {
    const float inner = side * (s.half - 0.02f), outer = side * (s.half + 0.22f);
    add_box(builder, Finish::trim, {s.front - 0.42f, std::min(inner, outer), 1.85f},
            {s.front - 0.22f, std::max(inner, outer), 2.55f}, fine ? 0.05f : 0.0f);
    add_box(builder, Finish::trim, {5.7f, side > 0 ? s.half - 0.35f : -s.half + 0.05f, 0.40f},
            {6.0f, side > 0 ? s.half - 0.05f : -s.half + 0.35f, 0.70f});
  }
}

void add_body(MeshBuilder& builder, const LorrySize& s, DetailLevel level) {
  const bool fine = level == DetailLevel::near;
  add_box(builder, Finish::tarpaulin, {s.rear, -s.half, s.floor}, {s.cab_rear - 0.22f, s.half, s.height},
          fine ? 0.04f : 0.0f);
  add_box(builder, Finish::underbody, {s.rear + 0.1f, -0.55f, 0.60f}, {s.cab_rear + 0.2f, 0.55f, s.floor});
  if (level == DetailLevel::far) return;
  add_box(builder, Finish::paint, {s.cab_rear + 0.05f, -s.half + 0.22f, s.cab_top - 0.02f},
          {s.front - 0.85f, s.half - 0.22f, s.height - 0.18f}, fine ? 0.25f : 0.0f);
  for (const float side : {1.0f, -1.0f}) {
    const float inner = side * (s.half - 0.10f), outer = side * (s.half - 0.04f);
    // Side guards between the axles and at the tail, mudguards over the rear axles.
    for (const float z : {0.50f, 0.78f})
      add_box(builder, Finish::rim, {1.0f, std::min(inner, outer), z}, {4.6f, std::max(inner, outer), z + 0.12f});
    add_box(builder, Finish::trim, {-2.05f, std::min(side * 0.62f, outer), 1.02f},
            {0.62f, std::max(side * 0.62f, outer), 1.07f});
    add_box(builder, Finish::trim, {2.2f, std::min(side * 0.55f, inner), 0.45f},
            {3.6f, std::max(side * 0.55f, inner), 1.0f}, fine ? 0.06f : 0.0f);
  }
  add_box(builder, Finish::trim, {s.rear + 0.05f, -s.half + 0.1f, 0.48f}, {s.rear + 0.17f, s.half - 0.1f, 0.64f});
  builder.material = index_of(Finish::trim);
  const float x = s.rear - 0.008f;
  for (const float y : {-0.012f, 0.012f})
    builder.patch({x, y + 0.008f, s.floor + 0.1f}, {x, y - 0.008f, s.floor + 0.1f}, {x, y - 0.008f, s.height - 0.1f},
                  {x, y + 0.008f, s.height - 0.1f});
  builder.material = index_of(Finish::plate);
  builder.patch({x, 0.26f, 0.90f}, {x, -0.26f, 0.90f}, {x, -0.26f, 1.01f}, {x, 0.26f, 1.01f});
  builder.material = index_of(Finish::livery_blue);
  for (const float side : {1.0f, -1.0f}) {
    const float y = side * (s.half + 0.006f), a = side > 0 ? s.cab_rear - 0.5f : s.rear + 0.4f,
                b = side > 0 ? s.rear + 0.4f : s.cab_rear - 0.5f;
    builder.patch({a, y, 1.75f}, {b, y, 1.75f}, {b, y, 2.15f}, {a, y, 2.15f});
  }
}

/// One flat lamp: at the tail below the floor, or in the bumper.
VehiclePart lamp(const char* name, PartRole role, Finish finish, float x, bool front, float y0, float y1, float low,
                 float high) {
  MeshBuilder builder;
  builder.material = index_of(finish);
  const float a = std::max(y0, y1), b = std::min(y0, y1);
  if (front)
    builder.patch({x, b, low}, {x, a, low}, {x, a, high}, {x, b, high});
  else
    builder.patch({x, a, low}, {x, b, low}, {x, b, high}, {x, a, high});
  Placement place;
  place.role = role;
  place.casts_shadow = false;
  return {name, builder.take(), 0, {place}};
}

void add_lamps(VehicleParts& parts, const LorrySize& s, bool far) {
  const float tail = s.rear + 0.035f, nose = s.front + 0.02f;
  for (const float side : {1.0f, -1.0f}) {
    parts.push_back(lamp("lamp head", PartRole::lamp_head, Finish::lens_head, nose, true, side * 0.78f, side * 1.10f,
                         0.78f, 0.95f));
    parts.push_back(lamp("lamp tail", PartRole::lamp_tail, Finish::lens_tail, tail, false, side * 0.78f, side * 0.94f,
                         0.86f, 1.0f));
    parts.push_back(lamp("lamp brake", PartRole::lamp_brake, Finish::lens_brake, tail, false, side * 0.95f,
                         side * 1.08f, 0.86f, 1.0f));
    if (far) continue;
    parts.push_back(lamp("lamp reverse", PartRole::lamp_reverse, Finish::lens_reverse, tail, false, side * 0.68f,
                         side * 0.77f, 0.86f, 1.0f));
    const PartRole role = side > 0 ? PartRole::lamp_indicator_left : PartRole::lamp_indicator_right;
    const char* name = side > 0 ? "lamp indicator left" : "lamp indicator right";
    parts.push_back(lamp(name, role, Finish::lens_indicator, tail, false, side * 1.09f, side * 1.22f, 0.86f, 1.0f));
    parts.push_back(lamp(name, role, Finish::lens_indicator, nose, true, side * 1.11f, side * 1.20f, 0.78f, 0.95f));
  }
}

void add_far_wheels(MeshBuilder& builder, const VehicleModel& model, const LorrySize& s) {
  builder.material = index_of(Finish::tyre);
  const auto r = static_cast<float>(model.wheel_radius_m);
  for (const float x : {-1.35f, 0.0f, static_cast<float>(model.wheelbase_m)})
    for (const float side : {1.0f, -1.0f})
      builder.patch({x + side * r, side * s.half, 0}, {x - side * r, side * s.half, 0},
                    {x - side * 0.8f * r, side * s.half, 2 * r}, {x + side * 0.8f * r, side * s.half, 2 * r});
}

}  // namespace

VehicleParts lorry_parts(const VehicleModel& model) {
  VehicleParts parts;
  const LorrySize s = size_of(model);
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    const char* suffix = level == DetailLevel::near ? " near" : level == DetailLevel::middle ? " middle" : " far";
    MeshBuilder builder;
    add_body(builder, s, level);
    add_cab(builder, s, level);
    if (level == DetailLevel::far) add_far_wheels(builder, model, s);
    VehicleParts of_level{{"body", builder.take(), 0, {Placement{}}}};
    add_lamps(of_level, s, level == DetailLevel::far);
    for (VehiclePart& p : of_level) {
      p.name += suffix;
      set_detail(p, level);
      parts.push_back(std::move(p));
    }
  }
  const auto half_track = static_cast<float>(model.track_m / 2);
  const WheelSize single{static_cast<float>(model.wheel_radius_m), 0.30f, 8},
      twin{static_cast<float>(model.wheel_radius_m), 0.58f, 8};
  add_axle(parts, single, static_cast<float>(model.wheelbase_m), half_track + 0.05f, true);
  add_axle(parts, twin, 0.0f, half_track - 0.06f, false);
  add_axle(parts, twin, -1.35f, half_track - 0.06f, false);
  return parts;
}

}  // namespace septet::scenery
