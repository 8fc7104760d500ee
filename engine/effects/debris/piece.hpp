#pragma once
/// An elastic piece of debris: a body of tetrahedra, its material and the faces that may open.
///
/// Apart from debris_state.hpp, because only the debris itself computes with Eigen.

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "engine/effects/debris/breakable_part.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/mounted_part.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/shell.hpp"

namespace septet::debris {

/// A crack in the face between two elements: its parted share, 0 to 1. At 1 it has opened.
struct FaceCrack {
  int first = 0, second = 0;  ///< Elements, ascending.
  double reach = 0.0;
};

struct Piece {
  std::uint32_t id = 0;
  Part part = Part::bumper;
  std::optional<PieceOrigin> origin;  ///< Of what a crash tore off.
  MaterialData material;              ///< Spread over the lattice (breakable_part.hpp).
  elastic::ElasticBody body;
  std::vector<int> splinter;           ///< Splinter of each element; faces between two may open.
  std::vector<double> plastic_strain;  ///< Accumulated, of each element.
  std::vector<FaceCrack> cracks;       ///< Cracks of ice; ascending.
  std::vector<elastic::SurfaceTriangle> surface;
  double height_m = 0.0;  ///< Of the whole part along z, as far as it has not melted.
  double melted_m = 0.0;  ///< Melted since, which the shape does not show yet (melt.hpp).
  double calm_s = 0.0;    ///< Time for which it has hardly moved.
  bool asleep = false;    ///< Neither stepped nor broken until touched.
};

/// The sheet that a part is, flat (make_part.cpp); without thickness where it is none.
elastic::Shell shell_of(const PartRecipe& recipe);

inline Eigen::Vector3d to_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Vec3 from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace septet::debris
