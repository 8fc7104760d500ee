#include "engine/scenery/vehicles/lens.hpp"

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"

namespace septet::scenery {

using scene::PartRole;

VehiclePart lens_plate(const char* name, PartRole role, Finish finish, bool ahead, const glm::vec3& middle_m,
                       const glm::vec2& size_m) {
  geometry::MeshBuilder builder;
  builder.material = index_of(finish);
  const float y = ahead ? 0.5f : -0.5f;
  builder.patch({0, -y, -0.5f}, {0, y, -0.5f}, {0, y, 0.5f}, {0, -y, 0.5f});
  Placement place;
  place.parent_from_object.position_m = Vec3(middle_m);
  place.scale = {1.0f, size_m.x, size_m.y};
  place.role = role;
  place.casts_shadow = false;
  return {name, builder.take(), 0, {place}};
}

void add_lamp_plates(VehicleParts& parts, const LampPlaces& p, DetailLevel level) {
  const bool far = level == DetailLevel::far;
  for (const float side : {1.0f, -1.0f}) {
    const auto lamp = [&](const char* name, PartRole role, Finish finish, bool ahead, glm::vec2 at, glm::vec2 size) {
      parts.push_back(lens_plate(name, role, finish, ahead, {ahead ? p.nose_x : p.tail_x, side * at.x, at.y}, size));
    };
    if (p.has_nose) lamp("lamp head", PartRole::lamp_head, Finish::lens_head, true, p.head, p.head_size_m);
    lamp("lamp tail", PartRole::lamp_tail, Finish::lens_tail, false, p.tail, p.size_m);
    lamp("lamp brake", PartRole::lamp_brake, Finish::lens_brake, false, p.brake, p.size_m);
    if (far) continue;
    lamp("lamp reverse", PartRole::lamp_reverse, Finish::lens_reverse, false, p.reverse, {0.09f, p.size_m.y});
    const PartRole role = side > 0 ? PartRole::lamp_indicator_left : PartRole::lamp_indicator_right;
    const char* name = side > 0 ? "lamp indicator left" : "lamp indicator right";
    lamp(name, role, Finish::lens_indicator, false, p.indicator, {0.12f, p.size_m.y});
    if (p.has_nose)
      lamp(name, role, Finish::lens_indicator, true, {p.head.x + 0.5f * p.head_size_m.x + 0.06f, p.head.y},
           {0.10f, p.head_size_m.y});
  }
}

VehiclePart beacon_box(const glm::vec3& middle_m, const glm::vec3& size_m) {
  geometry::MeshBuilder builder;
  builder.material = index_of(Finish::lens_beacon);
  builder.append(geometry::box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}), glm::mat4(1.0f), true);
  Placement place;
  place.parent_from_object.position_m = Vec3(middle_m);
  place.scale = size_m;
  place.role = PartRole::beacon;
  return {"beacon", builder.take(), 0, {place}};
}

}  // namespace septet::scenery
