#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/physics/elastic/beam.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

namespace {

/// Steps the beam of 840 tetrahedra under a sudden pull with a sideways kick; returns stretch over expected stretch, or
/// NaN if it did not come to rest.
double stretch_after_sudden_pull(double young_pa, double load, bool tension_stiffness) {
  ElasticBody body = beam::make(2, {young_pa, 0.25, 1000.0});
  beam::clamp_start(body);
  beam::pull(body, load * young_pa * beam::area_m2, false);
  for (int i = 0; i < body.node_count(); ++i)
    if (!body.fixed[i]) body.velocity_mps[i].x() = 0.01 * body.rest_position_m[i].z() * std::sin(7.0 * i);
  StepSettings settings;
  settings.gravity_mps2.setZero();
  settings.solver = Solver::rest_factor;
  settings.tension_stiffness = tension_stiffness;
  for (int k = 0; k < 400; ++k) step_elastic(body, settings);
  for (const auto& v : body.velocity_mps)
    if (!(v.norm() < 0.01)) return NAN;
  return (beam::mean_z(body, beam::at_end) / beam::length_m - 1.0) / beam::st_venant_kirchhoff_strain(load);
}

}  // namespace

TEST_CASE("a sudden pull settles at the right stretch from 1 MPa to 10 GPa at 15 ms") {
  for (const double young : {1e6, 1e8, 1e10})
    for (const double load : {1e-3, 0.02, 0.1})
      CHECK(stretch_after_sudden_pull(young, load, true) == relative(1.0, 0.01));
}

TEST_CASE("without geometric stiffness tension destroys a stiff beam") {
  CHECK_FALSE(std::abs(stretch_after_sudden_pull(1e10, 0.02, false) - 1.0) < 0.01);
}
