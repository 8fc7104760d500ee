#include "engine/physics/elastic/bad_nodes.hpp"

#include <Eigen/Core>

namespace septet::elastic {

int reset_bad_nodes(ElasticBody& body) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), rest_centre = centre, drift = centre;
  double mass = 0.0;
  int bad = 0;
  const auto is_bad = [&](int i) { return !body.position_m[i].allFinite() || !body.velocity_mps[i].allFinite(); };
  for (int i = 0; i < body.node_count(); ++i) {
    if (is_bad(i)) {
      ++bad;
      continue;
    }
    mass += body.mass_kg[i];
    centre += body.mass_kg[i] * body.position_m[i];
    rest_centre += body.mass_kg[i] * body.rest_position_m[i];
    drift += body.mass_kg[i] * body.velocity_mps[i];
  }
  if (bad == 0) return 0;
  if (mass > 0) {
    centre /= mass;
    rest_centre /= mass;
    drift /= mass;
  }
  for (int i = 0; i < body.node_count(); ++i)
    if (is_bad(i)) {
      body.position_m[i] = centre + (body.rest_position_m[i] - rest_centre);
      body.velocity_mps[i] = drift;
      body.rotation[i].setIdentity();
    }
  return bad;
}

}  // namespace septet::elastic
