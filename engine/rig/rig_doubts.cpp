#include "engine/rig/rig_doubts.hpp"

#include <string>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace septet::rig {

std::vector<Error> doubts_of(const Rig& rig, std::string_view file) {
  std::vector<Error> doubts;
  for (const Screen& screen : rig.screens) {
    const Window& window = screen.views.front().window;
    const Vec3 right = window.lower_right_m - window.lower_left_m, up = window.upper_left_m - window.lower_left_m;
    const Vec3 front = glm::cross(right, up);
    if (glm::dot(rig.eye_point_m - window.lower_left_m, front) <= 0.0)
      doubts.push_back({fmt::format("the screen {} shows its back to the eye point", screen.name), std::string(file),
                        "give its left and right corners as the driver sees them, turned to the screen"});
    else if (up.z < 0.0)
      doubts.push_back({fmt::format("the upper edge of the screen {} lies below its lower edge", screen.name),
                        std::string(file),
                        "exchange upper_left_m and lower_left_m, unless its monitor or projector stands on its head"});
  }
  return doubts;
}

}  // namespace septet::rig
