#include "engine/gltf/growing_part.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/packing.hpp>
#include <glm/vector_relational.hpp>

namespace septet::gltf {
namespace {

using CornerUvs = std::array<glm::vec2, 4>;
using CornerCodes = std::array<std::uint32_t, 4>;
constexpr std::uint32_t white = 0xFFFFFFFFu;

/// Where pictures repeat, far coordinates would lose their digits, so the whole triangle is moved by whole pictures.
CornerUvs near_origin(const std::array<glm::dvec2, 3>& uvs, const Look& look) {
  constexpr double far = 64.0;
  const bool is_far = glm::any(glm::greaterThan(glm::abs(uvs[0]), glm::dvec2(far)));
  const glm::dvec2 moved = is_far ? glm::floor(uvs[0]) : glm::dvec2(0.0);
  const glm::dvec2 whole(look.ends_u ? 0.0 : moved.x, look.ends_v ? 0.0 : moved.y);
  return {uvs[0] - whole, uvs[1] - whole, uvs[2] - whole, glm::vec2(0.0f)};
}

CornerUvs uvs_of(const Rows& uvs, const std::array<std::uint32_t, 3>& triangle, const PictureMapping& mapping,
                 const Look& look) {
  if (uvs.count == 0) return {};
  std::array<glm::dvec2, 3> mapped{};
  for (std::size_t k = 0; k < 3; ++k)
    mapped[k] = mapping({uvs.numbers[std::size_t{triangle[k]} * 2], uvs.numbers[std::size_t{triangle[k]} * 2 + 1]});
  return near_origin(mapped, look);
}

CornerCodes colors_of(const Rows& colors, const std::array<std::uint32_t, 3>& triangle) {
  CornerCodes codes{white, white, white, white};
  for (std::size_t k = 0; k < 3; ++k) {
    const float* c = &colors.numbers[std::size_t{triangle[k]} * colors.width];
    codes[k] = glm::packUnorm4x8(glm::vec4(c[0], c[1], c[2], 1.0f));
  }
  return codes;
}

/// glTF's w times (normal × tangent) is the way of green, as here; a mirroring node turns it round.
CornerCodes tangents_of(const Rows& tangents, const std::array<std::uint32_t, 3>& triangle, const glm::mat3& turn,
                        bool mirrors) {
  CornerCodes codes{};
  for (std::size_t k = 0; k < 3; ++k) {
    const float* t = &tangents.numbers[std::size_t{triangle[k]} * 4];
    const glm::vec3 along = our_axes(turn * glm::vec3(t[0], t[1], t[2]));
    const float length = glm::length(along);
    const bool is_right_handed = (t[3] < 0.0f) == mirrors;
    if (length > 1e-6f) codes[k] = glm::packSnorm4x8(glm::vec4(along / length, is_right_handed ? 1.0f : -1.0f));
  }
  return codes;
}

}  // namespace

bool is_near(const glm::vec3& p) {
  return std::abs(p.x) <= furthest_m && std::abs(p.y) <= furthest_m && std::abs(p.z) <= furthest_m;
}

bool add_triangles(const Primitive& primitive, const Look& look, std::uint32_t look_index, bool takes_colors,
                   const glm::mat4& model_from_node, GrowingPart& growing) {
  const Rows& positions = primitive.positions;
  const Rows& normals = primitive.normals;
  const glm::mat3 turn(model_from_node);
  const bool mirrors = glm::determinant(turn) < 0.0f;
  geometry::PolygonMesh& mesh = growing.part.mesh;
  std::vector<std::uint32_t> placed(positions.count, geometry::no_vertex);
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> triangle = primitive.triangles[t];
    if (mirrors) std::swap(triangle[0], triangle[2]);
    geometry::PolygonCorners corners{0, 0, 0, geometry::no_vertex};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangle[k];
      if (placed[vertex] == geometry::no_vertex || normals.count == 0) {
        const float* p = &positions.numbers[std::size_t{vertex} * 3];
        const glm::vec3 at = our_axes(glm::vec3(model_from_node * glm::vec4(p[0], p[1], p[2], 1.0f)));
        if (!is_near(at)) return false;
        // Without normals every triangle is flat (3.7.2.1): its number stands for the normal, and joins nothing.
        glm::vec3 normal(static_cast<float>(t), static_cast<float>(mesh.polygons.size()), -2.0f);
        if (normals.count > 0) {
          const float* n = &normals.numbers[std::size_t{vertex} * 3];
          normal = {n[0], n[1], n[2]};
        }
        const glm::vec3 here = at - growing.part.origin_m;
        const JoinedCorner corner{{here.x, here.y, here.z, normal.x, normal.y, normal.z}};
        const auto [known, is_new] =
            growing.known.try_emplace(corner, static_cast<std::uint32_t>(mesh.vertices_m.size()));
        if (is_new) mesh.vertices_m.push_back(here);
        placed[vertex] = known->second;
      }
      corners[k] = placed[vertex];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    mesh.polygons.push_back(corners);
    mesh.polygon_materials.push_back(look_index);
    mesh.corner_uvs.push_back(uvs_of(primitive.uvs, triangle, look.mapping, look));
    mesh.second_corner_uvs.push_back(uvs_of(primitive.second_uvs, triangle, look.second_mapping, look));
    mesh.corner_colors.push_back(takes_colors ? colors_of(primitive.colors, triangle)
                                              : CornerCodes{white, white, white, white});
    mesh.corner_tangents.push_back(
        primitive.tangents.count > 0 ? tangents_of(primitive.tangents, triangle, turn, mirrors) : CornerCodes{});
    growing.has_uvs |= primitive.uvs.count > 0;
    growing.has_second_uvs |= primitive.second_uvs.count > 0;
    growing.has_colors |= takes_colors;
    growing.has_tangents |= primitive.tangents.count > 0;
  }
  return true;
}

Part finished(GrowingPart growing) {
  geometry::PolygonMesh& mesh = growing.part.mesh;
  if (!growing.has_uvs) mesh.corner_uvs.clear();
  if (!growing.has_second_uvs) mesh.second_corner_uvs.clear();
  if (!growing.has_colors) mesh.corner_colors.clear();
  if (!growing.has_tangents) mesh.corner_tangents.clear();
  return std::move(growing.part);
}

}  // namespace septet::gltf
