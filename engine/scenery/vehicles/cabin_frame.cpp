#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/cockpit_parts.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/world/windscreen.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

const glm::vec3 foot(windscreen::foot_left_m), head(windscreen::head_left_m);
/// End of the roof above the rear window, and that window's foot.
const glm::vec3 roof_end{0.05f, 0.60f, 1.40f}, rear_foot{-0.62f, 0.70f, 0.97f};
constexpr float floor_z = 0.30f, belt_z = 0.95f, door_y = 0.80f, bulkhead_x = 2.50f;

/// Path from below the windscreen's foot up along its edge and back along the roof's, on the left: right is towards the
/// car's middle, up into the cabin.
std::vector<geometry::PathFrame> edge_of_roof() {
  const std::array<glm::vec3, 4> places{foot + (foot - head) * 0.12f, foot, head, roof_end};
  std::vector<geometry::PathFrame> path;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::vec3 along = glm::normalize(places[std::min(i + 1, places.size() - 1)] - places[i > 0 ? i - 1 : 0]);
    const glm::vec3 inward(0.0f, -1.0f, 0.0f);
    const glm::vec3 right = glm::normalize(inward - glm::dot(inward, along) * along);
    path.push_back({places[i], right, glm::cross(right, along)});
  }
  return path;
}

/// Adds a bar of flat faces along the roof's edge.
void add_sweep(MeshBuilder& builder, CockpitFinish finish, std::span<const glm::vec2> profile) {
  builder.material = index_of(finish);
  builder.append(geometry::extrude(profile, edge_of_roof(), true), glm::mat4(1.0f), true);
}

/// Adds the left pillar and the roof's edge, which are one: the trim inside, the windscreen's seal on one side of it,
/// the door's frame with its own seal on the other.
void add_pillar(MeshBuilder& builder) {
  constexpr std::array<glm::vec2, 6> trim{{{-0.026f, -0.018f},
                                           {0.028f, -0.018f},
                                           {0.030f, -0.006f},
                                           {0.016f, 0.026f},
                                           {-0.014f, 0.030f},
                                           {-0.026f, 0.018f}}};
  constexpr std::array<glm::vec2, 4> screen_seal{
      {{0.026f, -0.018f}, {0.040f, -0.018f}, {0.038f, -0.010f}, {0.028f, -0.008f}}};
  constexpr std::array<glm::vec2, 4> door_seal{
      {{-0.034f, -0.016f}, {-0.024f, -0.016f}, {-0.024f, 0.012f}, {-0.034f, 0.008f}}};
  constexpr std::array<glm::vec2, 5> door_frame{
      {{-0.060f, -0.020f}, {-0.032f, -0.020f}, {-0.032f, 0.014f}, {-0.040f, 0.020f}, {-0.060f, 0.010f}}};
  constexpr std::array<glm::vec2, 4> glass_seal{
      {{-0.070f, -0.014f}, {-0.058f, -0.014f}, {-0.058f, 0.002f}, {-0.070f, -0.004f}}};
  add_sweep(builder, CockpitFinish::lining, trim);
  add_sweep(builder, CockpitFinish::rubber, screen_seal);
  add_sweep(builder, CockpitFinish::rubber, door_seal);
  add_sweep(builder, CockpitFinish::panel, door_frame);
  add_sweep(builder, CockpitFinish::rubber, glass_seal);
}

/// Adds the left side of the cabin: doors below their windows, pillars between and behind them.
void add_side(MeshBuilder& builder) {
  builder.material = index_of(CockpitFinish::panel);
  builder.patch({rear_foot.x, door_y, floor_z}, {bulkhead_x, door_y, floor_z}, {bulkhead_x, door_y, 0.93f},
                {rear_foot.x, door_y, 0.97f});
  // The sill below the side window, on which an elbow would lie.
  builder.material = index_of(CockpitFinish::soft);
  add_limb(builder, {rear_foot.x, 0.785f, 0.965f}, {2.32f, 0.785f, 0.935f}, 0.022f, 0.022f, 8);
  builder.material = index_of(CockpitFinish::lining);
  const float roof_y = 0.605f, roof_z = 1.41f;
  builder.patch({0.86f, 0.785f, belt_z}, {0.98f, 0.785f, belt_z}, {0.94f, roof_y, roof_z}, {0.84f, roof_y, roof_z});
  builder.patch({rear_foot.x, 0.79f, belt_z}, {-0.20f, 0.785f, belt_z}, roof_end + glm::vec3(0.10f, 0.0f, 0.0f),
                roof_end);
}

}  // namespace

geometry::PolygonMesh cabin_frame() {
  MeshBuilder builder;
  MeshBuilder left;
  add_pillar(left);
  add_side(left);
  builder.append(left.mesh());
  builder.append(geometry::mirrored_y(left.mesh()));
  // Roof before and above the driver, and two sun visors folded against it.
  builder.material = index_of(CockpitFinish::lining);
  const float y = head.y + 0.03f;
  builder.patch({head.x + 0.02f, y, head.z - 0.01f}, {head.x + 0.02f, -y, head.z - 0.01f},
                {head.x - 0.12f, -y, head.z + 0.005f}, {head.x - 0.12f, y, head.z + 0.005f});
  builder.patch({head.x - 0.12f, y, head.z + 0.005f}, {head.x - 0.12f, -y, head.z + 0.005f},
                {head.x - 1.1f, -y, head.z + 0.04f}, {head.x - 1.1f, y, head.z + 0.04f});
  builder.patch({head.x - 1.1f, y, head.z + 0.04f}, {head.x - 1.1f, -y, head.z + 0.04f},
                {roof_end.x, -y, roof_end.z + 0.03f}, {roof_end.x, y, roof_end.z + 0.03f});
  for (const float side : {1.0f, -1.0f}) {
    const float from = side > 0 ? 0.13f : -0.47f, to = from + 0.34f;
    builder.append(
        geometry::box({head.x - 0.17f, from, head.z - 0.030f}, {head.x - 0.01f, to, head.z - 0.012f}, 0.006f),
        glm::mat4(1.0f), true);
  }
  // Floor, bulkheads and the shelf below the rear window: light comes in through the windows alone.
  builder.material = index_of(CockpitFinish::carpet);
  const float x = rear_foot.x;
  builder.patch({x, door_y, floor_z}, {x, -door_y, floor_z}, {bulkhead_x, -door_y, floor_z},
                {bulkhead_x, door_y, floor_z});
  builder.patch({bulkhead_x, door_y, floor_z}, {bulkhead_x, -door_y, floor_z}, {bulkhead_x, -door_y, 0.91f},
                {bulkhead_x, door_y, 0.91f});
  builder.patch({x, -door_y, floor_z}, {x, door_y, floor_z}, {x, door_y, belt_z}, {x, -door_y, belt_z});
  builder.patch({x, door_y, belt_z}, {x, -door_y, belt_z}, {x + 0.5f, -door_y, belt_z - 0.02f},
                {x + 0.5f, door_y, belt_z - 0.02f});
  return builder.take();
}

}  // namespace septet::scenery
