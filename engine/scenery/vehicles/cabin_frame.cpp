#include <array>
#include <cmath>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/cockpit_parts.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/world/windscreen.hpp"

namespace septet::scenery {

geometry::PolygonMesh cabin_frame() {
  using geometry::MeshBuilder;
  const glm::vec3 foot(windscreen::foot_left_m), head(windscreen::head_left_m);
  MeshBuilder builder;
  for (const float side : {1.0f, -1.0f}) {
    const auto on_side = [&](const glm::vec3& place) { return glm::vec3(place.x, side * place.y, place.z); };
    const glm::vec3 below = foot + (foot - head) * 0.12f, rear = head + glm::vec3(-1.0f, 0.02f, 0.03f);
    builder.material = index_of(CockpitFinish::lining);
    add_limb(builder, on_side(below), on_side(head), 0.040f, 0.036f, 8);
    // The roof's edge runs on above the side window.
    add_limb(builder, on_side(head), on_side(rear), 0.036f, 0.036f, 8);
    builder.material = index_of(CockpitFinish::panel);
    const glm::vec3 outer[] = {{1.0f, 0.80f, 0.2f}, {2.5f, 0.80f, 0.2f}, {2.5f, 0.80f, 0.93f}, {1.0f, 0.80f, 0.97f}};
    if (side > 0)
      builder.patch(on_side(outer[0]), on_side(outer[1]), on_side(outer[2]), on_side(outer[3]));
    else
      builder.patch(on_side(outer[1]), on_side(outer[0]), on_side(outer[3]), on_side(outer[2]));
    // The sill below the side window, on which an elbow would lie.
    builder.material = index_of(CockpitFinish::soft);
    add_limb(builder, on_side({1.0f, 0.785f, 0.965f}), on_side({2.32f, 0.785f, 0.935f}), 0.022f, 0.022f, 8);
  }
  // The roof before and above the driver, and two sun visors folded against it.
  builder.material = index_of(CockpitFinish::lining);
  const float y = head.y + 0.03f;
  builder.patch({head.x + 0.02f, y, head.z - 0.01f}, {head.x + 0.02f, -y, head.z - 0.01f},
                {head.x - 0.12f, -y, head.z + 0.005f}, {head.x - 0.12f, y, head.z + 0.005f});
  builder.patch({head.x - 0.12f, y, head.z + 0.005f}, {head.x - 0.12f, -y, head.z + 0.005f},
                {head.x - 1.1f, -y, head.z + 0.04f}, {head.x - 1.1f, y, head.z + 0.04f});
  for (const float side : {1.0f, -1.0f}) {
    const float from = side > 0 ? 0.13f : -0.47f, to = from + 0.34f;
    builder.append(
        geometry::box({head.x - 0.17f, from, head.z - 0.030f}, {head.x - 0.01f, to, head.z - 0.012f}, 0.006f),
        glm::mat4(1.0f), true);
  }
  return builder.take();
}

}  // namespace septet::scenery
