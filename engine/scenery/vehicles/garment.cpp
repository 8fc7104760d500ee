#include "engine/scenery/vehicles/garment.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace septet::scenery {

void add_garment(geometry::MeshBuilder& builder, std::span<const GarmentRing> rings, std::uint32_t sides,
                 std::uint32_t folds) {
  std::vector<std::uint32_t> below, ring(sides);
  std::uint32_t foot = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const GarmentRing& each = rings[i];
    for (std::uint32_t k = 0; k < sides; ++k) {
      const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(sides);
      const float wander = 1.9f * static_cast<float>(i);
      const float out_m = each.fold_m * std::cos(static_cast<float>(folds) * angle + wander);
      ring[k] = builder.vertex(each.centre_m + glm::vec3((each.half_depth_m + out_m) * std::cos(angle),
                                                         (each.half_width_m + out_m) * std::sin(angle), 0.0f));
    }
    if (i == 0) foot = builder.vertex(each.centre_m);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t next = (k + 1) % sides;
      if (i == 0)
        builder.triangle(foot, ring[next], ring[k]);
      else
        builder.quad(below[k], below[next], ring[next], ring[k]);
    }
    below = ring;
  }
  if (rings.empty()) return;
  const std::uint32_t top = builder.vertex(rings.back().centre_m);
  for (std::uint32_t k = 0; k < sides; ++k) builder.triangle(top, below[k], below[(k + 1) % sides]);
}

}  // namespace septet::scenery
