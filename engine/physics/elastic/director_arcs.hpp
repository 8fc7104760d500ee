#pragma once
/// The directors of a sheet turn along arcs within a step.
///
/// A pair of nodes across a sheet is its director (shell.hpp). Along straight lines a director that turns by θ in a step
/// becomes longer by θ²/2, and the sheet stores that as thickness. So the part of a pair's motion across its director
/// turns it about the pair's mass centre, and the pair's relative velocity turns with it: momentum, angular momentum and
/// kinetic energy of the pair are those that the step had solved for.

#include <vector>

#include <Eigen/Core>

#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

/// Bends the ways of a step from `body.position_m` for every pair whose two nodes are free, and turns the velocities,
/// seen from any frame that does not turn. Nothing where the body is no sheet.
void turn_directors(const ElasticBody& body, std::vector<Eigen::Vector3d>& way_m,
                    std::vector<Eigen::Vector3d>& velocity_mps);

}  // namespace septet::elastic
