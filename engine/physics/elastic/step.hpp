#pragma once
/// One step of the regularised stepper of Servin, Lacoursière and Melin ("Interactive simulation of elastic deformable
/// materials", 2006) in its primal form.
///
/// Their eq. 20, with the multiplier eliminated and α⁻¹ = D, is
///     (M + Δt²/γ JᵀDJ) v⁺ = M v + Δt F − Δt JᵀDφ,   x⁺ = x + Δt v⁺,   γ = (½ + β/Δt)⁻¹,
/// three unknowns a node instead of nine a tetrahedron, symmetric and positive definite; where α has no inverse, at
/// Poisson's ratio one half, held_volume.hpp keeps one multiplier a tetrahedron. It is linearly implicit Euler
/// without the geometric stiffness, the term that delays a swinging body; rigid motion is therefore untouched. Stiff
/// modes are multiplied by 1−γ each step: β = 0 rings at the step's own frequency for ever, β = Δt/2 kills them in one
/// step.
///
/// Prestress stays explicit, which is unstable for tension beyond about 4ρ/(Δt²|g|²): those elements, and only those,
/// get the tensile part of their geometric stiffness, on the change of velocity, so that spin is not slowed:
///     (M + Δt²/γ (JᵀDJ + K_g)) v⁺ = (M + Δt²/γ K_g) v + …
///
/// A body that can turn as a whole, free or about fixed nodes on a line or in a point, moves along arcs: its rigid
/// rotation is taken out of the update of positions and applied exactly, with the centrifugal force in its place. Along
/// straight lines, 10 rad/s at 15 ms would stretch a body by one per cent, which breaks everything but rubber; and
/// geometric stiffness takes that stretch for tension, so that a cube of 10 GPa on a hinge swings down in 1.4 times its
/// time.

#include <span>

#include <Eigen/Core>

#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

enum class Solver {
  automatic,    ///< Direct up to `direct_limit` elements, else preconditioned.
  direct,       ///< A new factorisation every step.
  rest_factor,  ///< Conjugate gradients, preconditioned by the factor at rest turned with the nodes.
};

struct StepSettings {
  double step_s = 0.015;
  double damping_ratio = 0.2;  ///< β/Δt; 0 conserves, 0.5 damps stiff modes within one step.
  Eigen::Vector3d gravity_mps2{0.0, 0.0, -septet::gravity_mps2};
  bool tension_stiffness = true;
  bool follow_spin = true;   ///< Of bodies that can turn as a whole; false is the published update.
  bool keep_stress = false;  ///< Fill ElasticBody::step_stress_pa.
  Solver solver = Solver::automatic;
  int direct_limit = 400;
  double tolerance = 1e-5;  ///< Bound on the error's energy norm, relative to the first guess's.
  int max_iterations = 400;
};

/// A node against a surface, for one step. The gap is negative inside. Derived in engine/effects/debris/contacts.cpp.
struct NodeContact {
  int node = 0;
  Eigen::Vector3d normal{0.0, 0.0, 1.0};  ///< Unit length, away from the surface.
  double gap_m = 0.0;
  Eigen::Vector3d surface_velocity_mps{0.0, 0.0, 0.0};
  double friction = 0.0;                      ///< Coulomb's coefficient.
  Eigen::Vector3d impulse_ns{0.0, 0.0, 0.0};  ///< Out: impulse of the surface on the node.
};

struct StepReport {
  int iterations = 0;  ///< Iterations of the conjugate gradients; 0 where the solve was direct.
  bool converged = true;
  int bad_numbers = 0;    ///< Nodes reset because of NaN or infinite numbers.
  int inverted = 0;       ///< Elements with det F ≤ 0 at the start of the step.
  int under_tension = 0;  ///< Elements that got geometric stiffness.
};

/// Advances the body by one step. Contacts have at most one entry per node and surface.
StepReport step_elastic(ElasticBody& body, const StepSettings& settings, std::span<NodeContact> contacts = {});

inline double gamma_of(const StepSettings& s) { return 1.0 / (0.5 + s.damping_ratio); }

}  // namespace septet::elastic
