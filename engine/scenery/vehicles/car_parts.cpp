#include <algorithm>
#include <string>
#include <utility>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/scenery/vehicles/wheel.hpp"

namespace septet::scenery {
namespace {

using geometry::PolygonMesh;

VehiclePart part(std::string name, PolygonMesh mesh, std::uint32_t subdivision_level = 0) {
  return {std::move(name), std::move(mesh), subdivision_level, {Placement{}}};
}

/// Draws dark discs on the flanks in place of a far car's wheels.
void add_far_wheels(geometry::MeshBuilder& builder, const VehicleModel& model) {
  builder.material = index_of(Finish::tyre);
  const auto r = static_cast<float>(model.wheel_radius_m), y = static_cast<float>(model.width_m / 2) + 0.01f;
  for (const float x : {0.0f, static_cast<float>(model.wheelbase_m)}) {
    builder.patch({x + r, y, 0}, {x - r, y, 0}, {x - 0.8f * r, y, 2 * r}, {x + 0.8f * r, y, 2 * r});
    builder.patch({x - r, -y, 0}, {x + r, -y, 0}, {x + 0.8f * r, -y, 2 * r}, {x - 0.8f * r, -y, 2 * r});
  }
}

}  // namespace

VehicleParts car_parts(const VehicleModel& model) {
  VehicleParts parts;
  const CarShape shape = car_shape(model);
  const bool ambulance = model.kind == ParticipantKind::ambulance;
  const Finish finish = body_finish(model);
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    const std::string suffix = suffix_of(level);
    const std::uint32_t steps = level == DetailLevel::near ? 1 : 0;
    PolygonMesh cage = level == DetailLevel::far ? car_body_far(model, shape) : car_body_cage(model, shape, steps);
    std::replace(cage.polygon_materials.begin(), cage.polygon_materials.end(), index_of(Finish::paint),
                 index_of(finish));
    const PolygonMesh body = shown_surface(cage, steps);
    const CarSurface surface{model, shape, body, level};
    VehicleParts of_level;
    if (level == DetailLevel::far) {
      geometry::MeshBuilder builder;
      builder.append(cage);
      add_far_wheels(builder, model);
      if (ambulance) builder.append(livery(surface));
      of_level.push_back(part("body" + suffix, builder.take()));
    } else {
      // Windows are open near by: the surface is cut here, not on the screen.
      if (level == DetailLevel::near) {
        of_level.push_back(part("body" + suffix, open_body(surface)));
        of_level.push_back(part("lining" + suffix, cabin_lining(surface, of_level.back().mesh)));
        for (VehiclePart& inside : occupants(surface)) {
          inside.name += suffix;
          of_level.push_back(std::move(inside));
        }
      } else {
        of_level.push_back(part("body" + suffix, std::move(cage), steps));
      }
      of_level.push_back(part("trim" + suffix, car_trim(surface)));
    }
    if (!ambulance || level != DetailLevel::far) of_level.push_back(part("livery" + suffix, livery(surface)));
    of_level.push_back(part("load" + suffix, van_load(surface)));
    for (VehiclePart& lamp : car_lamps(surface)) {
      lamp.name += suffix;
      of_level.push_back(std::move(lamp));
    }
    for (VehiclePart& on_roof : roof_parts(surface)) {
      on_roof.name += suffix;
      of_level.push_back(std::move(on_roof));
    }
    for (VehiclePart& p : of_level) {
      if (p.mesh.polygons.empty()) continue;
      set_detail(p, level);
      parts.push_back(std::move(p));
    }
  }
  const bool van = model.kind != ParticipantKind::car;
  add_wheels(parts, model,
             {static_cast<float>(model.wheel_radius_m), van ? 0.225f : 0.215f,
              van                         ? 6
              : model.name == "hatchback" ? 7
                                          : 5});
  return parts;
}

}  // namespace septet::scenery
