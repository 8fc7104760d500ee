#include "engine/effects/debris/laminate.hpp"

#include <utility>

#include "engine/physics/elastic/body_measures.hpp"

namespace septet::debris {

elastic::ElasticMaterial present_elastic(const Piece& piece) {
  elastic::ElasticMaterial elastic = piece.material.elastic;
  const bool limp = part_recipe(piece.part).breakage == Breakage::holds && !piece.cracks.empty();
  if (limp) elastic.young_modulus_pa *= film_share;
  return elastic;
}

double take_cracks(Piece& piece, FractureResult& result) {
  piece.cracks = std::move(result.cracks);
  const elastic::ElasticMaterial now = present_elastic(piece);
  if (now.young_modulus_pa == piece.body.material.young_modulus_pa) return 0.0;
  const double before_j = elastic::elastic_energy_j(piece.body);
  piece.body.material = now;
  elastic::invalidate_rest_factor(piece.body);
  return before_j - elastic::elastic_energy_j(piece.body);
}

}  // namespace septet::debris
