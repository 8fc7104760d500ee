#include "engine/scenery/world/house_shape.hpp"

#include <cmath>
#include <cstdint>

#include "engine/geometry/shapes.hpp"

namespace septet::scenery {

namespace {

constexpr float foot_m = -1.5f, window_every_m = 4.0f, floor_m = 2.8f, below_lowest = 1.5f / floor_m;

/// Repeats of the facade's picture along a wall, and down it.
float windows_along(float wall_m) { return std::round(wall_m / window_every_m); }
float floors_below(float eaves_m) { return std::round(eaves_m / floor_m); }

}  // namespace

/// Walls with one window every four metres, a saddle roof with eaves, its chimney.
void add_house(geometry::MeshBuilder& builder, const roadside::HouseBlock& block, const HouseLook& look) {
  const auto length = static_cast<float>(block.length_m), width = static_cast<float>(block.width_m),
             x0 = static_cast<float>(block.x_m), y0 = static_cast<float>(block.y_m);
  const float l = length / 2, w = width / 2, foot = foot_m;
  const auto at = [&](float x, float y, float z) { return glm::vec3(x0 + x, y0 + y, z); };
  const float nu = windows_along(length), nw = windows_along(width), nv = floors_below(look.eaves), low = below_lowest;
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
  const float over = 0.5f, drop = over * (look.ridge - look.eaves) / w, end = l + look.over_gable_m;
  builder.patch(at(-end, -w - over, look.eaves - drop), at(end, -w - over, look.eaves - drop),
                at(end, 0, look.ridge + 0.08f), at(-end, 0, look.ridge + 0.08f));
  builder.patch(at(end, w + over, look.eaves - drop), at(-end, w + over, look.eaves - drop),
                at(-end, 0, look.ridge + 0.08f), at(end, 0, look.ridge + 0.08f));
  builder.append(
      geometry::box(at(-0.4f + l * 0.3f, -0.4f, look.ridge - 0.6f), at(0.4f + l * 0.3f, 0.4f, look.ridge + 0.9f)),
      glm::mat4(1.0f), true);
}

void add_lit_windows(geometry::MeshBuilder& builder, const roadside::HouseBlock& block, const HouseLook& look,
                     double share, Random& random) {
  // Extents in the facade's picture, from its left and from its top: two panes beside each other.
  constexpr float panes[2][2] = {{45.0f / 128.0f, 62.0f / 128.0f}, {66.0f / 128.0f, 83.0f / 128.0f}};
  constexpr float top = 39.0f / 128.0f, bottom = 85.0f / 128.0f, before_wall_m = 0.02f, least_over_ground_m = 0.4f;
  const auto length = static_cast<float>(block.length_m), width = static_cast<float>(block.width_m);
  const glm::vec3 middle(static_cast<float>(block.x_m), static_cast<float>(block.y_m), 0.0f);
  const float floors = floors_below(look.eaves), picture_m = (look.eaves - foot_m) / (floors + below_lowest);
  builder.material = index_of(Ground::window_lit);
  const auto wall = [&](const glm::vec3& begin, const glm::vec3& along, const glm::vec3& out, float wall_m) {
    const float count = windows_along(wall_m), bay_m = wall_m / count;
    for (float k = 0.0f; k < count; ++k)
      for (float n = 0.0f; n < floors; ++n) {
        const bool lit = random.uniform() < share;
        const float high_m = look.eaves - (n + top) * picture_m, low_m = look.eaves - (n + bottom) * picture_m;
        // Door in the middle of the front.
        const bool is_door = out.y < 0.0f && low_m < 2.2f && std::abs((k + 0.5f) * bay_m - 0.5f * wall_m) < 1.2f;
        if (!lit || is_door || low_m < least_over_ground_m) continue;
        for (const auto& [from, to] : panes) {
          const auto at = [&](float share_of_bay, float z) {
            return middle + begin + along * ((k + share_of_bay) * bay_m) + out * before_wall_m + glm::vec3(0, 0, z);
          };
          builder.patch(at(from, low_m), at(to, low_m), at(to, high_m), at(from, high_m));
        }
      }
  };
  const float l = length / 2, w = width / 2;
  wall({-l, -w, 0}, {1, 0, 0}, {0, -1, 0}, length);
  wall({l, -w, 0}, {0, 1, 0}, {1, 0, 0}, width);
  wall({l, w, 0}, {-1, 0, 0}, {0, 1, 0}, length);
  wall({-l, w, 0}, {0, -1, 0}, {-1, 0, 0}, width);
}

}  // namespace septet::scenery
