#include "engine/render/passes/stripes.hpp"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

namespace septet::render {
namespace {

struct Edge {
  std::uint32_t vertex = 0;
  glm::vec3 outwards{0.0f};
  float climb = 0.0f;
};

}  // namespace

void find_stripe_edges(std::span<scene::SurfaceVertex> vertices, std::span<const std::uint32_t> triangles) {
  std::vector<Edge> edges;
  for (std::size_t first = 0; first + 2 < triangles.size(); first += 3)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t ends[] = {triangles[first + corner], triangles[first + (corner + 1) % 3]};
      const scene::SurfaceVertex &a = vertices[ends[0]], &b = vertices[ends[1]],
                                 &third = vertices[triangles[first + (corner + 2) % 3]];
      if (a.uv.x == b.uv.x || a.uv.y != b.uv.y) continue;
      const glm::vec3 across = (b.position_m - a.position_m) * (b.uv.x > a.uv.x ? 1.0f : -1.0f);
      const glm::vec2 along = glm::vec2(-across.y, across.x) / glm::length(glm::vec2(across));
      const glm::vec3 on = third.position_m - (third.uv.x == a.uv.x ? a : b).position_m;
      const float climb = on.z / glm::dot(glm::vec2(on), along);
      for (const std::uint32_t end : ends)
        edges.push_back(
            {end, across * (vertices[end].uv.x > 0.5f ? 0.5f : -0.5f), std::isfinite(climb) ? climb : 0.0f});
    }
  for (const Edge& edge : edges) {
    vertices[edge.vertex].normal = edge.outwards;
    vertices[edge.vertex].uv.y = edge.climb;
  }
}

}  // namespace septet::render
