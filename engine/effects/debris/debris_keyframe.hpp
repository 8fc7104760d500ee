#pragma once
/// Debris on the wire: one EffectKeyframe per piece and one for all shards. The format is written down in DEBRIS.md.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/mounted_part.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::debris {

inline constexpr std::uint16_t keyframe_kind = 2;
/// Effect ids of debris: a base plus the piece's id modulo 2²⁴; the shards have the base itself.
inline constexpr std::uint32_t first_effect_id = 0x02000000;
/// Positions on the wire are multiples of this; the error of a coordinate is at most half of it.
inline constexpr double position_quantum_m = 1e-3;
inline constexpr std::size_t max_vertices = 4096, max_triangles = 8192, max_cracks = 4096;

/// A screen's picture of one piece: triangles, counter-clockwise from outside. Shards are drawn from both sides.
struct Keyframe {
  Part part = Part::bumper;
  Material material = Material::bumper_plastic;
  bool shards = false;
  bool asleep = false;
  std::vector<Vec3> vertices_m;
  /// Rest places of ice, one a vertex: in the whole part, before any motion or fracture. The inside's texture follows
  /// it.
  std::vector<Vec3> rest_m;
  std::vector<std::array<std::uint16_t, 3>> triangles;
  /// A crack of ice: a face that has not yet opened; the crack grows from its first corner.
  struct Crack {
    std::array<std::uint16_t, 3> corners{};
    std::uint8_t reach = 0;  ///< Share of its edges, in 1/255.
  };
  std::vector<Crack> cracks;
  /// What a crash tore it off.
  std::optional<PieceOrigin> origin;
  /// With an origin: where each vertex lies in the part's whole lattice (lattice_place_m).
  std::vector<std::uint8_t> lattice_nodes;
};

int lattice_node_count(Part part);
/// Place of a node of the part's lattice in the whole part, before it bent or broke.
Vec3 lattice_place_m(Part part, int node);

/// The outer surface of a piece.
Keyframe keyframe_of(const Piece& piece);
/// One triangle a shard.
Keyframe keyframe_of(const std::vector<Shard>& shards);

Bytes encode(const Keyframe& keyframe);
/// Error: bytes that `encode` would not write; safe on hostile bytes.
Expected<Keyframe> decode(std::span<const std::byte> bytes);

}  // namespace septet::debris
