#include "engine/scenery/vehicles/limb.hpp"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/shapes.hpp"

namespace septet::scenery {

void add_limb(geometry::MeshBuilder& builder, const glm::vec3& a, const glm::vec3& b, float ra, float rb,
              std::uint32_t sides) {
  const float length = glm::distance(a, b);
  const glm::vec3 along = (b - a) / length;
  const glm::vec3 helper = std::abs(along.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(helper, along)), y = glm::cross(along, x);
  const std::array<geometry::LathePoint, 4> profile{
      {{0, -0.7f * ra}, {ra, 0.1f * ra}, {rb, length - 0.1f * rb}, {0, length + 0.7f * rb}}};
  const glm::mat4 frame(glm::vec4(x, 0), glm::vec4(y, 0), glm::vec4(along, 0), glm::vec4(a, 1));
  builder.append(geometry::lathe(profile, sides), frame, true);
}

void add_blob(geometry::MeshBuilder& builder, const glm::vec3& centre, const glm::vec3& radii, std::uint32_t splits) {
  builder.append(geometry::icosphere(splits), glm::scale(glm::translate(glm::mat4(1.0f), centre), radii), true);
}

void add_mudguard(geometry::MeshBuilder& builder, const glm::vec3& hub, const Arc& arc, std::uint32_t sides) {
  const int bars = sides > 4 ? 5 : 2;
  const auto at = [&](int i) {
    const float angle = std::lerp(arc.from_rad, arc.to_rad, static_cast<float>(i) / static_cast<float>(bars));
    return hub + arc.radius_m * glm::vec3(std::cos(angle), 0.0f, std::sin(angle));
  };
  for (int i = 0; i < bars; ++i) add_limb(builder, at(i), at(i + 1), arc.tube_m, arc.tube_m, sides);
}

void add_box(geometry::MeshBuilder& builder, Finish finish, const glm::vec3& low, const glm::vec3& high,
             float bevel_m) {
  builder.material = index_of(finish);
  builder.append(geometry::box(low, high, bevel_m), glm::mat4(1.0f), true);
}

}  // namespace septet::scenery
