#include "sim-client/frame/torn_vehicle.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim-client/frame/prototype_of.hpp"

namespace septet::frame {
namespace {

using debris::Mount;
using scene::PartRole;

bool is_lens(PartRole role) { return role >= PartRole::lamp_brake && role <= PartRole::lamp_tail; }

bool is_lamp(Mount mount) {
  return mount == Mount::front_left_lamp || mount == Mount::front_right_lamp || mount == Mount::rear_left_lamp ||
         mount == Mount::rear_right_lamp;
}

Vec3 middle_of(const scene::SurfaceMesh& mesh, const scene::Instance& part) {
  return part.world_from_object * (Vec3(part.scale) * Vec3(0.5f * (mesh.bounds_min_m + mesh.bounds_max_m)));
}

/// First material of a prototype; empty while the scene does not have it.
std::optional<std::uint32_t> material_of(const scene::ResolvedScene& scene, std::string_view name) {
  const auto prototype = prototype_of(scene, name);
  if (!prototype || scene.prototypes[*prototype].parts.empty()) return std::nullopt;
  const std::uint32_t mesh = scene.prototypes[*prototype].parts.front().mesh;
  if (mesh >= scene.meshes.size() || scene.meshes[mesh].parts.empty()) return std::nullopt;
  return scene.meshes[mesh].parts.front().material;
}

constexpr std::string_view recess_look = "debris/bumper-plastic", lens_look = "debris/lamp";

/// What one mesh of a prototype has left and lost.
struct CutPart {
  std::size_t index = 0;
  CutMesh cut;
};

float skin_area_m2(const Sheet& sheet) {
  float area_m2 = 0.0f;
  for (const SheetTriangle& t : sheet)
    if (t.is_skin)
      area_m2 += 0.5f * glm::length(glm::cross(t.corners[1].position_m - t.corners[0].position_m,
                                               t.corners[2].position_m - t.corners[0].position_m));
  return area_m2;
}

/// Fixed parts that have something in the region. `mesh_of`: the mesh of a part as it is now; null: it is not looked at.
template <class MeshOf>
std::vector<CutPart> cut_parts(const scene::ResolvedScene& scene, const scene::Prototype& prototype,
                               const scenery::MountRegion& region, const MeshOf& mesh_of) {
  std::vector<CutPart> cuts;
  for (std::size_t i = 0; i < prototype.parts.size(); ++i) {
    const scene::Instance& part = prototype.parts[i];
    const scene::SurfaceMesh* mesh = mesh_of(i);
    if (part.role != PartRole::fixed || !mesh) continue;
    if (auto cut = cut_mesh(*mesh, part.world_from_object, part.scale, scene.materials, region))
      cuts.push_back({i, std::move(*cut)});
  }
  return cuts;
}

/// The part of each level of detail that has lost most: its body, behind whose skin the recess lies.
std::map<float, std::size_t> bodies(const scene::Prototype& prototype, const std::vector<CutPart>& cuts) {
  std::map<float, std::size_t> largest;
  for (std::size_t n = 0; n < cuts.size(); ++n) {
    const auto [found, fresh] = largest.try_emplace(prototype.parts[cuts[n].index].visible_from_m, n);
    if (!fresh && skin_area_m2(cuts[n].cut.taken) > skin_area_m2(cuts[found->second].cut.taken)) found->second = n;
  }
  return largest;
}

}  // namespace

bool is_sheet_metal(PartRole role) { return role == PartRole::fixed || is_lens(role) || role == PartRole::beacon; }

instant::ReshapedParts without_torn(const scene::ResolvedScene& scene, const scene::Prototype& prototype,
                                    const VehicleModel& model, debris::Mounts torn) {
  instant::ReshapedParts parts(prototype.parts.size());
  const auto mesh_of = [&](std::size_t i) -> const scene::SurfaceMesh* {
    const std::uint32_t own = prototype.parts[i].mesh;
    return parts[i] ? parts[i].get() : own < scene.meshes.size() ? &scene.meshes[own] : nullptr;
  };
  const auto dark = material_of(scene, recess_look);
  for (int n = 0; n < debris::mount_count; ++n) {
    const auto mount = static_cast<Mount>(n);
    const auto region = scenery::mount_region(model, mount);
    if ((torn & debris::bit_of(mount)) == 0 || !region) continue;
    std::vector<CutPart> cuts = cut_parts(scene, prototype, *region, mesh_of);
    if (dark && region->skin)
      for (const auto& [from_m, body] : bodies(prototype, cuts)) {
        const scene::Instance& part = prototype.parts[cuts[body].index];
        append(recess_behind(cuts[body].cut.taken, region->recess_m, *dark), part.world_from_object, part.scale,
               cuts[body].cut.left);
      }
    for (CutPart& cut : cuts) parts[cut.index] = std::make_shared<const scene::SurfaceMesh>(std::move(cut.cut.left));
    if (!is_lamp(mount)) continue;
    for (std::size_t i = 0; i < prototype.parts.size(); ++i)
      if (const scene::SurfaceMesh* mesh = mesh_of(i);
          mesh && is_lens(prototype.parts[i].role) &&
          region->skin->holds(glm::vec3(middle_of(*mesh, prototype.parts[i]))))
        parts[i] = std::make_shared<const scene::SurfaceMesh>();
  }
  return parts;
}

Sheet panel_of(const scene::ResolvedScene& scene, const VehicleModel& model, Mount mount) {
  Sheet panel;
  const auto region = scenery::mount_region(model, mount);
  const auto at = prototype_of(scene, model.name);
  const auto dark = material_of(scene, recess_look), lens = material_of(scene, lens_look);
  if (!region || !region->skin || !at || !dark || !lens) return panel;
  const scene::Prototype& prototype = scene.prototypes[*at];
  const auto near_mesh_of = [&](std::size_t i) -> const scene::SurfaceMesh* {
    const scene::Instance& part = prototype.parts[i];
    return part.visible_from_m <= 0.0f && part.mesh < scene.meshes.size() ? &scene.meshes[part.mesh] : nullptr;
  };
  if (is_lamp(mount)) {
    for (std::size_t i = 0; i < prototype.parts.size(); ++i) {
      const scene::Instance& part = prototype.parts[i];
      const scene::SurfaceMesh* mesh = near_mesh_of(i);
      if (!mesh || !is_lens(part.role)) continue;
      if (auto cut = cut_mesh(*mesh, part.world_from_object, part.scale, scene.materials, *region))
        panel.insert(panel.end(), cut->taken.begin(), cut->taken.end());
    }
    for (SheetTriangle& triangle : panel) triangle.material = *lens;
  } else {
    for (const CutPart& cut : cut_parts(scene, prototype, *region, near_mesh_of))
      panel.insert(panel.end(), cut.cut.taken.begin(), cut.cut.taken.end());
  }
  // Linings behind the skin stay with its recess.
  const auto is_lining = [&](const SheetTriangle& t) {
    return !t.is_skin &&
           region->skin->holds((t.corners[0].position_m + t.corners[1].position_m + t.corners[2].position_m) / 3.0f);
  };
  std::erase_if(panel, is_lining);
  Sheet back = recess_behind(panel, is_lamp(mount) ? region->recess_m : 0.04f, *dark);
  turn_over(back);
  panel.insert(panel.end(), back.begin(), back.end());
  return panel;
}

}  // namespace septet::frame
