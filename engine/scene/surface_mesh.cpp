#include "engine/scene/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/geometry/subdivision.hpp"

namespace septet::scene {
namespace {

using geometry::corner_count;
using geometry::no_vertex;
using geometry::PolygonMesh;

constexpr std::uint32_t split_from = 0x80000000u;  ///< Creases of at least a half split normals.
constexpr std::uint32_t most_levels = 4;
constexpr std::size_t most_refined_polygons = 1u << 22;
constexpr float same_uv = 1e-5f;

bool makes_sense(const PolygonCorners& corners, std::size_t vertices) {
  const std::uint32_t count = corner_count(corners);
  for (std::uint32_t k = 0; k < count; ++k) {
    if (corners[k] >= vertices) return false;
    for (std::uint32_t j = 0; j < k; ++j)
      if (corners[j] == corners[k]) return false;
  }
  return true;
}

const GeometryLayer* layer_of_type(const GeometryData& geometry, std::string_view name, LayerType type) {
  const GeometryLayer* layer = name.empty() ? nullptr : find_layer(geometry, name);
  return layer && layer->type == type ? layer : nullptr;
}

template <class T>
std::array<T, 4> four(const std::vector<T>& values, std::size_t polygon) {
  return {values[polygon * 4], values[polygon * 4 + 1], values[polygon * 4 + 2], values[polygon * 4 + 3]};
}

/// Corners that share one normal: a corner is number polygon · 4 + k, a group is named by one of its corners.
class SmoothGroups {
 public:
  explicit SmoothGroups(const PolygonMesh& mesh) : group_(mesh.polygons.size() * 4) {
    std::iota(group_.begin(), group_.end(), 0u);
    join_over_smooth_edges(mesh);
    for (std::uint32_t corner = 0; corner < group_.size(); ++corner) group_[corner] = find(corner);
  }
  std::uint32_t of(std::size_t polygon, std::uint32_t k) const { return group_[polygon * 4 + k]; }

 private:
  /// One polygon's side of an edge, kept with the edge's lower vertex.
  struct Side {
    std::uint32_t higher;  ///< The edge's higher vertex.
    std::uint32_t polygon, k;
    bool rises;  ///< Runs from the lower to the higher vertex.
  };

  std::uint32_t find(std::uint32_t corner) {
    while (group_[corner] != corner) corner = group_[corner] = group_[group_[corner]];
    return corner;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    group_[std::max(a, b)] = std::min(a, b);
  }

  static std::uint32_t edge_crease(const PolygonMesh& mesh, std::uint32_t polygon, std::uint32_t k) {
    return mesh.edge_creases.empty() ? mesh.default_edge_crease : mesh.edge_creases[polygon][k];
  }
  static bool vertex_splits(const PolygonMesh& mesh, std::uint32_t vertex) {
    return (mesh.vertex_creases.empty() ? mesh.default_vertex_crease : mesh.vertex_creases[vertex]) >= split_from;
  }

  void join_over_smooth_edges(const PolygonMesh& mesh) {
    if (mesh.edge_creases.empty() && mesh.default_edge_crease >= split_from) return;
    std::vector<std::uint32_t> first(mesh.vertices_m.size() + 1, 0);
    const auto each_side = [&](auto visit) {
      for (std::uint32_t p = 0; p < mesh.polygons.size(); ++p) {
        const std::uint32_t count = corner_count(mesh.polygons[p]);
        for (std::uint32_t k = 0; k < count; ++k) {
          const std::uint32_t a = mesh.polygons[p][k], b = mesh.polygons[p][(k + 1) % count];
          visit(std::min(a, b), Side{std::max(a, b), p, k, a < b});
        }
      }
    };
    each_side([&](std::uint32_t lower, const Side&) { ++first[lower + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Side> sides(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    each_side([&](std::uint32_t lower, const Side& side) { sides[next[lower]++] = side; });

    for (std::uint32_t lower = 0; lower + 1 < first.size(); ++lower) {
      const auto begin = sides.begin() + first[lower], end = sides.begin() + first[lower + 1];
      std::sort(begin, end, [](const Side& a, const Side& b) {
        return std::pair(a.higher, a.polygon) < std::pair(b.higher, b.polygon);
      });
      for (auto it = begin; it != end;) {
        auto last = it;
        while (last != end && last->higher == it->higher) ++last;
        if (last - it == 2) join_sides(mesh, lower, *it, *(it + 1));
        it = last;
      }
    }
  }

  void join_sides(const PolygonMesh& mesh, std::uint32_t lower, const Side& a, const Side& b) {
    if (a.rises == b.rises) return;  // Opposite orientations: their normals point to opposite sides.
    if (std::max(edge_crease(mesh, a.polygon, a.k), edge_crease(mesh, b.polygon, b.k)) >= split_from) return;
    const auto corner = [&](const Side& side, bool at_lower) {
      const std::uint32_t count = corner_count(mesh.polygons[side.polygon]);
      return side.polygon * 4 + (side.rises == at_lower ? side.k : (side.k + 1) % count);
    };
    if (!vertex_splits(mesh, lower)) join(corner(a, true), corner(b, true));
    if (!vertex_splits(mesh, a.higher)) join(corner(a, false), corner(b, false));
  }

  std::vector<std::uint32_t> group_;
};

inline glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& otherwise) {
  const float square = glm::dot(v, v);
  return square > 1e-38f && std::isfinite(square) ? v / std::sqrt(square) : otherwise;
}

/// Newell's normal: right for quads that are not flat, too.
glm::vec3 polygon_normal(const PolygonMesh& mesh, const PolygonCorners& corners) {
  const std::uint32_t count = corner_count(corners);
  const glm::vec3 origin = mesh.vertices_m[corners[0]];
  glm::vec3 sum(0.0f);
  for (std::uint32_t k = 0; k < count; ++k)
    sum += glm::cross(mesh.vertices_m[corners[k]] - origin, mesh.vertices_m[corners[(k + 1) % count]] - origin);
  return unit_or(sum, {0.0f, 0.0f, 1.0f});
}

/// Normals by group, weighted by the angle at each corner (Thürmer and Wüthrich 1998).
std::vector<glm::vec3> group_normals(const PolygonMesh& mesh, const SmoothGroups& groups) {
  std::vector<glm::vec3> sums(mesh.polygons.size() * 4, glm::vec3(0.0f));
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
    const PolygonCorners& corners = mesh.polygons[p];
    const std::uint32_t count = corner_count(corners);
    const glm::vec3 normal = polygon_normal(mesh, corners);
    std::array<glm::vec3, 4> ahead;
    for (std::uint32_t k = 0; k < count; ++k)
      ahead[k] = unit_or(mesh.vertices_m[corners[(k + 1) % count]] - mesh.vertices_m[corners[k]], normal);
    for (std::uint32_t k = 0; k < count; ++k) {
      const float cosine = -glm::dot(ahead[k], ahead[(k + count - 1) % count]);
      sums[groups.of(p, k)] += normal * std::acos(std::clamp(cosine, -1.0f, 1.0f));
    }
  }
  for (glm::vec3& sum : sums) sum = unit_or(sum, {0.0f, 0.0f, 1.0f});
  return sums;
}

/// The vertices of the triangles: one for every group, texture coordinate, colour and tangent.
class VertexPool {
 public:
  VertexPool(SurfaceMesh& surface, std::size_t corners) : surface_(surface), first_(corners, none) {}

  std::uint32_t index(std::uint32_t group, const SurfaceVertex& vertex) {
    for (std::uint32_t i = first_[group]; i != none; i = next_[i]) {
      const SurfaceVertex& known = surface_.vertices[i];
      const glm::vec2 difference =
          glm::max(glm::abs(known.uv - vertex.uv), glm::abs(known.second_uv - vertex.second_uv));
      if (difference.x < same_uv && difference.y < same_uv && known.color == vertex.color &&
          known.tangent == vertex.tangent)
        return i;
    }
    const auto added = static_cast<std::uint32_t>(surface_.vertices.size());
    surface_.vertices.push_back(vertex);
    next_.push_back(first_[group]);
    return first_[group] = added;
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  SurfaceMesh& surface_;
  std::vector<std::uint32_t> first_, next_;
};

}  // namespace

geometry::PolygonMesh polygons_of(const GeometryData& geometry) {
  PolygonMesh mesh;
  mesh.vertices_m = geometry.vertices_m;
  mesh.default_vertex_crease = geometry.vertex_crease.default_value;
  mesh.default_edge_crease = geometry.edge_crease.default_value;
  if (const auto* layer = layer_of_type(geometry, geometry.vertex_crease.layer, LayerType::vertex_integer))
    mesh.vertex_creases = layer->integers;
  const auto* edges = layer_of_type(geometry, geometry.edge_crease.layer, LayerType::corner_integer);
  const auto* map_u = layer_of_type(geometry, "map_u", LayerType::corner_real);
  const auto* map_v = layer_of_type(geometry, "map_v", LayerType::corner_real);
  const auto* second_u = layer_of_type(geometry, "second_map_u", LayerType::corner_real);
  const auto* second_v = layer_of_type(geometry, "second_map_v", LayerType::corner_real);
  const auto* colors = layer_of_type(geometry, "color", LayerType::corner_integer);
  const auto* tangents = layer_of_type(geometry, "tangent", LayerType::corner_integer);
  const auto* material = layer_of_type(geometry, "material", LayerType::face_integer);
  if (!material) material = layer_of_type(geometry, "material", LayerType::face_byte);
  for (std::size_t p = 0; p < geometry.polygons.size(); ++p) {
    if (!makes_sense(geometry.polygons[p], geometry.vertices_m.size())) continue;
    mesh.polygons.push_back(geometry.polygons[p]);
    if (edges) mesh.edge_creases.push_back(four(edges->integers, p));
    if (material) mesh.polygon_materials.push_back(material->integers[p]);
    if (colors) mesh.corner_colors.push_back(four(colors->integers, p));
    if (tangents) mesh.corner_tangents.push_back(four(tangents->integers, p));
    const auto uvs_of = [p](const GeometryLayer& u, const GeometryLayer& v) {
      std::array<glm::vec2, 4> uvs{};
      for (std::size_t k = 0; k < 4; ++k) uvs[k] = {u.reals[p * 4 + k], v.reals[p * 4 + k]};
      return uvs;
    };
    if (map_u && map_v) mesh.corner_uvs.push_back(uvs_of(*map_u, *map_v));
    if (second_u && second_v) mesh.second_corner_uvs.push_back(uvs_of(*second_u, *second_v));
  }
  return mesh;
}

SurfaceMesh triangulate(const PolygonMesh& mesh, const std::function<std::uint32_t(std::uint32_t)>& material_of) {
  SurfaceMesh surface;
  if (mesh.polygons.empty()) return surface;
  const SmoothGroups groups(mesh);
  const std::vector<glm::vec3> normals = group_normals(mesh, groups);

  // Polygons in the order of their materials, so that each material is one part.
  std::vector<std::uint32_t> order(mesh.polygons.size()), material(mesh.polygons.size());
  std::iota(order.begin(), order.end(), 0u);
  std::pair<std::uint32_t, std::uint32_t> last{0, material_of(0)};
  for (std::size_t p = 0; p < order.size(); ++p) {
    const std::uint32_t index = mesh.polygon_materials.empty() ? 0 : mesh.polygon_materials[p];
    if (index != last.first) last = {index, material_of(index)};
    material[p] = last.second;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return material[a] < material[b]; });

  VertexPool pool(surface, mesh.polygons.size() * 4);
  surface.bounds_min_m = surface.bounds_max_m = mesh.vertices_m[mesh.polygons[0][0]];
  for (const std::uint32_t p : order) {
    const PolygonCorners& corners = mesh.polygons[p];
    const std::uint32_t count = corner_count(corners);
    std::array<std::uint32_t, 4> at{};
    for (std::uint32_t k = 0; k < count; ++k) {
      const glm::vec3 position_m = mesh.vertices_m[corners[k]];
      const glm::vec2 uv = mesh.corner_uvs.empty() ? glm::vec2(0.0f) : mesh.corner_uvs[p][k];
      SurfaceVertex vertex{position_m, normals[groups.of(p, k)], uv};
      if (!mesh.corner_colors.empty()) vertex.color = mesh.corner_colors[p][k];
      if (!mesh.corner_tangents.empty()) vertex.tangent = mesh.corner_tangents[p][k];
      if (!mesh.second_corner_uvs.empty()) vertex.second_uv = mesh.second_corner_uvs[p][k];
      at[k] = pool.index(groups.of(p, k), vertex);
      surface.bounds_min_m = glm::min(surface.bounds_min_m, position_m);
      surface.bounds_max_m = glm::max(surface.bounds_max_m, position_m);
    }
    if (surface.parts.empty() || surface.parts.back().material != material[p])
      surface.parts.push_back({static_cast<std::uint32_t>(surface.indices.size()), 0, material[p]});
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      surface.indices.insert(surface.indices.end(), {at[a], at[b], at[c]});
      surface.parts.back().index_count += 3;
    };
    if (count == 3) {
      triangle(0, 1, 2);
      continue;
    }
    const auto& v = mesh.vertices_m;
    if (glm::distance(v[corners[1]], v[corners[3]]) < glm::distance(v[corners[0]], v[corners[2]]))
      triangle(0, 1, 3), triangle(1, 2, 3);
    else
      triangle(0, 1, 2), triangle(0, 2, 3);
  }
  return surface;
}

SurfaceMesh surface_of_geometry(const Node& node, const std::function<std::uint32_t(std::uint32_t)>& material_of) {
  const auto* data = std::get_if<GeometryData>(&node.data);
  if (!data) return {};
  PolygonMesh mesh = polygons_of(*data);
  std::uint32_t levels = 0;
  if (const TagValue* tag = find_tag(node, "draw", "subdivision_level"))
    if (const auto* value = std::get_if<std::uint32_t>(tag)) levels = std::min(*value, most_levels);
  while (levels > 0 && mesh.polygons.size() << (2 * levels) > most_refined_polygons) --levels;
  if (levels > 0)
    if (auto refined = geometry::subdivide(mesh, levels)) mesh = std::move(*refined);
  return triangulate(mesh, material_of);
}

}  // namespace septet::scene
