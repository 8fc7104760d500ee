#include "engine/effects/debris/inner_face.hpp"

#include <algorithm>
#include <cstddef>
#include <map>

namespace septet::debris {

std::vector<InnerFace> inner_faces(const elastic::ElasticBody& body) {
  std::map<std::array<int, 3>, int> open;
  std::vector<InnerFace> result;
  for (int e = 0; e < static_cast<int>(body.elements.size()); ++e)
    for (const auto& f : elastic::tetrahedron_faces) {
      const auto& t = body.elements[e].nodes;
      std::array<int, 3> face{t[f[0]], t[f[1]], t[f[2]]};
      std::ranges::sort(face);
      const auto [place, fresh] = open.try_emplace(face, e);
      if (!fresh) result.push_back({place->second, e, face});
    }
  return result;
}

}  // namespace septet::debris
