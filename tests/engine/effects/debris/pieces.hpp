#pragma once
/// Pieces for the tests: one of a single tetrahedron, and a part as its recipe makes it.

#include <array>
#include <utility>

#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

/// An empty plane at z = 0.
inline ContactWorld level_road() {
  return {[](double, double) { return GroundPoint{}; }, {}};
}

inline Piece tetrahedron(const std::array<Eigen::Vector3d, 4>& corners_m, Material material) {
  elastic::TetrahedralMesh mesh;
  mesh.nodes_m.assign(corners_m.begin(), corners_m.end());
  mesh.tetrahedra = {{0, 1, 2, 3}};
  Piece piece;
  piece.material = material_data(material);
  piece.body = *elastic::make_elastic_body(mesh, piece.material.elastic);
  piece.splinter = {0};
  piece.plastic_strain = {0.0};
  piece.surface = elastic::surface_triangles(piece.body.rest_position_m, {piece.body.elements.front().nodes});
  return piece;
}

/// At rest, its middle two metres up.
inline Piece part_at_rest(Part part, std::uint64_t seed = 1) {
  Random random(seed);
  return make_part(part, {{0, 0, 2}, {1, 0, 0, 0}}, Vec3(0), Vec3(0), random);
}

}  // namespace septet::debris
