#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/lens.hpp"
#include "engine/scenery/vehicles/person.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/scenery/vehicles/wheel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

constexpr float cooler_m = 0.12f;  ///< Height of the air conditioning over the roof, which is a bus's highest part.

/// Lines of a bus in side view; heights from the ground.
struct BusShape {
  float front, rear, half, roof, ground, window_low, window_high, lean;
  int doors;     ///< Number on the right side.
  bool lockers;  ///< True for lockers under a coach's high floor.
};

BusShape bus_shape(const VehicleModel& model) {
  const bool coach = model.name == "coach";
  const float roof = static_cast<float>(model.height_m) - cooler_m;
  return {static_cast<float>(model.front_m()),
          static_cast<float>(-model.rear_overhang_m),
          static_cast<float>(model.width_m / 2),
          roof,
          0.34f,
          coach ? 1.95f : 1.15f,
          coach ? roof - 0.55f : roof - 0.45f,
          coach ? 0.45f : 0.12f,
          coach ? 1 : 3,
          coach};
}

geometry::PolygonMesh hull(const BusShape& s, DetailLevel level) {
  geometry::PolygonMesh hull = geometry::box({s.rear, -s.half, s.ground}, {s.front, s.half, s.roof},
                                             level == DetailLevel::near     ? 0.14f
                                             : level == DetailLevel::middle ? 0.10f
                                                                            : 0.0f);
  for (glm::vec3& p : hull.vertices_m)
    if (p.z > s.roof - 0.5f) p.x += p.x > 0 ? -s.lean : 0.3f * s.lean;
  return hull;
}

/// Interior of a near bus, visible through the panes that are cut out of `body`.
struct Saloon {
  MeshBuilder& builder;
  const geometry::PolygonMesh& body;
  geometry::PolygonMesh open = body;

  void add_pane(Face face, glm::vec2 low, glm::vec2 high) {
    const PatchOptions options{0.012f, 0.0f, 0.2f};
    open = cut_out(open, face, rectangle(face, low, high), options);
    builder.material = index_of(Finish::clear_glass);
    draw_patch(builder, body, face, rectangle(face, low, high), options);
  }

  /// Draws the rest of the body, lined, and a floor with low walls.
  void close(const BusShape& s) {
    builder.material = index_of(Finish::paint);
    builder.append(open, glm::mat4(1.0f), true);
    builder.material = index_of(Finish::cabin);
    add_lining(builder, open, s.window_low - 0.5f, s.rear - 1.0f, s.front + 1.0f);
    const float rear = s.rear + 0.12f, front = s.front - 0.25f, y = s.half - 0.08f, low = s.window_low - 0.5f,
                top = s.window_low + 0.01f;
    builder.patch({rear, y, low}, {rear, -y, low}, {front, -y, low}, {front, y, low});
    builder.patch({rear, y, low}, {front, y, low}, {front, y, top}, {rear, y, top});
    builder.patch({front, -y, low}, {rear, -y, low}, {rear, -y, top}, {front, -y, top});
    builder.patch({front, y, low}, {front, -y, low}, {front, -y, top}, {front, y, top});
    builder.patch({rear, -y, low}, {rear, y, low}, {rear, y, top}, {rear, -y, top});
  }
};

/// Driver, and rows of two and two passengers, some seats empty.
VehicleParts passengers(const BusShape& s) {
  const float head = s.window_low + 0.36f, first = s.front - 2.6f, last = s.rear + 1.0f;
  std::vector<SeatPlace> places{{{s.front - 1.15f - 0.6f * s.lean, 0.62f, head}}};
  int number = 0;
  for (float x = first; x > last; x -= 0.86f)
    for (const float y : {0.95f, 0.45f, -0.45f, -0.95f}) {
      ++number;
      places.push_back({{x, y * s.half / 1.275f, head}, number * 7 % 5 < 2});
    }
  return seated_people(places);
}

void add_faces(MeshBuilder& builder, const BusShape& s, const VehicleModel& model, DetailLevel level) {
  const bool far = level == DetailLevel::far, fine = level == DetailLevel::near;
  const geometry::PolygonMesh body = hull(s, level);
  Saloon saloon{builder, body};
  if (!fine) {
    builder.material = index_of(Finish::paint);
    builder.append(body, glm::mat4(1.0f), true);
  }
  const auto patch = [&](Finish finish, Face face, glm::vec2 low, glm::vec2 high, float lift = 0.012f) {
    builder.material = index_of(finish);
    draw_patch(builder, body, face, rectangle(face, low, high), {lift, 0.0f, 0.2f});
  };
  const auto pane = [&](Face face, glm::vec2 low, glm::vec2 high) {
    if (fine)
      saloon.add_pane(face, low, high);
    else
      patch(Finish::glass, face, low, high);
  };
  const float inner = s.half - 0.14f;
  pane(Face::front, {-inner, s.lockers ? 1.35f : 1.0f}, {inner, s.roof - 0.42f});
  pane(Face::rear, {-inner, s.window_low + 0.2f}, {inner, s.window_high});
  if (!far) {
    patch(Finish::trim, Face::front, {-inner, 0.45f}, {inner, 0.62f});
    patch(Finish::plate, Face::front, {-0.26f, 0.64f}, {0.26f, 0.75f}, 0.02f);
    patch(Finish::plate, Face::rear, {-0.26f, 0.72f}, {0.26f, 0.83f}, 0.02f);
    patch(Finish::trim, Face::rear, {-inner, 1.05f}, {inner, 1.3f});
  }
  const float from = s.rear + 0.35f, to = s.front - 0.45f - s.lean;
  for (const Face face : {Face::left, Face::right}) {
    if (far) {
      patch(Finish::glass, face, {from, s.window_low}, {to, s.window_high});
      continue;
    }
    const int panes = fine ? 7 : 1;
    for (int k = 0; k < panes; ++k) {
      const float a = std::lerp(from, to, static_cast<float>(k) / static_cast<float>(panes)),
                  b = std::lerp(from, to, static_cast<float>(k + 1) / static_cast<float>(panes)) -
                      (fine ? 0.06f : 0.0f);
      pane(face, {a, s.window_low}, {b, s.window_high});
    }
    for (const float x : {0.0f, static_cast<float>(model.wheelbase_m)})  // Dark arches.
      patch(Finish::underbody, face, {x - 0.62f, s.ground}, {x + 0.62f, 1.12f}, 0.006f);
    if (fine && s.lockers)
      for (const float x : {1.6f, 2.9f, 4.2f}) patch(Finish::trim, face, {x, 0.6f}, {x + 0.02f, 1.5f}, 0.006f);
  }
  if (far) return;
  const float front_door = s.front - 1.25f;
  // Doors are of glass; the area beside the windows is drawn with them.
  const float door_top = fine ? s.window_low - 0.02f : s.window_high;
  patch(Finish::glass, Face::right, {front_door, 0.5f}, {front_door + 0.95f, door_top});
  if (s.doors > 1) patch(Finish::glass, Face::right, {2.2f, 0.5f}, {3.4f, door_top});
  if (s.doors > 2) patch(Finish::glass, Face::right, {-2.6f, 0.5f}, {-1.4f, door_top});
  if (fine) saloon.close(s);
  builder.material = index_of(Finish::trim);
  for (const float side : {1.0f, -1.0f}) {  // Mirrors like ears.
    const float a = side * (s.half - 0.1f), b = side * (s.half + 0.18f);
    builder.append(
        geometry::box({s.front - 0.1f - s.lean, std::min(a, b), s.window_high - 0.5f},
                      {s.front + 0.08f - s.lean, std::max(a, b), s.window_high - 0.05f}, fine ? 0.04f : 0.0f),
        glm::mat4(1.0f), true);
  }
  builder.append(geometry::box({1.0f, -0.7f, s.roof - 0.03f}, {3.4f, 0.7f, s.roof + cooler_m}), glm::mat4(1.0f), true);
}

}  // namespace

VehicleParts bus_parts(const VehicleModel& model) {
  VehicleParts parts;
  const BusShape s = bus_shape(model);
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    MeshBuilder builder;
    add_faces(builder, s, model, level);
    if (level == DetailLevel::far) {
      builder.material = index_of(Finish::glass);  // Dark as tyres, which saves one draw.
      for (const float x : {0.0f, static_cast<float>(model.wheelbase_m)})
        for (const float side : {1.0f, -1.0f}) {
          const float y = side * (s.half + 0.01f), r = 0.5f * side;
          builder.patch({x + r, y, 0}, {x - r, y, 0}, {x - 0.8f * r, y, 1.0f}, {x + 0.8f * r, y, 1.0f});
        }
    }
    VehicleParts of_level{{"body", builder.take(), 0, {Placement{}}}};
    if (level == DetailLevel::near)
      for (VehiclePart& inside : passengers(s)) of_level.push_back(std::move(inside));
    LampPlaces lamps;
    lamps.nose_x = s.front + 0.02f;
    lamps.tail_x = s.rear - 0.02f;
    lamps.head = {0.92f, 0.8f};
    lamps.tail = {0.95f, 1.02f}, lamps.brake = {0.95f, 1.2f}, lamps.indicator = {0.95f, 1.38f},
    lamps.reverse = {0.95f, 0.88f};
    lamps.size_m = {0.16f, 0.15f};
    add_lamp_plates(of_level, lamps, level);
    add_level(parts, std::move(of_level), level);
  }
  const auto half_track = static_cast<float>(model.track_m / 2), radius = static_cast<float>(model.wheel_radius_m);
  add_axle(parts, {radius, 0.30f, 8}, static_cast<float>(model.wheelbase_m), half_track + 0.05f, true);
  add_axle(parts, {radius, 0.58f, 8}, 0.0f, half_track - 0.06f, false);
  if (s.lockers) add_axle(parts, {radius, 0.30f, 8}, -1.35f, half_track + 0.05f, false);
  return parts;
}

}  // namespace septet::scenery
