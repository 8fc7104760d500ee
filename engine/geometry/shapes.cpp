#include "engine/geometry/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/geometry/mesh_builder.hpp"

namespace septet::geometry {

PolygonMesh box(const glm::vec3& min_m, const glm::vec3& max_m, float bevel_m) {
  MeshBuilder builder;
  const std::array<glm::vec3, 2> ends{min_m, max_m};
  // Corner c has its upper end on axis a where bit a of c is set. A bevelled box has three vertices
  // at each corner, one on each of the faces that meet there.
  const auto corner = [&](int c, int on_axis) {
    glm::vec3 p(ends[c & 1].x, ends[(c >> 1) & 1].y, ends[(c >> 2) & 1].z);
    for (int axis = 0; axis < 3; ++axis)
      if (axis != on_axis) p[axis] += (c >> axis & 1) ? -bevel_m : bevel_m;
    return p;
  };
  std::array<std::array<std::uint32_t, 3>, 8> vertices{};
  for (int c = 0; c < 8; ++c)
    for (int axis = 0; axis < 3; ++axis)
      vertices[c][axis] = bevel_m > 0.0f || axis == 0 ? builder.vertex(corner(c, axis)) : vertices[c][0];
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, w = 1 << axis;
    builder.quad(vertices[w][axis], vertices[w + u][axis], vertices[w + u + v][axis], vertices[w + v][axis]);
    builder.quad(vertices[0][axis], vertices[v][axis], vertices[u + v][axis], vertices[u][axis]);
    if (bevel_m <= 0.0f) continue;
    // The four edges along this axis, between the faces across the two other axes.
    const int au = (axis + 1) % 3, av = (axis + 2) % 3;
    for (int side = 0; side < 4; ++side) {
      const int low = (side & 1 ? u : 0) + (side & 2 ? v : 0), high = low + w;
      const bool flip = side == 1 || side == 2;
      const int first = flip ? au : av, second = flip ? av : au;
      builder.quad(vertices[low][second], vertices[low][first], vertices[high][first], vertices[high][second]);
    }
  }
  if (bevel_m > 0.0f)
    for (int c = 0; c < 8; ++c) {
      const bool odd = ((c & 1) + (c >> 1 & 1) + (c >> 2 & 1)) % 2 == 1;
      builder.triangle(vertices[c][0], vertices[c][odd ? 1 : 2], vertices[c][odd ? 2 : 1]);
    }
  PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = crease_sharp;
  project_box_uvs(mesh, 1.0f);
  return mesh;
}

PolygonMesh lathe(std::span<const LathePoint> profile, std::uint32_t sides) {
  MeshBuilder builder;
  std::vector<std::vector<std::uint32_t>> rings;
  for (const LathePoint& point : profile) {
    auto& ring = rings.emplace_back();
    if (point.radius_m <= 0.0f) {
      ring.push_back(builder.vertex({0, 0, point.height_m}));
      continue;
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
      const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
      ring.push_back(
          builder.vertex({point.radius_m * std::cos(angle), point.radius_m * std::sin(angle), point.height_m}));
    }
  }
  for (std::size_t row = 0; row + 1 < rings.size(); ++row) {
    const auto& low = rings[row];
    const auto& high = rings[row + 1];
    const float v0 = -profile[row].height_m, v1 = -profile[row + 1].height_m;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t next = (i + 1) % sides;
      const float u0 = static_cast<float>(i) / static_cast<float>(sides),
                  u1 = static_cast<float>(i + 1) / static_cast<float>(sides);
      if (low.size() > 1 && high.size() > 1)
        builder.quad(low[i], low[next], high[next], high[i], {{{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}});
      else if (low.size() > 1)
        builder.triangle(low[i], low[next], high[0], {{{u0, v0}, {u1, v0}, {(u0 + u1) / 2, v1}, {}}});
      else if (high.size() > 1)
        builder.triangle(low[0], high[next], high[i], {{{(u0 + u1) / 2, v0}, {u1, v1}, {u0, v1}, {}}});
    }
  }
  return builder.take();
}

PolygonMesh cylinder(float radius_m, float low_m, float high_m, std::uint32_t sides) {
  const std::array<LathePoint, 4> profile{{{0, low_m}, {radius_m, low_m}, {radius_m, high_m}, {0, high_m}}};
  PolygonMesh mesh = lathe(profile, sides);
  crease_by_angle(mesh, 1.2f);
  return mesh;
}

PolygonMesh extrude(std::span<const glm::vec2> profile, std::span<const PathFrame> path, bool closed, bool cap) {
  SEPTET_CHECK(profile.size() >= 2 && path.size() >= 2, "{} profile points, {} frames", profile.size(), path.size());
  MeshBuilder builder;
  const auto count = static_cast<std::uint32_t>(profile.size());
  std::vector<float> lengths{0.0f};
  for (std::uint32_t j = 0; j < count; ++j)
    lengths.push_back(lengths.back() + glm::distance(profile[j], profile[(j + 1) % count]));
  for (const PathFrame& frame : path)
    for (const glm::vec2& point : profile)
      builder.vertex(frame.position_m + frame.right * point.x + frame.up * point.y);
  const std::uint32_t bands = closed ? count : count - 1;
  for (std::uint32_t i = 0; i + 1 < path.size(); ++i)
    for (std::uint32_t j = 0; j < bands; ++j) {
      const std::uint32_t next = (j + 1) % count;
      const float v0 = path[i].length_m, v1 = path[i + 1].length_m;
      builder.quad(i * count + j, (i + 1) * count + j, (i + 1) * count + next, i * count + next,
                   {{{lengths[j], v0}, {lengths[j], v1}, {lengths[j + 1], v1}, {lengths[j + 1], v0}}});
    }
  if (closed && cap)
    for (const bool end : {false, true}) {
      const auto first = end ? static_cast<std::uint32_t>(path.size() - 1) * count : 0u;
      for (std::uint32_t j = 1; j + 1 < count; ++j) {
        const std::uint32_t a = first, b = first + j + (end ? 1 : 0), c = first + j + (end ? 0 : 1);
        builder.triangle(a, b, c);
      }
    }
  return builder.take();
}

PolygonMesh icosphere(std::uint32_t splits) {
  const float t = (1.0f + std::sqrt(5.0f)) / 2.0f;
  std::vector<glm::vec3> points{{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                                {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  std::vector<std::array<std::uint32_t, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                  {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                  {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                  {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (glm::vec3& p : points) p = glm::normalize(p);
  for (std::uint32_t split = 0; split < splits; ++split) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (fresh) points.push_back(glm::normalize(points[a] + points[b]));
      return place->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  MeshBuilder builder;
  for (const glm::vec3& p : points) builder.vertex(p);
  const auto uv = [&](std::uint32_t i) {
    const float angle = std::atan2(points[i].y, points[i].x);
    return glm::vec2(angle / (2.0f * std::numbers::pi_v<float>)+0.5f, 0.5f - points[i].z / 2.0f);
  };
  for (const auto& [a, b, c] : faces) {
    CornerUvs uvs{{uv(a), uv(b), uv(c), {}}};
    // Keep a triangle over the date line on one side of it.
    for (int k = 1; k < 3; ++k) uvs[k].x -= std::round(uvs[k].x - uvs[0].x);
    builder.triangle(a, b, c, uvs);
  }
  return builder.take();
}

}  // namespace septet::geometry
