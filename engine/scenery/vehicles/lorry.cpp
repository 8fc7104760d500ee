#include <algorithm>
#include <utility>
#include <vector>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/lens.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/lorry_load.hpp"
#include "engine/scenery/vehicles/person.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/scenery/vehicles/wheel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// Measures that distinguish one lorry from another; x as in the vehicle frame.
struct LorryShape {
  LoadBay bay;
  float front, cab_rear, cab_top = 3.05f;
  bool has_cab = true, articulated = false, fire = false;
  bool deflector = true;            ///< Fairing over the cab, to the top of a tractor unit or a little below a box.
  float chassis_front;              ///< Front end of the frame that carries the load.
  std::vector<float> driven, free;  ///< Axles with twin and with single wheels, besides the steered one.
};

LorryShape lorry_shape(const VehicleModel& model) {
  LorryShape s;
  s.front = static_cast<float>(model.front_m());
  s.bay.rear = static_cast<float>(-model.rear_overhang_m);
  s.bay.half = static_cast<float>(model.width_m / 2);
  s.bay.height = static_cast<float>(model.height_m);
  s.cab_rear = s.front - 2.15f;
  s.bay.front = s.cab_rear - 0.22f;
  s.chassis_front = s.cab_rear + 0.2f;
  s.driven = {0.0f, -1.35f};
  if (model.name == "lorry") s.bay.load = Load::box;
  if (model.name == "tanker") s.bay.load = Load::tank;
  if (model.name == "tipper") s.bay.load = Load::tipper;
  if (model.name == "timber-lorry") s.bay.load = Load::timber;
  if (model.name == "tanker" || model.name == "tipper" || model.name == "timber-lorry") s.deflector = false;
  if (model.name == "city-articulated") {
    s.articulated = true;
    s.bay.front = s.cab_rear - 0.55f;
    s.driven = {2.75f};
    s.free = {0.0f, -1.35f};
    s.chassis_front = s.bay.front - 0.1f;
  } else if (model.name == "articulated-lorry") {
    s.articulated = true;
    s.cab_rear = s.front - 2.3f;
    s.bay.front = s.bay.rear + 13.6f;
    s.driven = {7.6f};
    s.free = {1.31f, 0.0f, -1.31f};
    s.chassis_front = s.bay.front - 0.1f;
  } else if (model.name == "semitrailer") {
    s.has_cab = false;
    s.articulated = true;
    s.bay.front = s.front;
    s.driven = {};
    s.free = {1.31f, 0.0f, -1.31f};
    s.chassis_front = s.bay.front - 0.1f;
  } else if (model.name == "tractor-unit") {
    s.bay.load = Load::none;
    s.driven = {0.0f};
  } else if (model.name == "fire-engine") {
    s.fire = true;
    s.bay.load = Load::fire;
    s.cab_rear = s.front - 2.75f;
    s.cab_top = 2.85f;
    s.bay.front = s.cab_rear - 0.02f;
    s.driven = {0.0f};
    s.chassis_front = s.cab_rear + 0.2f;
    s.deflector = false;
  }
  return s;
}

geometry::PolygonMesh cab_box(const LorryShape& s, bool fine) {
  geometry::PolygonMesh cab = geometry::box({s.cab_rear, -s.bay.half + 0.04f, 0.62f},
                                            {s.front, s.bay.half - 0.04f, s.cab_top}, fine ? 0.13f : 0.0f);
  // Windscreen leans back a little.
  for (glm::vec3& p : cab.vertices_m)
    if (p.x > s.front - 0.3f && p.z > 2.0f) p.x -= 0.16f;
  return cab;
}

/// Adds the fairing on the cab's roof, which leans back and in.
void add_deflector(MeshBuilder& builder, const LorryShape& s) {
  // Nothing behind a tractor unit is higher.
  const float top = s.bay.load == Load::none ? s.bay.height : std::min(s.bay.height, 3.85f) - 0.18f;
  constexpr float back_m = 0.45f, in_m = 0.12f;
  geometry::PolygonMesh fairing = geometry::box({s.cab_rear + 0.05f, -s.bay.half + 0.22f, s.cab_top - 0.02f},
                                                {s.front - 0.55f, s.bay.half - 0.22f, top});
  for (glm::vec3& p : fairing.vertices_m) {
    if (p.z < s.cab_top) continue;
    if (p.x > s.cab_rear + 1.0f) p.x -= back_m;
    p.y += p.y > 0.0f ? -in_m : in_m;
  }
  builder.material = index_of(Finish::paint);
  builder.append(fairing, glm::mat4(1.0f), true);
}

void add_cab(MeshBuilder& builder, const LorryShape& s, DetailLevel level) {
  const bool fine = level == DetailLevel::near;
  const Finish paint = s.fire ? Finish::fire_red : Finish::paint;
  const geometry::PolygonMesh cab = cab_box(s, fine);
  geometry::PolygonMesh open = cab;
  const auto patch = [&](Finish finish, Face face, const PatchOutline& outline, float lift = 0.012f) {
    builder.material = index_of(finish);
    draw_patch(builder, cab, face, outline, {lift, fine ? 0.08f : 0.0f, 0.2f});
  };
  const auto pane = [&](Face face, const PatchOutline& outline) {
    // Open windows near by.
    if (fine) open = cut_out(open, face, outline, {0.012f, 0.08f, 0.2f});
    patch(fine ? Finish::clear_glass : Finish::glass, face, outline);
  };
  const float half = s.bay.half - 0.04f, window_top = s.cab_top - 0.37f;
  pane(Face::front, rectangle(Face::front, {-half + 0.16f, 1.72f}, {half - 0.16f, window_top}));
  patch(Finish::trim, Face::front, rectangle(Face::front, {-half + 0.25f, 0.98f}, {half - 0.25f, 1.52f}));
  if (level != DetailLevel::far)
    patch(Finish::trim, Face::front, rectangle(Face::front, {-half + 0.14f, 0.76f}, {half - 0.14f, 0.93f}));
  for (const Face face : {Face::left, Face::right}) {
    pane(face, rectangle(face, {s.front - 1.25f, 1.75f}, {s.front - 0.32f, window_top - 0.1f}));
    if (s.fire)  // Crew behind the driver.
      pane(face, rectangle(face, {s.front - 2.45f, 1.75f}, {s.front - 1.45f, window_top - 0.1f}));
  }
  builder.material = index_of(paint);
  builder.append(open, glm::mat4(1.0f), true);
  if (fine) {  // Roof, pillars and rear wall from inside, over a floor below the windows.
    constexpr float floor = 1.35f;
    builder.material = index_of(Finish::cabin);
    add_lining(builder, open, floor, s.cab_rear - 1.0f, s.front + 1.0f);
    const float front = s.front - 0.2f, rear = s.cab_rear + 0.05f, y = half - 0.05f, top = 1.74f;
    builder.patch({rear, y, floor}, {rear, -y, floor}, {front, -y, floor}, {front, y, floor});
    builder.patch({rear, y, floor}, {front, y, floor}, {front, y, top}, {rear, y, top});
    builder.patch({front, -y, floor}, {rear, -y, floor}, {rear, -y, top}, {front, -y, top});
    builder.patch({front, y, floor}, {front, -y, floor}, {front, -y, top}, {front, y, top});
  }
  if (level == DetailLevel::far) return;
  for (const float z : {1.12f, 1.25f, 1.38f})
    patch(Finish::chrome, Face::front, rectangle(Face::front, {-half + 0.32f, z}, {half - 0.32f, z + 0.03f}), 0.02f);
  patch(Finish::plate, Face::front, rectangle(Face::front, {-0.26f, 0.79f}, {0.26f, 0.90f}), 0.02f);
  for (const Face face : {Face::left, Face::right})
    patch(Finish::trim, face, rectangle(face, {s.front - 1.29f, 0.95f}, {s.front - 1.27f, window_top - 0.1f}));
  for (const float side : {1.0f, -1.0f}) {
    const float inner = side * (s.bay.half - 0.02f), outer = side * (s.bay.half + 0.22f);
    add_box(builder, Finish::trim, {s.front - 0.42f, std::min(inner, outer), 1.85f},
            {s.front - 0.22f, std::max(inner, outer), 2.55f}, fine ? 0.05f : 0.0f);
  }
  if (s.deflector) add_deflector(builder, s);
}

/// Driver with an empty seat beside him; in a fire engine the crew, too.
VehicleParts crew(const LorryShape& s) {
  const float head = s.cab_top - 0.78f, x = s.front - 0.85f, y = 0.62f;
  std::vector<SeatPlace> places{{{x, y, head}, true}, {{x, -y, head}, s.fire}};
  if (s.fire)
    for (const float side : {y, 0.0f, -y}) places.push_back({{s.front - 2.0f, side, head}, side != 0.0f});
  return seated_people(places);
}

/// Adds the frame, and the parts that hang on it between and behind the wheels.
void add_chassis(MeshBuilder& builder, const LorryShape& s, float front_axle, DetailLevel level) {
  const bool fine = level == DetailLevel::near;
  const LoadBay& bay = s.bay;
  const float high = s.articulated ? bay.floor : 1.08f;
  add_box(builder, Finish::underbody, {bay.rear + 0.1f, -0.55f, s.articulated ? 0.85f : 0.60f},
          {s.chassis_front, 0.55f, high});
  if (s.articulated && s.has_cab)
    add_box(builder, Finish::underbody, {s.driven.front() - 0.9f, -0.5f, 0.55f}, {s.cab_rear + 0.2f, 0.5f, 0.82f});
  const auto add_wheel = [&](float x, float radius) {
    for (const float side : {1.0f, -1.0f})
      builder.patch({x + side * radius, side * bay.half, 0}, {x - side * radius, side * bay.half, 0},
                    {x - side * 0.8f * radius, side * bay.half, 2 * radius},
                    {x + side * 0.8f * radius, side * bay.half, 2 * radius});
  };
  if (level == DetailLevel::far) {
    builder.material = index_of(Finish::underbody);
    if (s.has_cab) add_wheel(front_axle, 0.5f);
    for (const float x : s.driven) add_wheel(x, 0.5f);
    for (const float x : s.free) add_wheel(x, 0.5f);
    return;
  }
  // Side guards between the axles, mudguards over the rear axles.
  const std::vector<float>& last = s.free.empty() ? s.driven : s.free;
  const float from = last.front() + 1.0f,
              to = s.articulated ? (s.driven.empty() ? bay.front - 3.0f : s.driven[0] - 1.6f) : front_axle - 1.4f;
  for (const float side : {1.0f, -1.0f}) {
    const float inner = side * (bay.half - 0.10f), outer = side * (bay.half - 0.04f);
    const float low_y = std::min(inner, outer), high_y = std::max(inner, outer);
    if (to - from > 1.0f && bay.load != Load::fire)
      for (const float z : {0.50f, 0.78f}) add_box(builder, Finish::rim, {from, low_y, z}, {to, high_y, z + 0.12f});
    for (const std::vector<float>* axles : {&s.driven, &s.free})
      if (!axles->empty() && bay.load != Load::fire)
        add_box(builder, Finish::trim, {axles->back() - 0.7f, std::min(side * 0.62f, outer), 1.02f},
                {axles->front() + 0.62f, std::max(side * 0.62f, outer), 1.07f});
    if (s.articulated)  // Legs on which a trailer stands alone.
      add_box(builder, Finish::trim, {to + 0.15f, std::min(side * 0.6f, side * 0.75f), 0.35f},
              {to + 0.3f, std::max(side * 0.6f, side * 0.75f), bay.floor});
    else if (front_axle > 5.0f)
      add_box(builder, Finish::trim, {2.2f, std::min(side * 0.55f, inner), 0.45f},
              {3.6f, std::max(side * 0.55f, inner), 1.0f}, fine ? 0.06f : 0.0f);
  }
  add_box(builder, Finish::trim, {bay.rear + 0.05f, -bay.half + 0.1f, 0.48f},
          {bay.rear + 0.17f, bay.half - 0.1f, 0.64f});
  const float x = bay.rear - 0.008f;
  builder.material = index_of(Finish::plate);
  builder.patch({x, 0.26f, 0.90f}, {x, -0.26f, 0.90f}, {x, -0.26f, 1.01f}, {x, 0.26f, 1.01f});
}

}  // namespace

VehicleParts lorry_parts(const VehicleModel& model) {
  VehicleParts parts;
  const LorryShape s = lorry_shape(model);
  const auto front_axle = static_cast<float>(model.wheelbase_m);
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    const bool far = level == DetailLevel::far;
    VehicleParts of_level;
    MeshBuilder cab, chassis, load;
    if (s.has_cab) add_cab(cab, s, level);
    add_chassis(chassis, s, front_axle, level);
    add_load(load, s.bay, level);
    if (s.has_cab) of_level.push_back({"cab", cab.take(), 0, {Placement{}}});
    if (s.has_cab && level == DetailLevel::near)
      for (VehiclePart& inside : crew(s)) of_level.push_back(std::move(inside));
    of_level.push_back({"chassis", chassis.take(), 0, {Placement{}}});
    of_level.push_back({"load", load.take(), 0, {Placement{}}});
    LampPlaces lamps;
    lamps.nose_x = s.front + 0.02f;
    lamps.tail_x = s.bay.rear - 0.012f;
    lamps.has_nose = s.has_cab;
    add_lamp_plates(of_level, lamps, level);
    if (s.fire)
      for (const float side : {1.0f, -1.0f}) {
        of_level.push_back(
            beacon_box({s.front - 0.6f, side * (far ? 0.45f : 0.62f), s.cab_top + 0.09f}, {0.28f, 0.75f, 0.2f}));
        if (!far)
          of_level.push_back(beacon_box({s.bay.rear + 0.25f, side * 0.95f, s.bay.height - 0.1f}, {0.22f, 0.22f, 0.2f}));
      }
    add_level(parts, std::move(of_level), level);
  }
  const auto half_track = static_cast<float>(model.track_m / 2), radius = static_cast<float>(model.wheel_radius_m);
  const WheelSize single{radius, 0.30f, 8}, twin{radius, 0.58f, 8};
  if (s.has_cab) add_axle(parts, single, front_axle, half_track + 0.05f, true);
  for (const float x : s.driven) add_axle(parts, twin, x, half_track - 0.06f, false);
  for (const float x : s.free) add_axle(parts, {radius, 0.38f, 8}, x, half_track + 0.02f, false);
  return parts;
}

}  // namespace septet::scenery
