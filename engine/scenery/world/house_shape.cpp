#include "engine/scenery/world/house_shape.hpp"

#include <cmath>
#include <cstdint>

#include "engine/geometry/shapes.hpp"

namespace septet::scenery {

/// Walls with one window every four metres, a saddle roof with eaves, its chimney.
void add_house(geometry::MeshBuilder& builder, const roadside::HouseBlock& block, const HouseLook& look) {
  const auto length = static_cast<float>(block.length_m), width = static_cast<float>(block.width_m),
             x0 = static_cast<float>(block.x_m), y0 = static_cast<float>(block.y_m);
  const float l = length / 2, w = width / 2, foot = -1.5f;
  const auto at = [&](float x, float y, float z) { return glm::vec3(x0 + x, y0 + y, z); };
  const float nu = std::round(length / 4), nw = std::round(width / 4), nv = std::round(look.eaves / 2.8f),
              low = 1.5f / 2.8f;
  builder.material = index_of(look.wall);
  const auto wall = [&](const glm::vec3& a, const glm::vec3& b, float windows) {
    builder.patch(a + glm::vec3(0, 0, foot), b + glm::vec3(0, 0, foot), b + glm::vec3(0, 0, look.eaves),
                  a + glm::vec3(0, 0, look.eaves), {{{0, nv + low}, {windows, nv + low}, {windows, 0}, {0, 0}}});
  };
  wall(at(-l, -w, 0), at(l, -w, 0), nu);
  wall(at(l, -w, 0), at(l, w, 0), nw);
  wall(at(l, w, 0), at(-l, w, 0), nu);
  wall(at(-l, w, 0), at(-l, -w, 0), nw);
  for (const float side : {1.0f, -1.0f}) {
    const std::uint32_t a = builder.vertex(at(side * l, -side * w, look.eaves)),
                        b = builder.vertex(at(side * l, side * w, look.eaves)),
                        c = builder.vertex(at(side * l, 0, look.ridge));
    builder.triangle(a, b, c, {{{0, 0.22f}, {0.2f, 0.22f}, {0.1f, 0.02f}, {}}});
  }
  builder.material = index_of(look.roof);
  const float over = 0.5f, drop = over * (look.ridge - look.eaves) / w;
  builder.patch(at(-l - over, -w - over, look.eaves - drop), at(l + over, -w - over, look.eaves - drop),
                at(l + over, 0, look.ridge + 0.08f), at(-l - over, 0, look.ridge + 0.08f));
  builder.patch(at(l + over, w + over, look.eaves - drop), at(-l - over, w + over, look.eaves - drop),
                at(-l - over, 0, look.ridge + 0.08f), at(l + over, 0, look.ridge + 0.08f));
  builder.append(
      geometry::box(at(-0.4f + l * 0.3f, -0.4f, look.ridge - 0.6f), at(0.4f + l * 0.3f, 0.4f, look.ridge + 0.9f)),
      glm::mat4(1.0f), true);
}

}  // namespace septet::scenery
