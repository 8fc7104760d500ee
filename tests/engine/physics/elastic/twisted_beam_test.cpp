// The beams of the paper's figures 4, 5, 8 and 9.
#include "tests/engine/physics/elastic/twisted_beam.hpp"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/engine/physics/elastic/beam_geometries.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

TEST_CASE("a beam twisted by three radians keeps its volume and no tetrahedron of it collapses") {
  const ElasticMaterial soft{1e6, 0.25, 1000.0};
  const double moment_nm = 3.0 / 0.212 * lame_constants(soft).mu_pa * beam::torsion_constant_m4 / beam::length_m;
  ElasticBody body = beam::make(1, soft);
  const double before_m3 = volume_m3(body);
  beam::settle_twisted(body, moment_nm);
  CHECK(beam::twist_rad(body) == relative(3.0, 0.1));
  CHECK(volume_m3(body) == relative(before_m3, 0.03));
  CHECK(least_determinant_of(body) > 0.9);
  // Without the strain's square it swells.
  ElasticBody linear = beam::make(1, soft);
  beam::twist_ends(linear, moment_nm);
  REQUIRE(move_by_small_strain(linear));
  CHECK(volume_m3(linear) > 1.5 * before_m3);
}

TEST_CASE("the five geometries are of 88 nodes and 105 tetrahedra and twist unlike each other") {
  double least = 1.0, most = 0.0;
  for (const beam::Geometry& g : beam::five_geometries()) {
    CAPTURE(g.name);
    CHECK(g.mesh.nodes_m.size() == 88);
    CHECK(g.mesh.tetrahedra.size() == 105);
    ElasticBody pulled = *make_elastic_body(g.mesh, {1e8, 0.25, 1000.0});
    CHECK(beam::static_stretch(pulled, 1e5, true) == relative(beam::st_venant_kirchhoff_strain(1e-3), 1e-4));
    const double ratio = beam::static_twist_ratio(*make_elastic_body(g.mesh, {1e8, 0.25, 1000.0}),
                                                  {g.width_m / 2, beam::side_m / 2}, g.torsion_constant());
    least = std::min(least, ratio), most = std::max(most, ratio);
  }
  CHECK(least < 0.21);
  CHECK(most > 1.04 * least);
  CHECK(beam::five_geometries()[0].torsion_constant() == relative(beam::torsion_constant_m4, 1e-3));
}
