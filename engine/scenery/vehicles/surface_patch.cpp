#include "engine/scenery/vehicles/surface_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include <glm/geometric.hpp>

namespace septet::scenery {
namespace {

using geometry::PolygonMesh;

/// Axes of the picture and of depth, and the sign of depth towards the viewer.
struct FaceAxes {
  int u, v, depth;
  float towards_viewer;
};

FaceAxes axes_of(Face face) {
  switch (face) {
    case Face::front:
      return {1, 2, 0, 1.0f};
    case Face::rear:
      return {1, 2, 0, -1.0f};
    case Face::left:
      return {0, 2, 1, 1.0f};
    case Face::right:
      return {0, 2, 1, -1.0f};
    case Face::top:
      return {0, 1, 2, 1.0f};
  }
  return {1, 2, 0, 1.0f};
}

float cross2(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

glm::vec2 flat(const FaceAxes& axes, const glm::vec3& p) { return {p[axes.u], p[axes.v]}; }

struct SurfaceVertex {
  glm::vec3 position_m, normal;
};

/// Normalised sums of the area vectors around each vertex.
std::vector<glm::vec3> vertex_normals(const PolygonMesh& mesh) {
  std::vector<glm::vec3> normals(mesh.vertices_m.size(), glm::vec3(0.0f));
  for (const auto& corners : mesh.polygons) {
    const std::uint32_t last = corners[geometry::corner_count(corners) - 1];
    const glm::vec3 normal = glm::cross(mesh.vertices_m[corners[2]] - mesh.vertices_m[corners[0]],
                                        mesh.vertices_m[last] - mesh.vertices_m[corners[1]]);
    for (std::uint32_t k = 0; k < geometry::corner_count(corners); ++k) normals[corners[k]] += normal;
  }
  for (glm::vec3& normal : normals) normal = glm::length(normal) > 0.0f ? glm::normalize(normal) : glm::vec3(0, 0, 1);
  return normals;
}

/// Outline with each corner replaced by two chords of an arc.
std::vector<glm::vec2> rounded(const PatchOutline& outline, float cut) {
  std::vector<glm::vec2> points;
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::vec2 corner = outline.corners[k], before = outline.corners[(k + 3) % 4],
                    after = outline.corners[(k + 1) % 4];
    if (cut <= 0.0f) {
      points.push_back(corner);
      continue;
    }
    // Equal lengths on both sides, so that the rounding is circular.
    const float reach = cut * std::min(glm::distance(corner, before), glm::distance(corner, after)) * 2.0f;
    const glm::vec2 from = corner + glm::normalize(before - corner) * reach,
                    to = corner + glm::normalize(after - corner) * reach;
    points.insert(points.end(), {from, (from + to + corner * 2.0f) * 0.25f, to});
  }
  return points;
}

float twice_area(const std::vector<glm::vec2>& polygon) {
  float area = 0.0f;
  for (std::size_t k = 0; k < polygon.size(); ++k) area += cross2(polygon[k], polygon[(k + 1) % polygon.size()]);
  return area;
}

/// Part of `piece` to the left of a line (Sutherland and Hodgman 1974).
std::vector<SurfaceVertex> left_of(const std::vector<SurfaceVertex>& piece, glm::vec2 from, glm::vec2 to,
                                   const FaceAxes& axes) {
  const auto side = [&](const SurfaceVertex& v) { return cross2(to - from, flat(axes, v.position_m) - from); };
  std::vector<SurfaceVertex> kept;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const SurfaceVertex &a = piece[k], &b = piece[(k + 1) % piece.size()];
    const float side_a = side(a), side_b = side(b);
    if (side_a >= 0.0f) kept.push_back(a);
    if ((side_a > 0.0f && side_b < 0.0f) || (side_a < 0.0f && side_b > 0.0f)) {
      const float t = side_a / (side_a - side_b);
      kept.push_back({glm::mix(a.position_m, b.position_m, t), glm::mix(a.normal, b.normal, t)});
    }
  }
  return kept;
}

/// Part of `piece` to the left of every edge of the border.
std::vector<SurfaceVertex> clipped(std::vector<SurfaceVertex> piece, const std::vector<glm::vec2>& border,
                                   const FaceAxes& axes) {
  for (std::size_t e = 0; e < border.size() && piece.size() >= 3; ++e)
    piece = left_of(piece, border[e], border[(e + 1) % border.size()], axes);
  return piece;
}

/// Border counter-clockwise in the picture's own axes.
std::vector<glm::vec2> border_of(const PatchOutline& outline, float corner_cut) {
  std::vector<glm::vec2> border = rounded(outline, corner_cut);
  if (twice_area(border) < 0.0f) std::reverse(border.begin(), border.end());
  return border;
}

std::vector<SurfaceVertex> piece_of(const PolygonMesh& body, const geometry::PolygonCorners& corners,
                                    const std::vector<glm::vec3>& normals) {
  std::vector<SurfaceVertex> piece;
  for (std::uint32_t k = 0; k < geometry::corner_count(corners); ++k)
    piece.push_back({body.vertices_m[corners[k]], normals[corners[k]]});
  return piece;
}

bool faces(const std::vector<SurfaceVertex>& piece, const FaceAxes& axes, float min_facing) {
  const glm::vec3 facing =
      glm::cross(piece[2].position_m - piece[0].position_m, piece.back().position_m - piece[1].position_m);
  return facing[axes.depth] * axes.towards_viewer > min_facing * glm::length(facing);
}

/// True if another part of the body hides it from the viewer.
bool is_hidden(const PolygonMesh& body, Face face, const std::vector<SurfaceVertex>& piece) {
  const FaceAxes axes = axes_of(face);
  glm::vec3 middle(0.0f);
  for (const SurfaceVertex& v : piece) middle += v.position_m / static_cast<float>(piece.size());
  const auto front = surface_point(body, face, flat(axes, middle));
  return front && ((*front)[axes.depth] - middle[axes.depth]) * axes.towards_viewer > 0.15f;
}

}  // namespace

PatchOutline rectangle(Face face, glm::vec2 low, glm::vec2 high) {
  // Seen from the front, the car's left (greater y) is on the right; seen from its left side the front (greater x) is
  // on the left.
  if (face == Face::rear || face == Face::left) std::swap(low.x, high.x);
  if (face == Face::top) return {{{{low.x, high.y}, {low.x, low.y}, {high.x, low.y}, {high.x, high.y}}}};
  return {{{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}}};
}

std::optional<glm::vec3> surface_point(const PolygonMesh& body, Face face, glm::vec2 point) {
  const FaceAxes axes = axes_of(face);
  std::optional<glm::vec3> best;
  for (const auto& corners : body.polygons)
    for (std::uint32_t k = 1; k + 1 < geometry::corner_count(corners); ++k) {
      const glm::vec3& p = body.vertices_m[corners[0]];
      const glm::vec3& q = body.vertices_m[corners[k]];
      const glm::vec3& r = body.vertices_m[corners[k + 1]];
      const glm::vec2 a = flat(axes, p), ab = flat(axes, q) - a, ac = flat(axes, r) - a, offset = point - a;
      const float area = cross2(ab, ac);
      if (std::abs(area) < 1e-9f) continue;
      const float wb = cross2(offset, ac) / area, wc = cross2(ab, offset) / area;
      if (wb < -1e-4f || wc < -1e-4f || wb + wc > 1.0001f) continue;
      const glm::vec3 hit = p + (q - p) * wb + (r - p) * wc;
      if (!best || (hit[axes.depth] - (*best)[axes.depth]) * axes.towards_viewer > 0.0f) best = hit;
    }
  return best;
}

void draw_patch(geometry::MeshBuilder& builder, const PolygonMesh& body, Face face, const PatchOutline& outline,
                const PatchOptions& options) {
  const FaceAxes axes = axes_of(face);
  const std::vector<glm::vec2> border = border_of(outline, options.corner_cut);
  const std::vector<glm::vec3> normals = vertex_normals(body);
  std::map<std::array<std::int64_t, 3>, std::uint32_t> known;
  const auto vertex = [&](const SurfaceVertex& v) {
    const glm::vec3 p = v.position_m + glm::normalize(v.normal) * options.lift_m;
    const std::array<std::int64_t, 3> key{std::llround(p.x * 4096.0), std::llround(p.y * 4096.0),
                                          std::llround(p.z * 4096.0)};
    const auto [place, fresh] = known.try_emplace(key, 0u);
    if (fresh) place->second = builder.vertex(p);
    return place->second;
  };
  const glm::vec2 across = outline.corners[1] - outline.corners[0], up = outline.corners[3] - outline.corners[0];
  const auto uv = [&](const SurfaceVertex& v) {
    const glm::vec2 offset = flat(axes, v.position_m) - outline.corners[0];
    const float area = cross2(across, up);
    return glm::vec2(cross2(offset, up) / area, 1.0f - cross2(across, offset) / area);
  };
  for (const auto& corners : body.polygons) {
    std::vector<SurfaceVertex> piece = piece_of(body, corners, normals);
    if (!faces(piece, axes, options.min_facing)) continue;
    piece = clipped(std::move(piece), border, axes);
    if (piece.size() < 3) continue;
    // Polygons hidden from the viewer by another part of the body keep clear of the patch.
    if (is_hidden(body, face, piece)) continue;
    for (std::size_t k = 1; k + 1 < piece.size(); k += 2) {
      const std::uint32_t a = vertex(piece[0]), b = vertex(piece[k]), c = vertex(piece[k + 1]);
      const bool has_fourth = k + 2 < piece.size();
      const std::uint32_t d = has_fourth ? vertex(piece[k + 2]) : a;
      if (has_fourth && a != b && b != c && c != d && d != a)
        builder.quad(a, b, c, d, {{uv(piece[0]), uv(piece[k]), uv(piece[k + 1]), uv(piece[k + 2])}});
      else {
        if (a != b && b != c && c != a) builder.triangle(a, b, c, {{uv(piece[0]), uv(piece[k]), uv(piece[k + 1]), {}}});
        if (has_fourth && a != c && c != d && d != a)
          builder.triangle(a, c, d, {{uv(piece[0]), uv(piece[k + 1]), uv(piece[k + 2]), {}}});
      }
    }
  }
}

void add_lining(geometry::MeshBuilder& builder, const geometry::PolygonMesh& open, float low, float rear, float front) {
  const std::vector<glm::vec3> normals = vertex_normals(open);
  std::vector<std::uint32_t> inner(open.vertices_m.size(), geometry::no_vertex);
  const auto behind = [&](std::uint32_t v) {
    if (inner[v] == geometry::no_vertex) inner[v] = builder.vertex(open.vertices_m[v] - 0.02f * normals[v]);
    return inner[v];
  };
  for (const auto& c : open.polygons) {
    float highest = -1e9f, x = 0.0f;
    for (std::uint32_t k = 0; k < geometry::corner_count(c); ++k) {
      highest = std::max(highest, open.vertices_m[c[k]].z);
      x += open.vertices_m[c[k]].x / static_cast<float>(geometry::corner_count(c));
    }
    if (highest < low || x < rear || x > front) continue;
    if (geometry::is_triangle(c))
      builder.triangle(behind(c[2]), behind(c[1]), behind(c[0]));
    else
      builder.quad(behind(c[3]), behind(c[2]), behind(c[1]), behind(c[0]));
  }
}

PatchOutline mirrored(const PatchOutline& outline) {
  const auto& c = outline.corners;
  return {{c[1], c[0], c[3], c[2]}};
}

geometry::PolygonMesh cut_out(const geometry::PolygonMesh& body, Face face, const PatchOutline& outline,
                              const PatchOptions& options) {
  const FaceAxes axes = axes_of(face);
  const std::vector<glm::vec2> border = border_of(outline, options.corner_cut);
  const std::vector<glm::vec3> normals = vertex_normals(body);
  PolygonMesh left;
  left.vertices_m = body.vertices_m;
  left.vertex_creases = body.vertex_creases;
  left.default_vertex_crease = body.default_vertex_crease, left.default_edge_crease = body.default_edge_crease;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> known;
  const auto key_of = [](const glm::vec3& p) {
    return std::array<std::int64_t, 3>{std::llround(p.x * 4096.0), std::llround(p.y * 4096.0),
                                       std::llround(p.z * 4096.0)};
  };
  for (std::uint32_t v = 0; v < body.vertices_m.size(); ++v) known.try_emplace(key_of(body.vertices_m[v]), v);
  const auto vertex = [&](const SurfaceVertex& v) {
    const auto [place, fresh] =
        known.try_emplace(key_of(v.position_m), static_cast<std::uint32_t>(left.vertices_m.size()));
    if (fresh) {
      left.vertices_m.push_back(v.position_m);
      if (!left.vertex_creases.empty()) left.vertex_creases.push_back(left.default_vertex_crease);
    }
    return place->second;
  };
  const auto add = [&](const geometry::PolygonCorners& corners, std::size_t from, bool whole) {
    left.polygons.push_back(corners);
    if (!body.polygon_materials.empty()) left.polygon_materials.push_back(body.polygon_materials[from]);
    if (!body.edge_creases.empty())
      left.edge_creases.push_back(
          whole ? body.edge_creases[from]
                : std::array<std::uint32_t, 4>{body.default_edge_crease, body.default_edge_crease,
                                               body.default_edge_crease, body.default_edge_crease});
  };
  for (std::size_t p = 0; p < body.polygons.size(); ++p) {
    std::vector<SurfaceVertex> piece = piece_of(body, body.polygons[p], normals);
    const std::vector<SurfaceVertex> within =
        faces(piece, axes, options.min_facing) ? clipped(piece, border, axes) : std::vector<SurfaceVertex>();
    if (within.size() < 3 || is_hidden(body, face, within)) {
      add(body.polygons[p], p, true);
      continue;
    }
    // Part to the right of one edge and to the left of those before it.
    for (std::size_t e = 0; e < border.size() && piece.size() >= 3; ++e) {
      const glm::vec2 from = border[e], to = border[(e + 1) % border.size()];
      const std::vector<SurfaceVertex> outside = left_of(piece, to, from, axes);
      for (std::size_t k = 1; k + 1 < outside.size(); ++k) {
        const std::uint32_t a = vertex(outside[0]), b = vertex(outside[k]), c = vertex(outside[k + 1]);
        if (a != b && b != c && c != a) add({a, b, c, geometry::no_vertex}, p, false);
      }
      piece = left_of(piece, from, to, axes);
    }
  }
  return left;
}

void draw_patch_on_both_sides(geometry::MeshBuilder& builder, const geometry::PolygonMesh& body,
                              const PatchOutline& outline, const PatchOptions& options) {
  draw_patch(builder, body, Face::left, outline, options);
  draw_patch(builder, body, Face::right, mirrored(outline), options);
}

}  // namespace septet::scenery
