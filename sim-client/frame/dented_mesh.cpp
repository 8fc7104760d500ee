#include "sim-client/frame/dented_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim-client/frame/surface_vertices.hpp"

namespace septet::frame {
namespace {

using scene::SurfaceVertex;

constexpr std::size_t most_vertices = 120'000;

/// Transforms from the mesh's frame into the vehicle's, and back.
struct Frame {
  const RigidTransform& vehicle_from_object;
  RigidTransform object_from_vehicle;
  Vec3 scale;

  Vec3 in_vehicle(const glm::vec3& p) const { return vehicle_from_object * (scale * Vec3(p)); }
  glm::vec3 in_object(const Vec3& p) const { return glm::vec3((object_from_vehicle * p) / scale); }
};

/// True if an edge is to be divided: a function of its ends alone.
bool is_divided(const Frame& frame, std::span<const debris::Dent> dents, const SurfaceVertex& a,
                const SurfaceVertex& b) {
  const Vec3 from = frame.in_vehicle(a.position_m), to = frame.in_vehicle(b.position_m);
  const double length_m = glm::length(to - from);
  if (!(length_m > longest_bent_edge_m)) return false;
  // Long edges are sampled in several places: a dent in the middle of a lorry's side reaches neither end.
  const int places = static_cast<int>(std::clamp(length_m / longest_bent_edge_m, 2.0, 64.0));
  for (int k = 0; k <= places; ++k)
    if (debris::reaches(dents, glm::mix(from, to, static_cast<double>(k) / places))) return true;
  return false;
}

/// True if a dent may lie within a triangle: a large one is divided even if a dent reaches its middle alone.
bool holds_a_dent(const Frame& frame, std::span<const debris::Dent> dents,
                  const std::array<SurfaceVertex, 3>& corners) {
  const Vec3 a = frame.in_vehicle(corners[0].position_m), b = frame.in_vehicle(corners[1].position_m),
             c = frame.in_vehicle(corners[2].position_m);
  const Vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  return std::ranges::any_of(dents, [&](const debris::Dent& dent) {
    const double reach = dent.half_width_m + 2.0;
    return dent.place_m.x > low.x - reach && dent.place_m.x < high.x + reach && dent.place_m.y > low.y - reach &&
           dent.place_m.y < high.y + reach;
  });
}

class Division {
 public:
  Division(const Frame& frame, std::span<const debris::Dent> dents, scene::SurfaceMesh& mesh)
      : frame_(frame), dents_(dents), mesh_(mesh) {}

  /// Divides every edge that needs it once. Returns false if no edge did.
  bool once() {
    middles_.clear();
    std::vector<std::uint32_t> indices;
    std::vector<scene::MeshPart> parts;
    std::vector<std::uint8_t> settled;
    settled_.resize(mesh_.indices.size() / 3, 0);
    bool any = false;
    for (const scene::MeshPart& part : mesh_.parts) {
      const auto first = static_cast<std::uint32_t>(indices.size());
      for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) {
        const std::array<std::uint32_t, 3> corners{mesh_.indices[part.first_index + i],
                                                   mesh_.indices[part.first_index + i + 1],
                                                   mesh_.indices[part.first_index + i + 2]};
        const bool divided = !settled_[(part.first_index + i) / 3] && divide(corners, indices);
        if (!divided) indices.insert(indices.end(), corners.begin(), corners.end());
        settled.resize(indices.size() / 3, divided ? 0 : 1);
        any |= divided;
      }
      parts.push_back({first, static_cast<std::uint32_t>(indices.size()) - first, part.material});
    }
    mesh_.indices = std::move(indices);
    mesh_.parts = std::move(parts);
    settled_ = std::move(settled);
    return any && mesh_.vertices.size() < most_vertices;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [found, added] = middles_.try_emplace(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), none);
    if (added && is_divided(frame_, dents_, mesh_.vertices[a], mesh_.vertices[b])) {
      found->second = static_cast<std::uint32_t>(mesh_.vertices.size());
      const SurfaceVertex made = between(mesh_.vertices[std::min(a, b)], mesh_.vertices[std::max(a, b)]);
      mesh_.vertices.push_back(made);
    }
    return found->second;
  }

  /// Appends the parts of a triangle; false: it stays whole, and nothing is appended.
  bool divide(const std::array<std::uint32_t, 3>& t, std::vector<std::uint32_t>& into) {
    const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { into.insert(into.end(), {a, b, c}); };
    if (!holds_a_dent(frame_, dents_, {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]})) return false;
    const std::array<std::uint32_t, 3> m{middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    const auto count = std::ranges::count_if(m, [](std::uint32_t at) { return at != none; });
    if (count == 0) return false;
    if (count == 3) {
      put(t[0], m[0], m[2]);
      put(m[0], t[1], m[1]);
      put(m[2], m[1], t[2]);
      put(m[0], m[1], m[2]);
      return true;
    }
    // Corners rotated so that the first edge is divided, and of two divided edges the second one, too.
    std::size_t k = 0;
    while (m[k] == none || (count == 2 && m[(k + 1) % 3] == none)) ++k;
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
    put(a, ab, c);
    if (count == 1) {
      put(ab, b, c);
    } else {
      put(ab, b, bc);
      put(ab, bc, c);
    }
    return true;
  }

  const Frame& frame_;
  std::span<const debris::Dent> dents_;
  scene::SurfaceMesh& mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< By the edge's ends, the lesser first.
  /// By triangle: 1 where no edge is divided, now or later, which the edges' ends alone decide.
  std::vector<std::uint8_t> settled_;
};

}  // namespace

std::optional<scene::SurfaceMesh> dented_mesh(const scene::SurfaceMesh& mesh, const RigidTransform& vehicle_from_object,
                                              const glm::vec3& scale, std::span<const debris::Dent> dents) {
  if (dents.empty() || mesh.indices.empty() || !makes_sense(mesh)) return std::nullopt;
  if (!(std::min({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)}) > 1e-6f)) return std::nullopt;
  const Frame frame{vehicle_from_object, inverse(vehicle_from_object), Vec3(scale)};
  scene::SurfaceMesh bent = mesh;
  Division division(frame, dents, bent);
  constexpr int most_rounds = 9;
  for (int round = 0; round < most_rounds && division.once(); ++round) {
  }
  bool any = false;
  for (SurfaceVertex& vertex : bent.vertices) {
    const Vec3 place = frame.in_vehicle(vertex.position_m);
    if (!debris::reaches(dents, place)) continue;
    any = true;
    const Vec3 normal = vehicle_from_object.orientation * glm::normalize(Vec3(vertex.normal) / frame.scale);
    const Vec3 turned = frame.object_from_vehicle.orientation * debris::dented_normal(dents, place, normal);
    vertex.position_m = frame.in_object(debris::dented(dents, place));
    vertex.normal = glm::vec3(glm::normalize(turned * frame.scale));
  }
  if (!any) return std::nullopt;
  bent.bounds_min_m = bent.bounds_max_m = bent.vertices.front().position_m;
  for (const SurfaceVertex& vertex : bent.vertices) {
    bent.bounds_min_m = glm::min(bent.bounds_min_m, vertex.position_m);
    bent.bounds_max_m = glm::max(bent.bounds_max_m, vertex.position_m);
  }
  return bent;
}

}  // namespace septet::frame
