#pragma once
/// An incremental turn of an orientation, for tests and benchmarks against interpolation at one instant.

#include <cstddef>

#include "engine/math/incremental_turn.hpp"

namespace septet {

/// Turns between orientations, by the shorter path: q and −q are one orientation, so no pair is antipodal.
inline Expected<IncrementalTurn<double, 4>> turn_between(const Quat& from, const Quat& to, std::size_t steps,
                                                         double sigma = 0.0) {
  const double sign = glm::dot(from, to) < 0.0 ? -1.0 : 1.0;
  return IncrementalTurn<double, 4>::between({from.w, from.x, from.y, from.z},
                                             {sign * to.w, sign * to.x, sign * to.y, sign * to.z}, steps, sigma);
}

inline Quat to_quat(const UnitVector<double, 4>& v) { return Quat(v[0], v[1], v[2], v[3]); }

}  // namespace septet
