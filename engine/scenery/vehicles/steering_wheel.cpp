#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/cockpit_parts.hpp"
#include "engine/scenery/vehicles/limb.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

constexpr float radius_m = 0.187f, rim_m = 0.0155f, pi = std::numbers::pi_v<float>;

glm::vec3 on_rim(float angle_rad) { return {0, radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad)}; }

/// Adds one hand around the rim at `angle_rad` (from y over z), its arm towards `elbow`.
void add_hand(MeshBuilder& builder, float angle_rad, const glm::vec3& elbow) {
  const glm::vec3 at = on_rim(angle_rad), out = at / radius_m;
  const glm::vec3 along(0, -out.z, out.y);
  builder.material = index_of(CockpitFinish::skin);
  constexpr float toward = -0.018f;  // Driver's side of the rim.
  const glm::vec3 palm = at + out * 0.012f + glm::vec3(toward, 0, 0);
  for (int finger = 0; finger < 4; ++finger) {
    const glm::vec3 root = palm + along * (0.021f * (static_cast<float>(finger) - 1.5f)) + out * 0.014f;
    const glm::vec3 knuckle = root + glm::vec3(0.030f, 0, 0) + out * 0.006f;
    add_limb(builder, root, knuckle, 0.0105f, 0.0098f, 6);
    add_limb(builder, knuckle, knuckle + glm::vec3(0.014f, 0, 0) - out * 0.026f, 0.0095f, 0.0085f, 6);
  }
  const float inward = out.y > 0 ? 1.0f : -1.0f;
  add_limb(builder, palm - along * (inward * 0.034f), palm - along * (inward * 0.012f) - out * 0.040f, 0.0125f, 0.0105f,
           6);
  const glm::vec3 wrist = palm + glm::normalize(elbow - palm) * 0.075f;
  add_limb(builder, palm + out * 0.004f, wrist, 0.034f, 0.026f, 10);
  builder.material = index_of(CockpitFinish::cloth);
  add_limb(builder, wrist, elbow, 0.034f, 0.048f, 10);
}

}  // namespace

geometry::PolygonMesh steering_wheel() {
  MeshBuilder builder;
  builder.material = index_of(CockpitFinish::leather);
  constexpr int around = 40;
  std::array<glm::vec2, 8> section{};
  for (std::size_t k = 0; k < section.size(); ++k) {
    const float a = 2 * pi * static_cast<float>(k) / static_cast<float>(section.size());
    section[k] = {rim_m * std::cos(a), rim_m * std::sin(a)};
  }
  std::vector<geometry::PathFrame> path;
  for (int i = 0; i <= around; ++i) {
    const glm::vec3 p = on_rim(2 * pi * static_cast<float>(i) / around);
    path.push_back({p, p / radius_m, glm::vec3(1, 0, 0), 0.0f});
  }
  builder.append(geometry::extrude(section, path, true), glm::mat4(1.0f), true);
  // Mark at the top when the wheel is straight.
  builder.material = index_of(CockpitFinish::metal);
  add_blob(builder, on_rim(0.5f * pi) + glm::vec3(-0.008f, 0, 0), {0.011f, 0.006f, 0.0115f}, 1);
  for (const float angle : {0.12f, pi - 0.12f, 1.5f * pi})
    add_limb(builder, {0.03f, 0, 0}, on_rim(angle) * 0.97f, 0.026f, 0.016f, 6);
  builder.material = index_of(CockpitFinish::soft);
  add_blob(builder, {0.032f, 0, -0.005f}, {0.03f, 0.078f, 0.064f}, 2);
  return builder.take();
}

geometry::PolygonMesh hands() {
  MeshBuilder builder;
  add_hand(builder, 0.27f * pi, {-0.25f, 0.20f, -0.16f});
  add_hand(builder, 0.73f * pi, {-0.25f, -0.20f, -0.16f});
  return builder.take();
}

}  // namespace septet::scenery
