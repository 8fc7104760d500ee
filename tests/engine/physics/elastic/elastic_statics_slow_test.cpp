#include <doctest/doctest.h>

#include "tests/engine/physics/elastic/beam.hpp"

using namespace septet;
using namespace septet::elastic;

TEST_CASE("four cells across bring torsion to 0.77 and bending to 0.89 of theory") {
  CHECK(beam::static_twist_ratio(4) == doctest::Approx(0.77).epsilon(0.03).scale(0.0));
  CHECK(beam::static_bend_ratio(4) == doctest::Approx(0.89).epsilon(0.03).scale(0.0));
}

TEST_CASE("pulling is right on every mesh") {
  for (const int cells : {1, 2, 4}) {
    const double free = beam::static_stretch(cells, 1e-3, true), clamped = beam::static_stretch(cells, 1e-3, false);
    CHECK(free == doctest::Approx(beam::st_venant_kirchhoff_strain(1e-3)).epsilon(1e-4).scale(0.0));
    CHECK(clamped < free);
    CHECK(clamped > 0.995 * free);  // The clamp keeps the beam from growing thinner there.
    CHECK(beam::static_stretch(cells, 0.1, true) ==
          doctest::Approx(beam::st_venant_kirchhoff_strain(0.1)).epsilon(0.005).scale(0.0));
    CHECK(beam::static_push_strain(cells, -0.1) ==
          doctest::Approx(beam::st_venant_kirchhoff_strain(-0.1)).epsilon(0.005).scale(0.0));
  }
}

TEST_CASE("near incompressibility linear tetrahedra lock by a few per cent and keep their volume") {
  CHECK(beam::static_bend_ratio(4, 0.4999) == doctest::Approx(0.845).epsilon(0.03).scale(0.0));
  CHECK(beam::static_twist_ratio(4, 0.4999) == doctest::Approx(0.712).epsilon(0.03).scale(0.0));
  double volume_ratio = 0.0;
  beam::static_stretch(2, 0.01, true, 0.25, &volume_ratio);
  CHECK(volume_ratio - 1.0 == doctest::Approx(4.85e-3).epsilon(0.03).scale(0.0));
  // Green's trace zero is not determinant one: at one per cent strain that leaves -1.4e-4.
  beam::static_stretch(2, 0.01, true, 0.4999, &volume_ratio);
  CHECK(volume_ratio - 1.0 == doctest::Approx(-1.4e-4).epsilon(0.15).scale(0.0));
}
