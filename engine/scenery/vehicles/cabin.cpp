#include <algorithm>
#include <array>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/limb.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using geometry::PolygonMesh;

/// The cabin's room: between the feet of windscreen and rear window, over the belt line.
struct Cabin {
  float rear, front, half, floor, belt, head_z;
};

Cabin cabin_of(const CarSurface& car) {
  const Glasshouse g = glasshouse_of(car);
  const float belt = std::min(car.shape.belt_front_m, car.shape.belt_rear_m);
  // A bulkhead keeps the load of a van behind the seats.
  const float rear = carries_goods(car.model) ? g.roof_front - 0.86f : g.backlight - 0.05f;
  return {rear,         g.cowl + 0.02f, car.half_width_m() * 0.93f,
          belt - 0.30f, belt,           std::min(belt + 0.32f, car.height_m() - 0.20f)};
}

/// From the hips up, belted in; the head's middle is in the origin, and looks ahead.
PolygonMesh sitting(std::uint32_t splits) {
  MeshBuilder b;
  b.material = index_of(Finish::skin);
  add_blob(b, {0.0f, 0, 0.0f}, {0.095f, 0.076f, 0.115f}, splits);
  add_limb(b, {-0.02f, 0, -0.20f}, {-0.01f, 0, -0.09f}, 0.055f, 0.05f, 6);
  b.material = index_of(Finish::leather);
  add_blob(b, {-0.025f, 0, 0.035f}, {0.096f, 0.086f, 0.092f}, 0);
  b.material = index_of(Finish::cloth_bright);
  add_blob(b, {-0.05f, 0, -0.42f}, {0.14f, 0.225f, 0.25f}, 0);
  return b.take();
}

PolygonMesh seat() {
  MeshBuilder b;
  add_box(b, Finish::trim, {-0.20f, -0.25f, -0.75f}, {-0.11f, 0.25f, -0.13f});
  add_box(b, Finish::trim, {-0.19f, -0.12f, -0.12f}, {-0.12f, 0.12f, 0.08f});
  return b.take();
}

}  // namespace

bool carries_goods(const VehicleModel& model) {
  return model.kind != ParticipantKind::car && model.name != "minibus" && model.name != "police-van";
}

PolygonMesh open_body(const CarSurface& car) {
  PolygonMesh open = car.body;
  for (const Window& window : car_windows(car)) {
    if (!window.clear) continue;
    const PatchOptions options = window_options(car, window.face, 0.0f);
    open = cut_out(open, window.face, window.outline, options);
    if (window.face == Face::left) open = cut_out(open, Face::right, mirrored(window.outline), options);
  }
  const Cabin cabin = cabin_of(car);
  // The inside of roof, pillars and doors: what encloses the cabin, from behind and a little further in.
  MeshBuilder lining;
  lining.material = index_of(Finish::cabin);
  std::vector<glm::vec3> normals(open.vertices_m.size(), glm::vec3(0.0f));
  for (const auto& corners : open.polygons) {
    const std::uint32_t last = corners[geometry::corner_count(corners) - 1];
    const glm::vec3 normal = glm::cross(open.vertices_m[corners[2]] - open.vertices_m[corners[0]],
                                        open.vertices_m[last] - open.vertices_m[corners[1]]);
    for (std::uint32_t k = 0; k < geometry::corner_count(corners); ++k) normals[corners[k]] += normal;
  }
  std::vector<std::uint32_t> inner(open.vertices_m.size(), geometry::no_vertex);
  const auto behind = [&](std::uint32_t v) {
    if (inner[v] != geometry::no_vertex) return inner[v];
    const float length = glm::length(normals[v]);
    const glm::vec3 in = length > 0.0f ? normals[v] / length : glm::vec3(0, 0, 1);
    return inner[v] = lining.vertex(open.vertices_m[v] - 0.02f * in);
  };
  for (const auto& c : open.polygons) {
    float highest = -1e9f, x = 0.0f;
    for (std::uint32_t k = 0; k < geometry::corner_count(c); ++k) {
      highest = std::max(highest, open.vertices_m[c[k]].z);
      x += open.vertices_m[c[k]].x / static_cast<float>(geometry::corner_count(c));
    }
    if (highest < cabin.belt - 0.02f || x < cabin.rear - 0.1f || x > cabin.front + 0.1f) continue;
    if (geometry::is_triangle(c))
      lining.triangle(behind(c[2]), behind(c[1]), behind(c[0]));
    else
      lining.quad(behind(c[3]), behind(c[2]), behind(c[1]), behind(c[0]));
  }
  // A tub under the windows, as narrow behind as the tail is.
  const float y = 0.88f * cabin.half, rear_y = std::min(y, 0.86f * car.half_width_m() * car.shape.tail_half_width);
  const bool goods = carries_goods(car.model);
  const float x = goods ? cabin.rear : cabin.rear + 0.12f, low = cabin.floor, top = cabin.belt + 0.02f;
  const float wall = goods ? car.height_m() - 0.32f : top, wall_y = goods ? 0.76f * cabin.half : rear_y;
  const auto at = [&](bool ahead, float side, float z) {
    return ahead ? glm::vec3(cabin.front, side * y, z) : glm::vec3(x, side * rear_y, z);
  };
  lining.patch(at(false, 1, low), at(false, -1, low), at(true, -1, low), at(true, 1, low));
  lining.patch(at(false, 1, low), at(true, 1, low), at(true, 1, top), at(false, 1, top));
  lining.patch(at(true, -1, low), at(false, -1, low), at(false, -1, top), at(true, -1, top));
  lining.patch(at(true, 1, low), at(true, -1, low), at(true, -1, top), at(true, 1, top));
  lining.patch(at(false, -1, low), at(false, 1, low), {x, wall_y, wall}, {x, -wall_y, wall});
  MeshBuilder all;
  all.append(open);
  all.append(lining.take());
  return all.take();
}

VehicleParts occupants(const CarSurface& car) {
  const Cabin cabin = cabin_of(car);
  const Glasshouse g = glasshouse_of(car);
  VehiclePart people{"occupant", sitting(1), 0, {}}, seats{"seat", seat(), 0, {}};
  const float aside = 0.44f * cabin.half;
  const auto row = [&](float x, bool left, bool right) {
    for (const float side : {1.0f, -1.0f}) {
      Placement place;
      place.parent_from_object.position_m = Vec3(x, side * aside, cabin.head_z);
      place.casts_shadow = false;
      seats.places.push_back(place);
      if (side > 0 ? left : right) people.places.push_back(place);
    }
  };
  const bool van = car.model.kind != ParticipantKind::car;
  const float front = van ? g.roof_front - 0.42f : g.roof_front - 0.34f;
  const bool alone = car.model.name == "hatchback" || car.model.name == "saloon" || car.model.name == "taxi" ||
                     car.model.name == "van" || car.model.name == "pick-up" || car.model.name == "box-van";
  row(front, true, !alone);
  if (van && carries_goods(car.model)) return {people, seats};
  // The last row sits under the roof, clear of the rear window.
  for (float x = front - 0.86f; x > std::max(cabin.rear + 0.45f, g.roof_rear + 0.16f); x -= 0.86f)
    row(x, car.model.name == "minibus",
        car.model.name == "taxi" || car.model.name == "minibus" || car.model.name == "estate");
  return {people, seats};
}

}  // namespace septet::scenery
