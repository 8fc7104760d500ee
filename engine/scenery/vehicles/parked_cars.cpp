#include "engine/scenery/vehicles/parked_cars.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/world/paint.hpp"

namespace septet::scenery {
namespace {

constexpr float parked_until_m = 450.0f;

/// Finish of a part when its lamps are out.
std::uint32_t unlit(std::uint32_t finish) {
  switch (static_cast<Finish>(finish)) {
    case Finish::lens_head:
    case Finish::lens_reverse:
      return index_of(Finish::rim);
    case Finish::lens_tail:
    case Finish::lens_brake:
      return index_of(Finish::fire_red);
    case Finish::lens_indicator:
      return index_of(Finish::livery_yellow);
    default:
      return finish;
  }
}

glm::mat4 matrix_of(const Placement& placement) {
  const glm::mat4 moved = glm::translate(glm::mat4(1.0f), glm::vec3(placement.parent_from_object.position_m));
  return glm::scale(moved * glm::mat4_cast(glm::quat(placement.parent_from_object.orientation)), placement.scale);
}

/// Parts that are drawn over the same distances and with the same subdivision, as one mesh.
struct Layer {
  geometry::MeshBuilder builder;
  Placement range;
  std::uint32_t subdivision_level = 0;
};

std::vector<Layer> layers_of(const VehicleModel& model) {
  std::map<std::pair<float, std::uint32_t>, Layer> layers;
  for (VehiclePart& part : vehicle_parts(model)) {
    if (part.name.starts_with("people")) continue;
    for (std::uint32_t& finish : part.mesh.polygon_materials) finish = unlit(finish);
    for (const Placement& place : part.places) {
      Layer& layer = layers[{place.visible_from_m, part.subdivision_level}];
      layer.builder.append(part.mesh, matrix_of(place));
      layer.range.visible_from_m = place.visible_from_m;
      layer.range.visible_to_m = std::min(place.visible_to_m, parked_until_m);
      layer.subdivision_level = part.subdivision_level;
    }
  }
  std::vector<Layer> found;
  found.reserve(layers.size());
  for (auto& [key, layer] : layers) found.push_back(std::move(layer));
  return found;
}

struct ParkedShape {
  Shape shape;
  Placement range;
};

}  // namespace

void build_parked_cars(scene::SceneBuilder& builder, const Palette& palette,
                       std::span<const roadside::ParkedCar> cars) {
  std::map<ModelIndex, std::vector<ParkedShape>> shapes;
  std::array<scene::NodeId, body_colors.size()> paints{};
  paints.fill(scene::no_node);
  for (const roadside::ParkedCar& car : cars) {
    std::vector<ParkedShape>& known = shapes[car.model];
    if (known.empty())
      for (Layer& layer : layers_of(vehicle_models()[car.model])) {
        scene::MeshOptions options;
        options.subdivision_level = layer.subdivision_level;
        known.push_back({add_shape(builder, "parked car", layer.builder.take(), palette, options), layer.range});
      }
    const std::size_t colour = car.paint % body_colors.size();
    if (paints[colour] == scene::no_node) {
      scene::MaterialParameters paint;
      paint.base_color = body_colors[colour];
      paint.clear_coat = 1.0f;
      paints[colour] = builder.add_material("parked car", paint);
    }
    scene::NodeId car_object = scene::no_node;  // One name moves and hides the car: its other levels are children.
    for (const ParkedShape& one : known) {
      Shape shape = one.shape;
      std::ranges::replace(shape.materials, palette[index_of(Finish::paint)], paints[colour]);
      Placement placement = one.range;
      const bool is_first = car_object == scene::no_node;
      placement.parent_from_object = is_first ? car.world_from_vehicle : RigidTransform{};
      const scene::NodeId object = place(builder, "parked car", shape, placement, car_object);
      if (is_first) car_object = object;
    }
  }
}

}  // namespace septet::scenery
