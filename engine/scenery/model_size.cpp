#include "engine/scenery/model_size.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace septet::scenery {

std::string told_size(const gltf::Model& model) {
  std::size_t triangles = 0;
  for (const gltf::Part& part : model.parts)
    if (part.is_there_at_first()) triangles += part.mesh.polygons.size();
  const glm::vec3 size_m = model.most_m - model.least_m;
  return fmt::format(
      "{} triangles; {:.2f} m long (glTF's z, forward), {:.2f} m wide (x, left), {:.2f} m high (y, up), from {:.2f} m "
      "above its origin on",
      triangles, size_m.x, size_m.y, size_m.z, model.least_m.z);
}

std::optional<SizeDoubt> doubted_size(const gltf::Model& model) {
  constexpr float most_m = 100.0f, least_m = 0.05f;
  const glm::vec3 size_m = model.most_m - model.least_m;
  const float longest_m = std::max({size_m.x, size_m.y, size_m.z});
  if (longest_m >= least_m && longest_m <= most_m) return std::nullopt;
  return SizeDoubt{fmt::format("its longest side is {:.3g} m, as if its lengths were no metres", longest_m),
                   longest_m < least_m          ? "scale it by 100, if it is too small"
                   : longest_m > 10.0f * most_m ? "scale it by 0.001, if its lengths are millimetres"
                                                : "scale it by 0.01, if its lengths are centimetres"};
}

}  // namespace septet::scenery
