#pragma once
/// Clamps a part of a body.

#include <Eigen/Core>

#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

/// Fixes every node within the box [low, high] of the rest shape.
inline void fix_nodes(ElasticBody& body, const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m) {
  for (int i = 0; i < body.node_count(); ++i) {
    const auto& x = body.rest_position_m[i];
    if ((x.array() >= low_m.array()).all() && (x.array() <= high_m.array()).all()) body.fixed[i] = 1;
  }
  invalidate_rest_factor(body);
}

}  // namespace septet::elastic
