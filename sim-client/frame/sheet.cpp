#include "sim-client/frame/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim-client/frame/surface_vertices.hpp"

namespace septet::frame {
namespace {

using scene::SurfaceVertex;
using scenery::RegionBox;

/// A corner in the object's frame, and its place in the vehicle's.
struct Corner {
  SurfaceVertex vertex;
  glm::vec3 at;
};
using Polygon = std::vector<Corner>;

/// Parts of a polygon up to a plane across an axis, and beyond it; `sign` −1: the axis runs the other way.
std::pair<Polygon, Polygon> split(const Polygon& polygon, int axis, float limit, float sign) {
  std::pair<Polygon, Polygon> parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float at_a = sign * (limit - a.at[axis]), at_b = sign * (limit - b.at[axis]);
    (at_a >= 0.0f ? parts.first : parts.second).push_back(a);
    if ((at_a >= 0.0f) == (at_b >= 0.0f)) continue;
    const float share = at_a / (at_a - at_b);
    const Corner edge{between(a.vertex, b.vertex, share), glm::mix(a.at, b.at, share)};
    parts.first.push_back(edge);
    parts.second.push_back(edge);
  }
  return parts;
}

/// The part of a polygon in a box; what lies outside is added to `outside`.
Polygon clipped(Polygon polygon, const RegionBox& box, std::vector<Polygon>& outside) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.0f, -1.0f}) {
      if (polygon.size() < 3) return {};
      auto [in, out] = split(polygon, axis, sign > 0 ? box.high_m[axis] : box.low_m[axis], sign);
      if (out.size() >= 3) outside.push_back(std::move(out));
      polygon = std::move(in);
    }
  return polygon.size() >= 3 ? polygon : Polygon();
}

class Cutting {
 public:
  Cutting(const scene::SurfaceMesh& mesh, const RigidTransform& vehicle_from_object, const glm::vec3& scale,
          std::span<const scene::SurfaceMaterial> materials, const scenery::MountRegion& region)
      : mesh_(mesh), place_(vehicle_from_object), scale_(scale), materials_(materials), region_(region) {
    left_.vertices = mesh.vertices;
    left_.revision = mesh.revision;
    left_.bounds_min_m = mesh.bounds_min_m;
    left_.bounds_max_m = mesh.bounds_max_m;
    if (region.skin) boxes_.push_back(*region.skin);
    boxes_.insert(boxes_.end(), region.carried.begin(), region.carried.end());
  }

  std::optional<CutMesh> take() {
    for (const scene::MeshPart& part : mesh_.parts) {
      const auto first = static_cast<std::uint32_t>(left_.indices.size());
      for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) cut(part, part.first_index + i);
      left_.parts.push_back({first, static_cast<std::uint32_t>(left_.indices.size()) - first, part.material});
    }
    if (!any_) return std::nullopt;
    return CutMesh{std::move(left_), std::move(taken_)};
  }

 private:
  void cut(const scene::MeshPart& part, std::uint32_t at) {
    Polygon triangle;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const SurfaceVertex& vertex = mesh_.vertices[mesh_.indices[at + k]];
      triangle.push_back({vertex, glm::vec3(place_ * (Vec3(scale_) * Vec3(vertex.position_m)))});
    }
    const glm::vec3 middle = (triangle[0].at + triangle[1].at + triangle[2].at) / 3.0f;
    const bool known = part.material < materials_.size();
    if (known && materials_[part.material].opacity < 1.0f) {
      if (region_.panes && region_.panes->holds(middle))
        any_ = true;
      else
        keep(at);
      return;
    }
    const bool whole = known && materials_[part.material].picture_columns > 1;
    for (std::size_t n = 0; n < boxes_.size(); ++n) {
      std::vector<Polygon> outside;
      const Polygon in = !whole                    ? clipped(triangle, boxes_[n], outside)
                         : boxes_[n].holds(middle) ? triangle
                                                   : Polygon();
      if (in.empty()) continue;
      any_ = true;
      put(in, part.material, n == 0 && region_.skin.has_value());
      for (const Polygon& polygon : outside) keep(polygon);
      return;
    }
    keep(at);
  }

  void keep(std::uint32_t at) {
    for (std::uint32_t k = 0; k < 3; ++k) left_.indices.push_back(mesh_.indices[at + k]);
  }
  void keep(const Polygon& polygon) {
    const auto first = static_cast<std::uint32_t>(left_.vertices.size());
    for (const Corner& corner : polygon) left_.vertices.push_back(corner.vertex);
    for (std::uint32_t k = 1; k + 1 < polygon.size(); ++k)
      for (const std::uint32_t corner : {0u, k, k + 1}) left_.indices.push_back(first + corner);
  }
  void put(const Polygon& polygon, std::uint32_t material, bool of_skin) {
    const bool mirrored = scale_.x * scale_.y * scale_.z < 0.0f;
    const auto in_vehicle = [&](const Corner& corner) {
      const Vec3 normal = place_.orientation * glm::normalize(Vec3(corner.vertex.normal) / Vec3(scale_));
      return SurfaceVertex{corner.at, glm::vec3(normal), corner.vertex.uv, corner.vertex.color};
    };
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      SheetTriangle triangle{{in_vehicle(polygon[0]), in_vehicle(polygon[k]), in_vehicle(polygon[k + 1])}, material};
      if (mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
      const auto& c = triangle.corners;
      const glm::vec3 area = glm::cross(c[1].position_m - c[0].position_m, c[2].position_m - c[0].position_m);
      triangle.is_skin = of_skin && glm::dot(area, region_.outward) > 0.05f * glm::length(area);
      taken_.push_back(triangle);
    }
  }

  const scene::SurfaceMesh& mesh_;
  const RigidTransform& place_;
  const glm::vec3& scale_;
  std::span<const scene::SurfaceMaterial> materials_;
  const scenery::MountRegion& region_;
  std::vector<RegionBox> boxes_;
  scene::SurfaceMesh left_;
  Sheet taken_;
  bool any_ = false;
};

SheetTriangle plain(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, std::uint32_t material) {
  const glm::vec3 area = glm::cross(b - a, c - a);
  const float length = glm::length(area);
  const glm::vec3 normal = length > 0.0f ? area / length : glm::vec3(0.0f, 0.0f, 1.0f);
  return {{SurfaceVertex{a, normal, {}}, SurfaceVertex{b, normal, {}}, SurfaceVertex{c, normal, {}}}, material};
}

}  // namespace

std::uint64_t place_key(const glm::vec3& place_m) {
  std::uint64_t key = 0;
  for (int c = 0; c < 3; ++c)
    key = key << 21 | (static_cast<std::uint64_t>(std::llround(place_m[c] * 2000.0f) + (1 << 20)) & 0x1fffff);
  return key;
}

std::optional<CutMesh> cut_mesh(const scene::SurfaceMesh& mesh, const RigidTransform& vehicle_from_object,
                                const glm::vec3& scale, std::span<const scene::SurfaceMaterial> materials,
                                const scenery::MountRegion& region) {
  if (!(std::min({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)}) > 1e-6f) || !makes_sense(mesh))
    return std::nullopt;
  return Cutting(mesh, vehicle_from_object, scale, materials, region).take();
}

Sheet recess_behind(const Sheet& sheet, float depth_m, std::uint32_t material) {
  // Open edges: those of one triangle alone, as they run along it.
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> sides;
  for (const SheetTriangle& triangle : sheet)
    for (std::size_t k = 0; k < 3; ++k)
      if (triangle.is_skin)
        ++sides[std::minmax(place_key(triangle.corners[k].position_m),
                            place_key(triangle.corners[(k + 1) % 3].position_m))];
  Sheet recess;
  const auto behind = [&](const SurfaceVertex& v) { return v.position_m - depth_m * v.normal; };
  for (const SheetTriangle& triangle : sheet) {
    if (!triangle.is_skin) continue;
    SheetTriangle& back = recess.emplace_back(triangle);
    back.material = material;
    for (SurfaceVertex& vertex : back.corners) vertex.position_m = behind(vertex);
    for (std::size_t k = 0; k < 3; ++k) {
      const SurfaceVertex &a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3];
      if (sides[std::minmax(place_key(a.position_m), place_key(b.position_m))] != 1) continue;
      recess.push_back(plain(a.position_m, b.position_m, behind(b), material));
      recess.push_back(plain(a.position_m, behind(b), behind(a), material));
    }
  }
  return recess;
}

void turn_over(Sheet& sheet) {
  for (SheetTriangle& triangle : sheet) {
    std::swap(triangle.corners[1], triangle.corners[2]);
    for (SurfaceVertex& vertex : triangle.corners) vertex.normal = -vertex.normal;
  }
}

void append(const Sheet& sheet, const RigidTransform& vehicle_from_object, const glm::vec3& scale,
            scene::SurfaceMesh& mesh) {
  const RigidTransform object_from_vehicle = inverse(vehicle_from_object);
  const bool mirrored = scale.x * scale.y * scale.z < 0.0f;
  for (const SheetTriangle& triangle : sheet) {
    if (mesh.parts.empty() || mesh.parts.back().material != triangle.material)
      mesh.parts.push_back({static_cast<std::uint32_t>(mesh.indices.size()), 0, triangle.material});
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const SurfaceVertex& vertex : triangle.corners) {
      const Vec3 normal = (object_from_vehicle.orientation * Vec3(vertex.normal)) * Vec3(scale);
      mesh.vertices.push_back({glm::vec3((object_from_vehicle * Vec3(vertex.position_m)) / Vec3(scale)),
                               glm::vec3(glm::normalize(normal)), vertex.uv, vertex.color});
    }
    for (const std::uint32_t corner : {0u, mirrored ? 2u : 1u, mirrored ? 1u : 2u})
      mesh.indices.push_back(first + corner);
    mesh.parts.back().index_count += 3;
  }
}

}  // namespace septet::frame
