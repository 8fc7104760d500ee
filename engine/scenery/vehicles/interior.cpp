#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/cockpit_parts.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/world/instrument_panel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// Body below its windows and without its roof, which the cabin's frame replaces. `seen`: only the part that the driver
/// sees, bonnet and, in the mirrors, flanks.
geometry::PolygonMesh body_below_windows(const VehicleModel& model, std::uint32_t material, bool seen) {
  const CarShape shape = car_shape(model);
  const geometry::PolygonMesh body = shown_surface(car_body_cage(model, shape, 1), 1);
  const auto cowl = static_cast<float>(model.wheelbase_m) - shape.cowl_m;
  MeshBuilder builder;
  builder.material = material;
  for (const glm::vec3& p : body.vertices_m) builder.vertex(p);
  for (const auto& corners : body.polygons) {
    const glm::vec3 middle = (body.vertices_m[corners[0]] + body.vertices_m[corners[2]]) * 0.5f;
    const glm::vec3 area = glm::cross(body.vertices_m[corners[2]] - body.vertices_m[corners[0]],
                                      body.vertices_m[corners[3]] - body.vertices_m[corners[1]]);
    const bool bonnet = middle.x > cowl - 0.08f && middle.z > 0.5f && area.z > 0.35f * glm::length(area);
    const bool flank = middle.x < cowl && std::abs(area.y) > 0.6f * glm::length(area);
    if (middle.z < shape.hood_rear_m + 0.02f && (!seen || bonnet || flank))
      builder.quad(corners[0], corners[1], corners[2], corners[3]);
  }
  return builder.take();
}

/// Placement of the steering wheel: the column leans back, and +x of the wheel points along it, away from the driver.
Placement on_column() {
  Placement wheel;
  wheel.role = scene::PartRole::steering_wheel;
  wheel.parent_from_object = {Vec3(1.68, 0.37, 0.816), orientation_from_angles(0.0, 0.42, 0.0)};
  return wheel;
}

void seen_from_within(VehicleParts& parts) {
  for (VehiclePart& part : parts)
    for (Placement& place : part.places) {
      place.visible_to_m = 10.0f;
      place.casts_shadow = false;
    }
}

/// Small piece of a material, from which the meshes of each frame take it.
VehicleParts sample_of(CockpitFinish finish) {
  MeshBuilder plate;
  plate.material = index_of(finish);
  plate.patch({0, 0, 0}, {0.01f, 0, 0}, {0.01f, 0.01f, 0}, {0, 0.01f, 0});
  return {{"sample", plate.take(), 0, {Placement{}}}};
}

}  // namespace

VehicleParts interior_parts() {
  const VehicleModel& model = vehicle_models()[*find_vehicle_model("volvo-s80")];
  VehicleParts parts;
  parts.push_back({"body", body_below_windows(model, index_of(CockpitFinish::paint), true), 0, {Placement{}}});
  parts.push_back({"dashboard", dashboard(), 0, {Placement{}}});
  parts.push_back({"instruments", instrument_faces(), 0, {Placement{}}});
  parts.push_back({"frame", cabin_frame(), 0, {Placement{}}});
  parts.push_back({"steering wheel", steering_wheel(), 0, {on_column()}});
  seen_from_within(parts);
  // Shades the cabin. Dashboard and wheel are finer than a shadow's texels.
  std::ranges::find(parts, "frame", &VehiclePart::name)->places.front().casts_shadow = true;
  return parts;
}

VehicleParts shell_parts() {
  const VehicleModel& model = vehicle_models()[*find_vehicle_model("volvo-s80")];
  VehicleParts parts{{"body", body_below_windows(model, index_of(Finish::paint), false), 0, {Placement{}}}};
  for (VehiclePart& part : vehicle_parts(model)) {
    const bool is_fixed = part.places.front().role == scene::PartRole::fixed;
    if (is_fixed || part.places.front().visible_from_m > 0.0f) continue;
    for (Placement& place : part.places) place.visible_to_m = vehicles_until_m;
    parts.push_back(std::move(part));
  }
  return parts;
}

VehicleParts hands_parts() {
  VehicleParts parts{{"hands", hands(), 0, {on_column()}}};
  seen_from_within(parts);
  return parts;
}

VehicleParts instrument_parts() {
  // A dull surface lies around the instruments on a screen of another shape.
  using namespace instrument_panel;
  MeshBuilder around;
  around.material = index_of(CockpitFinish::rubber);
  const auto corner = [](double across, double upward) {
    return glm::vec3(middle_m + across * right + upward * up - 0.001 * normal);
  };
  around.patch(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
  VehicleParts parts{{"instruments", instrument_faces(), 0, {Placement{}}},
                     {"around", around.take(), 0, {Placement{}}}};
  seen_from_within(parts);
  return parts;
}

VehicleParts dial_parts() {
  VehicleParts parts{{"instruments", instrument_faces(), 0, {Placement{}}}};
  seen_from_within(parts);
  return parts;
}

VehicleParts sign_parts() { return sample_of(CockpitFinish::signs); }

VehicleParts water_parts() { return sample_of(CockpitFinish::water); }

}  // namespace septet::scenery
