#pragma once
/// The beam of figures 4 and 5 of Servin et al.: free, and twisted by opposite moments on its short ends.

#include <Eigen/Geometry>

#include "tests/engine/physics/elastic/beam.hpp"

namespace septet::elastic::beam {

/// Forces across the axis on the nodes of both ends: opposite moments about it, as the ends lie now.
inline void twist_ends(ElasticBody& body, double moment_nm) {
  const auto load = [&](const auto& on_end, double moment) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    int count = 0;
    for (int i = 0; i < body.node_count(); ++i)
      if (on_end(body, i)) middle += body.position_m[i], ++count;
    middle /= count;
    const auto across = [&](int i) { return Eigen::Vector3d::UnitZ().cross(body.position_m[i] - middle).eval(); };
    double inertia = 0.0;
    for (int i = 0; i < body.node_count(); ++i)
      if (on_end(body, i)) inertia += across(i).squaredNorm();
    for (int i = 0; i < body.node_count(); ++i)
      if (on_end(body, i)) body.force_n[i] = moment / inertia * across(i);
  };
  load(at_start, -moment_nm);
  load(at_end, moment_nm);
}

/// Twist between the ends: the mean turn of their nodes about their middles.
inline double twist_rad(const ElasticBody& body) {
  const auto turn = [&](const auto& on_end) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero(), rest_middle = middle;
    int count = 0;
    for (int i = 0; i < body.node_count(); ++i)
      if (on_end(body, i)) middle += body.position_m[i], rest_middle += body.rest_position_m[i], ++count;
    double along = 0.0, across = 0.0;
    for (int i = 0; i < body.node_count(); ++i) {
      if (!on_end(body, i)) continue;
      const Eigen::Vector3d arm = body.rest_position_m[i] - rest_middle / count,
                            now = body.position_m[i] - middle / count;
      along += arm.x() * now.x() + arm.y() * now.y();
      across += arm.x() * now.y() - arm.y() * now.x();
    }
    return std::atan2(across, along);
  };
  return turn(at_end) - turn(at_start);
}

/// Steps until the twist has settled.
inline void settle_twisted(ElasticBody& body, double moment_nm) {
  StepSettings settings;
  settings.gravity_mps2.setZero();
  settings.damping_ratio = 0.5;
  for (int k = 0; k < 400; ++k) {
    twist_ends(body, moment_nm);
    step_elastic(body, settings);
    for (auto& v : body.velocity_mps) v *= 0.9;
  }
}

}  // namespace septet::elastic::beam
