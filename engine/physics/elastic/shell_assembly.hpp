#pragma once
/// A sheet's part of the system of one step (assembly.hpp), as shell.hpp derives it.

#include "engine/physics/elastic/step.hpp"

namespace septet::elastic {

/// Adds stiffness and impulses of a body's shell. Counts places under tension in the report.
void assemble_shell(ElasticBody& body, const StepSettings& settings, StepReport& report);

/// Adds scale·JᵀDJ of the shell in its shape at rest.
void add_rest_stiffness_of_shell(const ElasticBody& body, double scale, BlockMatrix& matrix);

}  // namespace septet::elastic
