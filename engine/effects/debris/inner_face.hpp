#pragma once
/// Faces within a body of tetrahedra: each between two elements, where it may open.

#include <array>
#include <vector>

#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::debris {

struct InnerFace {
  int first, second;         ///< Elements, ascending.
  std::array<int, 3> nodes;  ///< Ascending.
};

std::vector<InnerFace> inner_faces(const elastic::ElasticBody& body);

}  // namespace septet::debris
