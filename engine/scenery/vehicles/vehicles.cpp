#include "engine/scenery/vehicles/vehicles.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/parked_cars.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {
namespace {

/// Known meshes with their shapes: vehicles of one outline have parts in common, which are sent once and drawn
/// together.
struct KnownShape {
  geometry::PolygonMesh mesh;
  std::uint32_t subdivision_level;
  Shape shape;
};
using KnownShapes = std::multimap<std::size_t, KnownShape>;

bool same(const geometry::PolygonMesh& a, const geometry::PolygonMesh& b) {
  return a.vertices_m == b.vertices_m && a.polygon_materials == b.polygon_materials && a.polygons == b.polygons &&
         a.corner_uvs == b.corner_uvs && a.vertex_creases == b.vertex_creases && a.edge_creases == b.edge_creases;
}

Shape known_shape(scene::SceneBuilder& builder, KnownShapes& known, const std::string& name, const VehiclePart& part,
                  const Palette& palette) {
  const auto [first, last] = known.equal_range(part.mesh.vertices_m.size());
  for (auto it = first; it != last; ++it)
    if (it->second.subdivision_level == part.subdivision_level && same(it->second.mesh, part.mesh))
      return it->second.shape;
  scene::MeshOptions options;
  options.subdivision_level = part.subdivision_level;
  const Shape shape = add_shape(builder, name, part.mesh, palette, options);
  known.emplace(part.mesh.vertices_m.size(), KnownShape{part.mesh, part.subdivision_level, shape});
  return shape;
}

void add_prototype(scene::SceneBuilder& builder, const Palette& palette, KnownShapes& known, std::string_view model,
                   const VehicleParts& parts) {
  const scene::NodeId root = builder.add_prototype(model);
  for (const VehiclePart& part : parts) {
    const std::string name = std::string(model) + "/" + part.name;
    const Shape shape = known_shape(builder, known, name, part, palette);
    for (const Placement& placement : part.places) place(builder, name, shape, placement, root);
  }
}

}  // namespace

void build_vehicles(scene::SceneBuilder& builder, const OwnModels* own_models,
                    std::span<const roadside::ParkedCar> parked) {
  const Palette palette = add_finishes(builder);
  KnownShapes known;
  OwnShapes own(builder, own_models);
  for (const VehicleModel& model : vehicle_models())
    if (const gltf::Model* replacement = own.find(model.name)) {
      Placement placement;
      placement.parent_from_object.position_m = vehicle_from_own_model_m(*replacement, model);
      placement.visible_to_m = vehicles_until_m;
      own.place(model.name, placement, builder.add_prototype(model.name));
    } else {
      add_prototype(builder, palette, known, model.name, vehicle_parts(model));
    }
  // What a person's own model looks like from within is not known: it has no inside.
  for (const VehicleModel& model : vehicle_models()) {
    if (own.find(model.name)) continue;
    if (const VehicleParts parts = inside_parts(model); !parts.empty())
      add_prototype(builder, palette, known, "interior/" + std::string(model.name), parts);
    if (const VehicleParts parts = own_head_parts(model); !parts.empty())
      add_prototype(builder, palette, known, "head/" + std::string(model.name), parts);
  }
  add_prototype(builder, palette, known, "shell/volvo-s80", shell_parts());
  build_parked_cars(builder, palette, parked);
  const Palette inside = add_cockpit_finishes(builder);
  KnownShapes known_inside;
  add_prototype(builder, inside, known_inside, "interior/volvo-s80", interior_parts());
  add_prototype(builder, inside, known_inside, "cockpit/hands", hands_parts());
  add_prototype(builder, inside, known_inside, "cockpit/instruments", instrument_parts());
  add_prototype(builder, inside, known_inside, "cockpit/dials", dial_parts());
  add_prototype(builder, inside, known_inside, "cockpit/signs", sign_parts());
  add_prototype(builder, inside, known_inside, "cockpit/water", water_parts());
}

}  // namespace septet::scenery
