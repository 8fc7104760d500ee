#include <algorithm>
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

/// The body below its windows and without its roof, in whose place the cabin's frame stands: bonnet and, in the mirrors, flanks.
geometry::PolygonMesh body_below_windows(const VehicleModel& model, std::uint32_t material) {
  const CarShape shape = car_shape(model);
  const geometry::PolygonMesh body = shown_surface(car_body_cage(model, shape, 1), 1);
  MeshBuilder builder;
  builder.material = material;
  for (const glm::vec3& p : body.vertices_m) builder.vertex(p);
  for (const auto& corners : body.polygons) {
    const float middle_z = 0.5f * (body.vertices_m[corners[0]].z + body.vertices_m[corners[2]].z);
    if (middle_z < shape.hood_rear_m + 0.02f) builder.quad(corners[0], corners[1], corners[2], corners[3]);
  }
  return builder.take();
}

/// Where the steering wheel turns: the column leans back, and +x of the wheel points along it, away from the driver.
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

/// What each frame makes of a material has it from such a piece.
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
  parts.push_back({"body", body_below_windows(model, index_of(CockpitFinish::paint)), 0, {Placement{}}});
  parts.push_back({"dashboard", dashboard(), 0, {Placement{}}});
  parts.push_back({"instruments", instrument_faces(), 0, {Placement{}}});
  parts.push_back({"frame", cabin_frame(), 0, {Placement{}}});
  parts.push_back({"steering wheel", steering_wheel(), 0, {on_column()}});
  seen_from_within(parts);
  // It is what shades the cabin. Dashboard and wheel are finer than a shadow's texels.
  std::ranges::find(parts, "frame", &VehiclePart::name)->places.front().casts_shadow = true;
  return parts;
}

VehicleParts shell_parts() {
  const VehicleModel& model = vehicle_models()[*find_vehicle_model("volvo-s80")];
  VehicleParts parts{{"body", body_below_windows(model, index_of(Finish::paint)), 0, {Placement{}}}};
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
  // On a screen of another shape than theirs something dull lies around them.
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

VehicleParts sign_parts() { return sample_of(CockpitFinish::signs); }

VehicleParts water_parts() { return sample_of(CockpitFinish::water); }

}  // namespace septet::scenery
