/// Slow and towed vehicles: farm tractors and caravans.

#include <algorithm>
#include <utility>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/lens.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/scenery/vehicles/wheel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

void add_tractor_body(MeshBuilder& b, float front, float height, bool fine) {
  add_box(b, Finish::paint, {0.75f, -0.36f, 0.95f}, {front - 0.08f, 0.36f, 1.62f}, fine ? 0.1f : 0.0f);  // Bonnet.
  add_box(b, Finish::underbody, {-0.45f, -0.28f, 0.55f}, {front - 0.2f, 0.28f, 0.98f});
  add_box(b, Finish::trim, {front - 0.35f, -0.3f, 0.5f}, {front, 0.3f, 0.85f});  // Weights.
  const geometry::PolygonMesh cab =
      geometry::box({-0.75f, -0.72f, 1.25f}, {0.75f, 0.72f, height - 0.1f}, fine ? 0.06f : 0.0f);
  b.material = index_of(Finish::trim);
  b.append(cab, glm::mat4(1.0f), true);
  b.material = index_of(Finish::glass);
  for (const Face face : {Face::left, Face::right})
    draw_patch(b, cab, face, rectangle(face, {-0.62f, 1.35f}, {0.62f, height - 0.28f}), {0.01f, 0.0f, 0.2f});
  for (const Face face : {Face::front, Face::rear})
    draw_patch(b, cab, face, rectangle(face, {-0.6f, 1.65f}, {0.6f, height - 0.28f}), {0.01f, 0.0f, 0.2f});
  add_box(b, Finish::paint, {-0.8f, -0.78f, height - 0.12f}, {0.85f, 0.78f, height}, fine ? 0.05f : 0.0f);
  for (const float side : {1.0f, -1.0f}) {  // Mudguards, exhaust.
    const float inner = side * 0.6f, outer = side * 1.08f;
    add_box(b, Finish::paint, {-0.62f, std::min(inner, outer), 1.6f}, {0.6f, std::max(inner, outer), 1.68f});
  }
  add_box(b, Finish::trim, {1.2f, -0.4f, 1.5f}, {1.3f, -0.3f, 2.5f});
}

void add_flat_wheel(MeshBuilder& b, float x, float y, float r) {
  b.material = index_of(Finish::trim);
  for (const float side : {1.0f, -1.0f})
    b.patch({x + side * r, side * y, 0}, {x - side * r, side * y, 0}, {x - side * 0.8f * r, side * y, 2 * r},
            {x + side * 0.8f * r, side * y, 2 * r});
}

}  // namespace

VehicleParts farm_tractor_parts(const VehicleModel& model) {
  VehicleParts parts;
  const auto front = static_cast<float>(model.front_m()), height = static_cast<float>(model.height_m);
  const auto wheelbase = static_cast<float>(model.wheelbase_m), rear = static_cast<float>(-model.rear_overhang_m);
  const auto half_track = static_cast<float>(model.track_m / 2), radius = static_cast<float>(model.wheel_radius_m);
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    MeshBuilder b;
    add_tractor_body(b, front, height, level == DetailLevel::near);
    add_box(b, Finish::trim, {rear, -0.3f, 0.5f}, {-0.4f, 0.3f, 0.9f});  // Hitch.
    if (level == DetailLevel::far) {
      add_flat_wheel(b, 0.0f, half_track + 0.28f, radius);
      add_flat_wheel(b, wheelbase, half_track + 0.2f, 0.55f);
    }
    VehicleParts of_level{{"body", b.take(), 0, {Placement{}}}};
    LampPlaces lamps;
    lamps.nose_x = front - 0.06f;
    lamps.tail_x = -0.64f;
    lamps.head = {0.2f, 1.4f}, lamps.head_size_m = {0.16f, 0.14f};
    lamps.tail = {0.95f, 1.5f}, lamps.brake = {0.78f, 1.5f}, lamps.reverse = {0.66f, 1.5f},
    lamps.indicator = {1.06f, 1.5f};
    add_lamp_plates(of_level, lamps, level);
    add_level(parts, std::move(of_level), level);
  }
  add_axle(parts, {0.55f, 0.40f, 6}, wheelbase, half_track, true);
  add_axle(parts, {radius, 0.55f, 6}, 0.0f, half_track, false);
  return parts;
}

VehicleParts caravan_parts(const VehicleModel& model) {
  VehicleParts parts;
  const auto front = static_cast<float>(model.front_m()), rear = static_cast<float>(-model.rear_overhang_m);
  const auto half = static_cast<float>(model.width_m / 2), height = static_cast<float>(model.height_m);
  const float hull_front = front - 1.2f;  // Hull begins behind the drawbar.
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    const bool far = level == DetailLevel::far;
    geometry::PolygonMesh hull = geometry::box({rear, -half, 0.42f}, {hull_front, half, height}, far ? 0.0f : 0.16f);
    for (glm::vec3& p : hull.vertices_m)
      if (p.z > height - 0.9f && p.x > 0) p.x -= 0.45f;
    MeshBuilder b;
    b.material = index_of(Finish::white_panel);
    b.append(hull, glm::mat4(1.0f), true);
    const auto patch = [&](Finish finish, Face face, glm::vec2 low, glm::vec2 high) {
      b.material = index_of(finish);
      draw_patch(b, hull, face, rectangle(face, low, high), {0.012f, far ? 0.0f : 0.1f, 0.2f});
    };
    for (const Face face : {Face::left, Face::right}) {
      patch(Finish::glass, face, {rear + 0.5f, 1.35f}, {rear + 1.6f, 2.0f});
      patch(Finish::glass, face, {0.6f, 1.35f}, {1.9f, 2.0f});
      patch(Finish::trim, face, {rear + 0.2f, 0.62f}, {hull_front - 0.2f, 0.72f});
    }
    patch(Finish::glass, Face::rear, {-0.8f, 1.35f}, {0.8f, 2.0f});
    patch(Finish::glass, Face::front, {-0.8f, 1.3f}, {0.8f, 1.68f});
    if (!far) patch(Finish::plate, Face::rear, {-0.26f, 0.75f}, {0.26f, 0.86f});
    b.material = index_of(Finish::trim);
    for (const float side : {1.0f, -1.0f})
      add_limb(b, {hull_front - 0.1f, side * 0.7f, 0.48f}, {front - 0.025f, 0, 0.46f}, 0.05f, 0.04f, far ? 3 : 6);
    if (far) add_flat_wheel(b, 0.0f, half + 0.01f, 0.32f);
    VehicleParts of_level{{"body", b.take(), 0, {Placement{}}}};
    LampPlaces lamps;
    lamps.tail_x = rear - 0.02f;
    lamps.has_nose = false;
    lamps.indicator.x = half - 0.07f;
    add_lamp_plates(of_level, lamps, level);
    add_level(parts, std::move(of_level), level);
  }
  add_axle(parts, {static_cast<float>(model.wheel_radius_m), 0.20f, 5}, 0.0f, static_cast<float>(model.track_m / 2),
           false);
  return parts;
}

}  // namespace septet::scenery
