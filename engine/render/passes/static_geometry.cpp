#include "engine/render/passes/static_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/packing.hpp>

#include "engine/core/parallel_for.hpp"
#include "engine/render/passes/stripes.hpp"

namespace septet::render {
namespace {

using scene::SurfaceMesh;
using scene::SurfaceVertex;

constexpr double block_side_m = 2000.0;

/// Block of a place; the middle of its square is its origin.
std::uint32_t block_of(StaticGeometry& geometry, std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t>& known,
                       const Vec3& position_m) {
  const auto x = static_cast<std::int64_t>(std::floor(position_m.x / block_side_m));
  const auto y = static_cast<std::int64_t>(std::floor(position_m.y / block_side_m));
  const auto [found, added] = known.try_emplace({x, y}, static_cast<std::uint32_t>(geometry.blocks.size()));
  if (added)
    geometry.blocks.push_back(
        {Vec3((double(x) + 0.5) * block_side_m, (double(y) + 0.5) * block_side_m, position_m.z), {}});
  return found->second;
}

bool holds(const SurfaceMesh& mesh, const scene::MeshPart& part) {
  if (part.first_index > mesh.indices.size() || part.index_count > mesh.indices.size() - part.first_index) return false;
  const auto first = mesh.indices.begin() + part.first_index;
  return std::all_of(first, first + part.index_count,
                     [&](std::uint32_t index) { return index < mesh.vertices.size(); });
}

/// Adds the instance's piece with its parts and indices, for vertices from `first_vertex` on; false if no part of it is
/// drawn.
bool add_piece(StaticGeometry& geometry, std::uint32_t block, std::uint32_t first_vertex,
               const scene::Instance& instance, const SurfaceMesh& mesh) {
  StaticPiece piece;
  piece.placed = place(instance, {mesh.bounds_min_m, mesh.bounds_max_m}, instance.world_from_object);
  piece.block = block;
  piece.first_part = static_cast<std::uint32_t>(geometry.parts.size());
  for (const scene::MeshPart& part : mesh.parts) {
    if (part.index_count == 0 || !holds(mesh, part)) continue;
    geometry.parts.push_back({part.material, static_cast<std::uint32_t>(geometry.indices.size()), part.index_count,
                              static_cast<std::uint32_t>(geometry.clumps.size())});
    geometry.clumps.resize(geometry.clumps.size() + (part.index_count + clump_indices - 1) / clump_indices);
    for (std::uint32_t i = 0; i < part.index_count; ++i)
      geometry.indices.push_back(first_vertex + mesh.indices[part.first_index + i]);
  }
  piece.part_count = static_cast<std::uint32_t>(geometry.parts.size()) - piece.first_part;
  if (piece.part_count == 0) return false;
  geometry.pieces.push_back(piece);
  return true;
}

/// A mirroring turn changes the side of a normal map's green.
std::uint32_t turned_tangent(std::uint32_t packed, const glm::mat3& turn) {
  const glm::vec4 tangent = glm::unpackSnorm4x8(packed);
  const glm::vec3 along_u = turn * glm::vec3(tangent);
  const float length = glm::length(along_u);
  if (!(length > 0.0f)) return 0;
  return glm::packSnorm4x8(glm::vec4(along_u / length, glm::determinant(turn) < 0.0f ? -tangent.w : tangent.w));
}

/// Writes an instance's vertices at their places in its block.
void fill_vertices(StaticBlock& block, std::uint32_t first_vertex, const Vec3& position_m, const glm::mat3& turn,
                   const SurfaceMesh& mesh) {
  const glm::vec3 origin(position_m - block.origin_m);
  // Normals turn by R·S⁻¹ = M·S⁻², as in shaders/instances.glsl.
  const glm::vec3 squares(glm::dot(turn[0], turn[0]), glm::dot(turn[1], turn[1]), glm::dot(turn[2], turn[2]));
  const glm::mat3 normal_turn(turn[0] / squares.x, turn[1] / squares.y, turn[2] / squares.z);
  SurfaceVertex* target = block.vertices.data() + first_vertex;
  for (const SurfaceVertex& vertex : mesh.vertices) {
    *target = vertex;
    target->position_m = origin + turn * vertex.position_m;
    target->normal = normal_turn * vertex.normal;
    if (vertex.tangent != 0) target->tangent = turned_tangent(vertex.tangent, turn);
    ++target;
  }
}

void fill_clumps(StaticGeometry& geometry, const StaticPiece& piece) {
  const std::vector<SurfaceVertex>& vertices = geometry.blocks[piece.block].vertices;
  for (std::uint32_t at = piece.first_part; at < piece.first_part + piece.part_count; ++at) {
    const StaticPart& part = geometry.parts[at];
    for (std::uint32_t first = 0; first < part.index_count; first += clump_indices) {
      glm::vec3 low(INFINITY), high(-INFINITY);
      for (std::uint32_t i = first; i < std::min(first + clump_indices, part.index_count); ++i) {
        const glm::vec3& corner = vertices[geometry.indices[part.first_index + i]].position_m;
        low = glm::min(low, corner), high = glm::max(high, corner);
      }
      geometry.clumps[part.first_clump + first / clump_indices] = {0.5f * (low + high), 0.5f * (high - low)};
    }
  }
}

bool is_outside(const StaticClump& clump, const glm::vec3& origin_m, const ViewVolume& volume) {
  constexpr float slack_m = 0.01f;
  const glm::vec3 middle = origin_m + clump.middle_m;
  return std::any_of(volume.begin(), volume.end(), [&](const glm::vec3& normal) {
    return glm::dot(normal, middle) + glm::dot(glm::abs(normal), clump.half_m) < -slack_m;
  });
}

}  // namespace

std::vector<bool> placed_once(const scene::ResolvedScene& scene) {
  std::vector<std::uint32_t> uses(scene.meshes.size(), 0);
  for (const scene::Instance& instance : scene.instances)
    if (instance.mesh < uses.size()) ++uses[instance.mesh];
  for (const scene::Prototype& prototype : scene.prototypes)
    for (const scene::Instance& part : prototype.parts)
      if (part.mesh < uses.size()) uses[part.mesh] += 2;
  std::vector<bool> once(uses.size());
  for (std::size_t i = 0; i < uses.size(); ++i) once[i] = uses[i] == 1;
  return once;
}

StaticGeometry static_geometry(const scene::ResolvedScene& scene, const std::vector<bool>& chosen) {
  StaticGeometry geometry;
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> known;
  struct Filling {
    const scene::Instance* instance;
    std::uint32_t first_vertex;
  };
  std::vector<Filling> fillings;        // One a piece.
  std::vector<std::uint32_t> vertices;  // Indexed by block.
  for (const scene::Instance& instance : scene.instances) {
    if (instance.mesh >= scene.meshes.size() || !chosen[instance.mesh]) continue;
    const SurfaceMesh& mesh = scene.meshes[instance.mesh];
    const std::uint32_t block = block_of(geometry, known, instance.world_from_object.position_m);
    vertices.resize(geometry.blocks.size(), 0);
    if (!add_piece(geometry, block, vertices[block], instance, mesh)) continue;
    fillings.push_back({&instance, vertices[block]});
    vertices[block] += static_cast<std::uint32_t>(mesh.vertices.size());
  }
  for (std::size_t block = 0; block < vertices.size(); ++block) geometry.blocks[block].vertices.resize(vertices[block]);
  parallel_for(fillings.size(), [&](std::size_t i) {
    const auto& [instance, first_vertex] = fillings[i];
    const StaticPiece& piece = geometry.pieces[i];
    fill_vertices(geometry.blocks[piece.block], first_vertex, instance->world_from_object.position_m,
                  piece.placed.world_from_object, scene.meshes[instance->mesh]);
    for (std::uint32_t at = piece.first_part; at < piece.first_part + piece.part_count; ++at) {
      const StaticPart& part = geometry.parts[at];
      if (part.material < scene.materials.size() && scene.materials[part.material].stripe)
        find_stripe_edges(geometry.blocks[piece.block].vertices,
                          std::span(geometry.indices).subspan(part.first_index, part.index_count));
    }
    fill_clumps(geometry, piece);
  });
  return geometry;
}

Gathered gather(const StaticGeometry& geometry, const Vec3& eye_m,
                const std::function<bool(const PlacedMesh&, const glm::vec3&)>& keep,
                const std::function<std::uint32_t(std::uint32_t)>& group_of, const Detail& detail,
                const ViewVolume* volume) {
  struct Seen {
    float square_m2;
    std::uint32_t piece;
    instant::LevelFade fade;
  };
  std::vector<Seen> seen;
  for (std::uint32_t i = 0; i < geometry.pieces.size(); ++i) {
    const PlacedMesh& placed = geometry.pieces[i].placed;
    const glm::vec3 origin(placed.origin_m - eye_m);
    const instant::LevelFade fade =
        instant::fade_at(detail_range_m(placed, origin, detail), placed.visible_from_m, placed.visible_to_m);
    if (fade.none()) continue;
    const glm::vec3 centre = origin + placed.centre_m;
    if (keep(placed, centre)) seen.push_back({glm::dot(centre, centre), i, fade});
  }
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return std::pair(a.square_m2, a.piece) < std::pair(b.square_m2, b.piece);
  });

  // Lists of parts by block and group; draws in the order of their first parts.
  Gathered result;
  result.pieces = static_cast<std::uint32_t>(seen.size());
  std::map<std::tuple<std::uint32_t, std::uint32_t, float, float>, std::size_t> draw_of;
  std::vector<std::vector<std::uint32_t>> parts;
  for (const Seen& each : seen) {
    const StaticPiece& piece = geometry.pieces[each.piece];
    for (std::uint32_t i = piece.first_part; i < piece.first_part + piece.part_count; ++i) {
      const std::uint32_t group = group_of(geometry.parts[i].material);
      if (group == no_group) continue;
      const auto [found, added] =
          draw_of.try_emplace({piece.block, group, each.fade.from, each.fade.to}, result.draws.size());
      if (added) {
        result.draws.push_back({piece.block, group, 0, 0, each.fade});
        parts.emplace_back();
      }
      parts[found->second].push_back(i);
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    GatheredDraw& draw = result.draws[i];
    draw.first_index = static_cast<std::uint32_t>(result.indices.size());
    const glm::vec3 origin(geometry.blocks[draw.block].origin_m - eye_m);
    for (const std::uint32_t index : parts[i]) {
      const StaticPart& part = geometry.parts[index];
      const auto all = geometry.indices.begin() + part.first_index;
      if (!volume) {
        result.indices.insert(result.indices.end(), all, all + part.index_count);
        continue;
      }
      for (std::uint32_t first = 0; first < part.index_count; first += clump_indices)
        if (!is_outside(geometry.clumps[part.first_clump + first / clump_indices], origin, *volume))
          result.indices.insert(result.indices.end(), all + first,
                                all + std::min(first + clump_indices, part.index_count));
    }
    draw.index_count = static_cast<std::uint32_t>(result.indices.size()) - draw.first_index;
  }
  std::erase_if(result.draws, [](const GatheredDraw& draw) { return draw.index_count == 0; });
  return result;
}

InstanceRecord record_of(const StaticBlock& block, const Vec3& eye_m, const instant::LevelFade& fade) {
  const glm::vec3 origin(block.origin_m - eye_m);
  return {glm::vec4(1, 0, 0, origin.x),
          glm::vec4(0, 1, 0, origin.y),
          glm::vec4(0, 0, 1, origin.z),
          glm::vec4(1.0f),
          glm::vec4(1.0f, 1.0f, 1.0f, PlacedMesh::unknown_road),
          glm::vec2(fade.from, fade.to)};
}

}  // namespace septet::render
