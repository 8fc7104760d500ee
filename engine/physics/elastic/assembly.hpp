#pragma once
/// The system of one step: matrix M + Δt²/γ (JᵀDJ + K_g) and right side M v + Δt (F − JᵀDφ).

#include "engine/physics/elastic/step.hpp"

namespace septet::elastic {

/// Fills the workspace's matrix and right side, and with `mean_deformation` also each node's mean
/// deformation gradient. Counts inverted elements and those under tension in the report.
void assemble(ElasticBody& body, const StepSettings& settings, bool mean_deformation, StepReport& report);

}  // namespace septet::elastic
