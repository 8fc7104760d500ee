#include "engine/scenery/vehicles/vehicles.hpp"

#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {
namespace {

void add_prototype(scene::SceneBuilder& builder, const Palette& palette, std::string_view model,
                   const VehicleParts& parts) {
  const scene::NodeId root = builder.add_prototype(model);
  for (const VehiclePart& part : parts) {
    const std::string name = std::string(model) + "/" + part.name;
    scene::MeshOptions options;
    options.subdivision_level = part.subdivision_level;
    const Shape shape = add_shape(builder, name, part.mesh, palette, options);
    for (const Placement& placement : part.places) place(builder, name, shape, placement, root);
  }
}

}  // namespace

void build_vehicles(scene::SceneBuilder& builder) {
  const Palette palette = add_finishes(builder);
  for (const VehicleModel& model : vehicle_models()) add_prototype(builder, palette, model.name, vehicle_parts(model));
  const Palette inside = add_cockpit_finishes(builder);
  add_prototype(builder, inside, "interior/volvo-s80", interior_parts());
  add_prototype(builder, inside, "cockpit/hands", hands_parts());
  add_prototype(builder, inside, "cockpit/instruments", instrument_parts());
  add_prototype(builder, inside, "cockpit/signs", sign_parts());
}

}  // namespace septet::scenery
