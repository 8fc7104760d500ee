#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/fittings.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {
namespace {

using geometry::PolygonMesh;

/// Box of a mesh's polygon.
struct Extent {
  glm::vec3 low, high;
  bool lies_in(const glm::vec3& from, const glm::vec3& to) const {
    return glm::all(glm::greaterThanEqual(low, from)) && glm::all(glm::lessThanEqual(high, to));
  }
};

using IsLeftOut = std::function<bool(std::uint32_t material, const Extent& extent)>;

/// The mesh without some polygons; the same, vertex for vertex, if all stay, so that the scene holds it once.
PolygonMesh without(const PolygonMesh& mesh, const IsLeftOut& is_left_out) {
  PolygonMesh rest = mesh;
  rest.polygons.clear();
  rest.corner_uvs.clear();
  rest.polygon_materials.clear();
  rest.edge_creases.clear();
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const auto& corners = mesh.polygons[i];
    Extent extent{mesh.vertices_m[corners[0]], mesh.vertices_m[corners[0]]};
    for (std::uint32_t k = 1; k < geometry::corner_count(corners); ++k) {
      extent.low = glm::min(extent.low, mesh.vertices_m[corners[k]]);
      extent.high = glm::max(extent.high, mesh.vertices_m[corners[k]]);
    }
    const std::uint32_t material = mesh.polygon_materials.empty() ? 0 : mesh.polygon_materials[i];
    if (is_left_out(material, extent)) continue;
    rest.polygons.push_back(corners);
    if (!mesh.corner_uvs.empty()) rest.corner_uvs.push_back(mesh.corner_uvs[i]);
    if (!mesh.polygon_materials.empty()) rest.polygon_materials.push_back(mesh.polygon_materials[i]);
    if (!mesh.edge_creases.empty()) rest.edge_creases.push_back(mesh.edge_creases[i]);
  }
  return rest;
}

bool is_astride_or_on_foot(const VehicleModel& model) {
  return model.kind == ParticipantKind::motorcycle || model.kind == ParticipantKind::bicycle ||
         model.kind == ParticipantKind::pedestrian;
}

/// What hides the view or belongs to the person whose eyes they are: panes, which are clear from within, the head, and
/// of those who sit the body.
IsLeftOut hides_the_view(const VehicleModel& model, const std::string& part) {
  const glm::vec3 eye(eye_in(model));
  if (is_astride_or_on_foot(model)) {
    constexpr float head_m = 0.27f;
    return [eye](std::uint32_t, const Extent& extent) {
      return glm::length(glm::max(glm::abs(extent.low - eye), glm::abs(extent.high - eye))) < head_m;
    };
  }
  if (part.starts_with("people") || part.starts_with("seats"))
    return [eye](std::uint32_t, const Extent& extent) {
      return extent.lies_in(eye - glm::vec3(0.75f, 0.40f, 2.0f), eye + glm::vec3(0.60f, 0.40f, 0.5f));
    };
  if (model.kind == ParticipantKind::bus) {
    // Housings of mirrors hang around the corners, where the pillars are from within.
    const float x = static_cast<float>(model.front_m()) - 0.7f, y = static_cast<float>(model.width_m / 2) - 0.11f;
    return [x, y](std::uint32_t material, const Extent& extent) {
      const bool housing = material == index_of(Finish::trim) && extent.low.x > x && extent.low.z > 1.5f &&
                           (extent.low.y > y || extent.high.y < -y);
      return housing || material == index_of(Finish::clear_glass);
    };
  }
  if (model.name == "farm-tractor") {
    // Its cab is drawn as a closed box from outside; the roof above it stays.
    const glm::vec3 low(-0.77f, -0.74f, 1.24f), high(0.77f, 0.74f, static_cast<float>(model.height_m) - 0.09f);
    return [low, high](std::uint32_t material, const Extent& extent) {
      return (material == index_of(Finish::trim) || material == index_of(Finish::glass)) && extent.lies_in(low, high);
    };
  }
  return [](std::uint32_t material, const Extent&) { return material == index_of(Finish::clear_glass); };
}

/// True for the seat and the body of the person whose eyes they are.
bool is_own_seat(const std::string& part, const Placement& place, const Vec3& eye_m) {
  if (!part.starts_with("occupant") && !part.starts_with("seat")) return false;
  const Vec3 away_m = place.parent_from_object.position_m - eye_m;
  return std::abs(away_m.x) < 0.6 && std::abs(away_m.y) < 0.35 && std::abs(away_m.z) < 0.6;
}

}  // namespace

VehicleParts inside_parts(const VehicleModel& model) {
  VehicleParts parts;
  if (!is_driven(model) || has_cockpit(model)) return parts;
  const Vec3 eye_m = eye_in(model);
  for (VehiclePart& part : vehicle_parts(model)) {
    // From within everything is near.
    if (part.places.empty() || part.places.front().visible_from_m > 0.0f) continue;
    std::erase_if(part.places, [&](const Placement& place) { return is_own_seat(part.name, place, eye_m); });
    part.mesh = without(part.mesh, hides_the_view(model, part.name));
    // Seen from outside, through the glass, a cabin is dark.
    std::ranges::replace(part.mesh.polygon_materials, index_of(Finish::cabin), index_of(Finish::lining));
    if (part.places.empty() || part.mesh.polygons.empty()) continue;
    parts.push_back(std::move(part));
  }
  for (VehiclePart& part : fittings(model)) parts.push_back(std::move(part));
  return parts;
}

VehicleParts own_head_parts(const VehicleModel& model) {
  VehicleParts parts;
  if (!is_astride_or_on_foot(model)) return parts;
  for (VehiclePart& part : vehicle_parts(model)) {
    if (part.places.empty() || part.places.front().visible_from_m > 0.0f) continue;
    part.mesh =
        without(part.mesh, [is_head = hides_the_view(model, part.name)](std::uint32_t material, const Extent& extent) {
          return !is_head(material, extent);
        });
    if (!part.mesh.polygons.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace septet::scenery
