#include <array>
#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/cockpit_parts.hpp"
#include "engine/world/instrument_panel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// Profiles from under the bonnet's edge back to the driver and down, in (x, z): beside the instruments, and before
/// them.
constexpr std::array<glm::vec2, 10> beside{{{2.66f, 0.905f},
                                            {2.34f, 0.918f},
                                            {2.08f, 0.940f},
                                            {1.97f, 0.947f},
                                            {1.90f, 0.943f},
                                            {1.865f, 0.928f},
                                            {1.85f, 0.905f},
                                            {1.845f, 0.86f},
                                            {1.85f, 0.78f},
                                            {1.88f, 0.60f}}};
constexpr std::array<glm::vec2, 10> over_instruments{{{2.66f, 0.905f},
                                                      {2.34f, 0.935f},
                                                      {2.10f, 1.020f},
                                                      {2.00f, 1.040f},
                                                      {1.925f, 1.041f},
                                                      {1.918f, 1.034f},
                                                      {1.975f, 1.026f},
                                                      {1.929f, 0.908f},
                                                      {1.87f, 0.86f},
                                                      {1.88f, 0.60f}}};

/// Share of the hood's height at `y`.
float hood(float y) {
  return glm::smoothstep(0.205f, 0.165f, std::abs(y - static_cast<float>(instrument_panel::middle_m.y)));
}

void add_box(MeshBuilder& builder, CockpitFinish finish, const glm::vec3& min_m, const glm::vec3& max_m,
             float bevel_m) {
  builder.material = index_of(finish);
  builder.append(geometry::box(min_m, max_m, bevel_m), glm::mat4(1.0f), true);
}

/// Adds a vent with its slats, in the dashboard's front.
void add_vent(MeshBuilder& builder, float y) {
  add_box(builder, CockpitFinish::metal, {1.832f, y - 0.062f, 0.846f}, {1.86f, y + 0.062f, 0.914f}, 0.006f);
  add_box(builder, CockpitFinish::gloss, {1.828f, y - 0.055f, 0.852f}, {1.86f, y + 0.055f, 0.908f}, 0.003f);
  for (int i = 0; i < 3; ++i) {
    const float z = 0.864f + 0.016f * static_cast<float>(i);
    add_box(builder, CockpitFinish::panel, {1.824f, y - 0.053f, z}, {1.85f, y + 0.053f, z + 0.004f}, 0.0f);
  }
}

}  // namespace

geometry::PolygonMesh dashboard() {
  MeshBuilder builder;
  constexpr int columns = 44;
  constexpr auto count = static_cast<std::uint32_t>(beside.size());
  for (int i = 0; i <= columns; ++i) {
    const float y = std::lerp(0.78f, -0.78f, static_cast<float>(i) / columns), raised = hood(y);
    for (std::size_t k = 0; k < count; ++k) {
      const glm::vec2 at = glm::mix(beside[k], over_instruments[k], raised);
      builder.vertex({at.x, y, at.y});
    }
  }
  for (std::uint32_t i = 0; i < columns; ++i)
    for (std::uint32_t k = 0; k + 1 < count; ++k) {
      builder.material = index_of(k < 6 ? CockpitFinish::soft : CockpitFinish::panel);
      builder.quad(i * count + k, i * count + k + 1, (i + 1) * count + k + 1, (i + 1) * count + k);
    }
  for (const float y : {0.66f, 0.06f, -0.08f, -0.66f}) add_vent(builder, y);
  // Console in the middle: a display, and knobs below it.
  add_box(builder, CockpitFinish::soft, {1.80f, -0.13f, 0.45f}, {1.88f, 0.11f, 0.835f}, 0.012f);
  add_box(builder, CockpitFinish::gloss, {1.793f, -0.11f, 0.715f}, {1.83f, 0.09f, 0.82f}, 0.004f);
  for (const float y : {0.055f, -0.075f})
    add_box(builder, CockpitFinish::metal, {1.775f, y - 0.017f, 0.665f}, {1.81f, y + 0.017f, 0.699f}, 0.008f);
  // Strip along the passenger's side, and the lid below it.
  add_box(builder, CockpitFinish::metal, {1.838f, -0.58f, 0.826f}, {1.85f, -0.16f, 0.834f}, 0.002f);
  return builder.take();
}

geometry::PolygonMesh instrument_faces() {
  using namespace instrument_panel;
  MeshBuilder builder;
  builder.material = index_of(CockpitFinish::dial_faces);
  const auto corner = [](double across, double upward) {
    return glm::vec3(middle_m + 0.5 * (across * width_m * right + upward * height_m * up) + 0.001 * normal);
  };
  builder.patch(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
  return builder.take();
}

}  // namespace septet::scenery
