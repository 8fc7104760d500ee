#include <doctest/doctest.h>

#include "tests/engine/physics/elastic/beam.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

TEST_CASE("four cells across bring torsion to 0.77 and bending to 0.89 of theory") {
  CHECK(beam::static_twist_ratio(4) == relative(0.77, 0.03));
  CHECK(beam::static_bend_ratio(4) == relative(0.89, 0.03));
}

TEST_CASE("pulling is right on every mesh") {
  for (const int cells : {1, 2, 4}) {
    const double free = beam::static_stretch(cells, 1e-3, true), clamped = beam::static_stretch(cells, 1e-3, false);
    CHECK(free == relative(beam::st_venant_kirchhoff_strain(1e-3), 1e-4));
    CHECK(clamped < free);
    CHECK(clamped > 0.995 * free);  // The clamp keeps the beam from growing thinner there.
    CHECK(beam::static_stretch(cells, 0.1, true) == relative(beam::st_venant_kirchhoff_strain(0.1), 0.005));
    CHECK(beam::static_push_strain(cells, -0.1) == relative(beam::st_venant_kirchhoff_strain(-0.1), 0.005));
  }
}

TEST_CASE("near incompressibility linear tetrahedra lock by a few per cent and keep their volume") {
  CHECK(beam::static_bend_ratio(4, 0.4999) == relative(0.845, 0.03));
  CHECK(beam::static_twist_ratio(4, 0.4999) == relative(0.712, 0.03));
  double volume_ratio = 0.0;
  beam::static_stretch(2, 0.01, true, 0.25, &volume_ratio);
  CHECK(volume_ratio - 1.0 == relative(4.85e-3, 0.03));
  // Green's trace zero is not determinant one: at one per cent strain that leaves -1.4e-4.
  beam::static_stretch(2, 0.01, true, 0.4999, &volume_ratio);
  CHECK(volume_ratio - 1.0 == relative(-1.4e-4, 0.15));
}
