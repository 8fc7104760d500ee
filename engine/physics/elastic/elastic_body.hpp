#pragma once
/// One elastic body: its state, its material and the structure of its equations.
///
/// Node indices are the body's own, in the order of elimination; `body_node_of_mesh_node` leads from
/// the mesh's. World frame, metres, kilograms, newtons. A body belongs to one thread at a time.

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "engine/core/expected.hpp"
#include "engine/physics/elastic/block_cholesky.hpp"
#include "engine/physics/elastic/elastic_material.hpp"
#include "engine/physics/elastic/shell.hpp"
#include "engine/physics/elastic/tetrahedral_mesh.hpp"

namespace septet::elastic {

/// The constant part of one tetrahedron with linear shape functions.
struct Element {
  Tetrahedron nodes;  ///< Ascending body nodes.
  /// Rows are the gradients of the last three nodes' shape functions in rest coordinates, so that
  /// F = [x₁−x₀, x₂−x₀, x₃−x₀] · rest_inverse. Plastic flow replaces it by rest_inverse · Fp⁻¹.
  Eigen::Matrix3d rest_inverse;
  double rest_volume_m3 = 0.0;
  std::array<int, 6> slots{};  ///< Slots of the blocks (1,0) (2,0) (2,1) (3,0) (3,1) (3,2).
};

/// The factor at rest that preconditions large bodies, and the parameters it was made with.
struct RestFactor {
  bool valid = false;
  double step_scale_s2 = 0.0;  ///< Δt²/γ.
  bool single_precision = false;
  BlockFactor<double> in_double;
  BlockFactor<float> in_single;
};

/// Workspace of one step, reused by the next, so that a step allocates nothing.
struct StepWorkspace {
  BlockMatrix matrix;
  BlockVector right_side, solution, residual, direction, image, preconditioned;
  BlockFactor<double> factor;
  std::vector<double> held_stress_pa;  ///< Of each element of an incompressible solid: p in the right side.
  std::vector<Eigen::Array4f> single;
  std::vector<Block> mean_deformation;  ///< Volume-weighted F of each node.
};

struct ElasticBody {
  // State.
  std::vector<Eigen::Vector3d> position_m, velocity_mps;
  std::vector<Eigen::Vector3d> force_n;    ///< External, besides gravity; stays until changed.
  std::vector<std::uint8_t> fixed;         ///< 1: the node keeps its velocity, whatever the forces on it.
  std::vector<double> contact_impulse_ns;  ///< Normal impulse of the last step, for friction.

  /// Cauchy stress that carried the last step's impulses, of each element; filled where StepSettings::keep_stress is
  /// set. In a stiff body it is the only trace of an impact, because the strain that remains after the step is nearly
  /// zero.
  std::vector<Eigen::Matrix3d> step_stress_pa;
  /// Of an incompressible solid: the stress of each element that kept its volume in the last step (held_volume.hpp).
  std::vector<double> volume_stress_pa;

  // Constant, except where fracture or plastic flow rewrites it.
  ElasticMaterial material;
  std::vector<Eigen::Vector3d> rest_position_m;
  std::vector<double> mass_kg;
  std::vector<Element> elements;
  std::vector<int> body_node_of_mesh_node;
  Shell shell;  ///< Of a sheet, whose elements then carry nothing. Call derive_structure after setting it.

  // Derived from the elements.
  BlockPattern pattern;
  FactorPattern factor_structure;
  std::vector<Eigen::Matrix3d> rotation;  ///< Rotation of each node from rest, followed from step to step.
  RestFactor rest_factor;
  StepWorkspace workspace;

  int node_count() const { return static_cast<int>(position_m.size()); }
};

/// A body at rest in the mesh's shape. Error: an invalid mesh or material.
Expected<ElasticBody> make_elastic_body(const TetrahedralMesh& mesh, const ElasticMaterial& material);

/// Derives the equations' structure from the elements' nodes, and each element's position in it.
void derive_structure(ElasticBody& body);

/// Call after changes of `fixed` or of the elements' rest shapes.
void invalidate_rest_factor(ElasticBody& body);

}  // namespace septet::elastic
