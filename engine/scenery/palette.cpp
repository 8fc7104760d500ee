#include "engine/scenery/palette.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "engine/core/check.hpp"

namespace septet::scenery {
namespace {

/// "tree/412.5/-81.0": kind and place, in tenths of metres.
std::string name_at(std::string_view kind, const Vec3& position_m) {
  const auto tenths = [](double m) { return 0.1 * std::round(10.0 * m) + 0.0; };
  return fmt::format("{}/{:.1f}/{:.1f}", kind, tenths(position_m.x), tenths(position_m.y));
}

}  // namespace

Shape add_shape(scene::SceneBuilder& builder, std::string_view name, const geometry::PolygonMesh& mesh,
                const Palette& palette, const scene::MeshOptions& options) {
  Shape shape;
  geometry::PolygonMesh renumbered = mesh;
  if (renumbered.polygon_materials.empty()) renumbered.polygon_materials.assign(mesh.polygons.size(), 0);
  std::vector<std::uint32_t> used = renumbered.polygon_materials;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& index : renumbered.polygon_materials)
    index = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) - used.begin());
  if (used.size() <= 1) renumbered.polygon_materials.clear();
  for (const std::uint32_t index : used) {
    SEPTET_CHECK(index < palette.size(), "material {} of {} in {}", index, palette.size(), name);
    shape.materials.push_back(palette[index]);
  }
  const bool has_uvs = std::any_of(mesh.corner_uvs.begin(), mesh.corner_uvs.end(), [](const auto& uvs) {
    return std::any_of(uvs.begin(), uvs.end(), [](glm::vec2 uv) { return uv != glm::vec2(0.0f); });
  });
  if (!has_uvs) renumbered.corner_uvs.clear();
  shape.geometry = builder.add_mesh(name, renumbered, options);
  return shape;
}

scene::NodeId place(scene::SceneBuilder& builder, std::string_view name, const Shape& shape, const Placement& placement,
                    scene::NodeId parent) {
  scene::ObjectParameters parameters;
  parameters.parent_from_object = placement.parent_from_object;
  parameters.scale = placement.scale;
  parameters.geometry = shape.geometry;
  parameters.materials = shape.materials;
  parameters.visible_from_m = placement.visible_from_m;
  parameters.visible_to_m = placement.visible_to_m;
  parameters.role = placement.role;
  parameters.casts_shadow = placement.casts_shadow;
  if (parent == scene::no_node)
    return builder.add_object(builder.unused_name(name_at(name, placement.parent_from_object.position_m)), parameters);
  const scene::NodeId object = builder.add_object(name, parameters);
  builder.add_child(parent, object);
  return object;
}

}  // namespace septet::scenery
