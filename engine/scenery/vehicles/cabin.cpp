#include <algorithm>
#include <vector>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/person.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using geometry::PolygonMesh;

/// Interior of the cabin: between the feet of windscreen and rear window, over the belt line.
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
  return open;
}

PolygonMesh cabin_lining(const CarSurface& car, const PolygonMesh& open) {
  const Cabin cabin = cabin_of(car);
  // Lining of roof, pillars and doors: the cabin's enclosure, from behind and a little further in.
  MeshBuilder lining;
  lining.material = index_of(Finish::cabin);
  add_lining(lining, open, cabin.floor, cabin.rear - 0.1f, cabin.front + 0.1f);
  // Tub under the windows, as narrow at the rear as the tail.
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
  return lining.take();
}

VehicleParts occupants(const CarSurface& car) {
  const Cabin cabin = cabin_of(car);
  const Glasshouse g = glasshouse_of(car);
  VehiclePart people{"occupant", sitting_person(1), 0, {}}, seats{"seat", seat_back(), 0, {}};
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
