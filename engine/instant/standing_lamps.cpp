#include "engine/instant/standing_lamps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/instant/mean_emission.hpp"

namespace septet::instant {
namespace {

/// Adds a triangle to the lamp before if they share a place, since two triangles make a lens.
void add_triangle(std::vector<StandingLamp>& lamps, const Vec3& middle_m, float height_m, const glm::vec3& intensity,
                  bool roofed) {
  constexpr double together_m = 1.5;
  if (!lamps.empty() && lamps.back().roofed == roofed && glm::length(lamps.back().position_m - middle_m) < together_m) {
    StandingLamp& lamp = lamps.back();
    const float before = lamp.intensity.g, now = intensity.g;
    lamp.position_m = glm::mix(lamp.position_m, middle_m, double(now / std::max(before + now, 1e-9f)));
    lamp.intensity += intensity;
    return;
  }
  lamps.push_back({middle_m, std::clamp(height_m, 2.5f, 14.0f), intensity, roofed});
}

/// Upright triangle under a roof, from above.
struct WallPiece {
  Vec2 from_m, to_m, normal;
};

void add_wall(std::vector<WallPiece>& walls, const std::array<Vec3, 3>& at, const Vec2& normal) {
  constexpr double shortest_m = 2.0;
  std::size_t longest = 0;
  const auto side = [&](std::size_t k) { return Vec2(at[(k + 1) % 3]) - Vec2(at[k]); };
  for (std::size_t k = 1; k < 3; ++k)
    if (glm::length(side(k)) > glm::length(side(longest))) longest = k;
  if (glm::length(side(longest)) < shortest_m) return;
  walls.push_back({Vec2(at[longest]), Vec2(at[(longest + 1) % 3]), glm::normalize(normal)});
}

/// Finds the nearest wall beside each roofed lamp, and the nearest on the other side.
void find_walls(std::vector<StandingLamp>& lamps, const std::vector<WallPiece>& pieces) {
  constexpr double furthest_m = 30.0, cell_m = 64.0;
  using Cell = std::pair<double, double>;
  const auto cell_of = [](const Vec2& at) { return Cell{std::floor(at.x / cell_m), std::floor(at.y / cell_m)}; };
  std::map<Cell, std::vector<const WallPiece*>> by_cell;
  for (const WallPiece& piece : pieces) by_cell[cell_of(0.5 * (piece.from_m + piece.to_m))].push_back(&piece);
  const auto look = [](StandingLamp& lamp, const std::vector<const WallPiece*>& near_by) {
    const Vec2 at(lamp.position_m);
    for (const WallPiece* each : near_by) {
      const WallPiece& piece = *each;
      const Vec2 along = piece.to_m - piece.from_m;
      const double share = glm::dot(at - piece.from_m, along) / glm::dot(along, along);
      const double distance_m = glm::dot(piece.from_m - at, piece.normal);
      // Beside the lamp, with a margin for curves.
      if (share < -0.1 || share > 1.1 || std::abs(distance_m) > furthest_m) continue;
      const LampWall wall{glm::vec2(distance_m < 0.0 ? -piece.normal : piece.normal),
                          static_cast<float>(std::abs(distance_m))};
      for (LampWall& known : lamp.walls) {
        const bool same_side = glm::dot(known.way, wall.way) > 0.0f, fresh = known.way == glm::vec2(0.0f);
        if (!same_side && !fresh) continue;
        if (fresh || wall.distance_m < known.distance_m) known = wall;
        break;
      }
    }
  };
  for (StandingLamp& lamp : lamps) {
    if (!lamp.roofed) continue;
    const Cell cell = cell_of(Vec2(lamp.position_m));
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {-1.0, 0.0, 1.0})
        if (const auto found = by_cell.find({cell.first + x, cell.second + y}); found != by_cell.end())
          look(lamp, found->second);
  }
}

}  // namespace

std::vector<StandingLamp> standing_lamps(const scene::ResolvedScene& scene) {
  std::vector<StandingLamp> lamps;
  std::vector<WallPiece> walls;
  const std::vector<glm::vec3> emissions = mean_emissions(scene);
  for (const scene::Instance& instance : scene.instances) {
    if (instance.mesh >= scene.meshes.size()) continue;
    const scene::SurfaceMesh& mesh = scene.meshes[instance.mesh];
    for (const scene::MeshPart& part : mesh.parts) {
      if (part.material >= scene.materials.size()) continue;
      const scene::SurfaceMaterial& material = scene.materials[part.material];
      const glm::vec3 emission = emissions[part.material];
      const bool shines = emission.r + emission.g + emission.b > 0.0f;
      const bool roofed = material.share_of_sky < 0.5f;
      if (!shines && !roofed) continue;
      const std::size_t end =
          std::min<std::size_t>(std::size_t{part.first_index} + part.index_count, mesh.indices.size());
      for (std::size_t i = part.first_index; i + 2 < end; i += 3) {
        std::array<Vec3, 3> at;
        float height_m = 0.0f;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t vertex = mesh.indices[i + k];
          if (vertex >= mesh.vertices.size()) return lamps;
          const glm::vec3 local = mesh.vertices[vertex].position_m * instance.scale;
          height_m += local.z / 3.0f;
          at[k] = instance.world_from_object * Vec3(local);
        }
        const glm::vec3 across(0.5 * glm::cross(at[1] - at[0], at[2] - at[0]));
        const float area_m2 = glm::length(across);
        if (!(area_m2 > 1e-4f)) continue;
        if (!shines && std::abs(across.z) < 0.1f * area_m2) add_wall(walls, at, Vec2(across));
        if (shines && looks_down(across / area_m2))
          add_triangle(lamps, (at[0] + at[1] + at[2]) / 3.0, height_m, emission * area_m2, roofed);
      }
    }
  }
  find_walls(lamps, walls);
  return lamps;
}

}  // namespace septet::instant
