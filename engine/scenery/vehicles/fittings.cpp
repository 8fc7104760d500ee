#include "engine/scenery/vehicles/fittings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/car_lines.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_mirrors.hpp"
#include "engine/world/instrument_panel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// Dashboard from side to side, and how far below the eye the steering wheel lies before it.
struct Dashboard {
  float rear, front, top, right, left;
  float wheel_radius, wheel_lean_rad;
};

std::optional<Dashboard> dashboard_of(const VehicleModel& model) {
  const glm::vec3 eye(eye_in(model));
  const auto half = static_cast<float>(model.width_m / 2), front = static_cast<float>(model.front_m());
  switch (model.kind) {
    case ParticipantKind::car:
    case ParticipantKind::van:
    case ParticipantKind::ambulance: {
      const CarShape shape = car_shape(model);
      const float cowl = static_cast<float>(model.wheelbase_m) - shape.cowl_m, inner = 0.80f * half;
      const bool van = model.kind != ParticipantKind::car;
      return Dashboard{
          eye.x + 0.64f, cowl + 0.03f,       std::min(shape.hood_rear_m, shape.belt_front_m) - 0.02f, -inner, inner,
          0.185f,        van ? 0.75f : 0.42f};
    }
    case ParticipantKind::lorry:
      if (model.name == "farm-tractor") return Dashboard{0.46f, 0.72f, 1.70f, -0.26f, 0.26f, 0.20f, 0.7f};
      return Dashboard{eye.x + 0.52f, front - 0.1f, 1.70f, -half + 0.14f, half - 0.14f, 0.23f, 0.9f};
    case ParticipantKind::bus:
      return Dashboard{eye.x + 0.58f, front - 0.14f, eye.z - 0.72f, 0.02f, half - 0.14f, 0.24f, 1.05f};
    default:
      return std::nullopt;
  }
}

/// Rim and three spokes about x, which points away from the driver.
geometry::PolygonMesh plain_wheel(float radius) {
  constexpr int segments = 24;
  constexpr float tube_m = 0.014f, hub_m = 0.055f;
  MeshBuilder builder;
  builder.material = index_of(Finish::leather);
  const auto on_rim = [&](float share, float r) {
    const float angle = 2.0f * std::numbers::pi_v<float> * share;
    return glm::vec3(0.0f, r * std::sin(angle), r * std::cos(angle));
  };
  for (int i = 0; i < segments; ++i)
    add_limb(builder, on_rim(static_cast<float>(i) / segments, radius),
             on_rim(static_cast<float>(i + 1) / segments, radius), tube_m, tube_m, 6);
  builder.material = index_of(Finish::trim);
  add_blob(builder, {0.03f, 0.0f, 0.0f}, {0.03f, hub_m, hub_m}, 1);
  for (const float share : {0.25f, 0.5f, 0.75f})
    add_limb(builder, on_rim(share, 0.5f * hub_m) + glm::vec3(0.03f, 0, 0), on_rim(share, radius), 0.016f, 0.012f, 6);
  return builder.take();
}

/// Adds the box of the dashboard with the hood over its instruments.
void add_dashboard(MeshBuilder& builder, const Dashboard& dash, float driver_y) {
  constexpr float deep_m = 0.34f, hood_m = 0.045f, half_hood_m = 0.19f;
  add_box(builder, Finish::dashboard, {dash.rear, dash.right, dash.top - deep_m}, {dash.front, dash.left, dash.top},
          0.03f);
  add_box(builder, Finish::trim, {dash.rear + 0.02f, driver_y - half_hood_m, dash.top - 0.05f},
          {std::min(dash.front, dash.rear + 0.26f), driver_y + half_hood_m, dash.top + hood_m}, 0.02f);
}

/// Adds the slope from a car's or van's dashboard up to the bonnet at the windscreen's foot, past which daylight would
/// come in between the two.
void add_scuttle(MeshBuilder& builder, const VehicleModel& model, const Dashboard& dash) {
  constexpr int strips = 8;
  constexpr float deep_m = 0.3f, over_bonnet_m = 0.015f;
  constexpr std::uint32_t level = 1;
  const geometry::PolygonMesh body = shown_surface(car_body_cage(model, car_shape(model), level), level);
  const auto foot = [&](float y) {
    const auto bonnet = surface_point(body, Face::top, {dash.front, y});
    return glm::vec3(dash.front, y, bonnet ? bonnet->z + over_bonnet_m : dash.top);
  };
  builder.material = index_of(Finish::dashboard);
  for (int i = 0; i < strips; ++i) {
    const float right = std::lerp(dash.right, dash.left, static_cast<float>(i) / strips),
                left = std::lerp(dash.right, dash.left, static_cast<float>(i + 1) / strips), rear = dash.front - deep_m;
    builder.patch({rear, right, dash.top}, foot(right), foot(left), {rear, left, dash.top});
  }
}

/// Adds the glass, a piece of a sphere a little behind its place, where renderers that draw mirrors' pictures lay them;
/// and its housing.
void add_mirror(MeshBuilder& builder, const VehicleMirror& mirror) {
  constexpr int cells = 6;
  constexpr double behind_m = 0.004, lip_m = 0.012, deep_m = 0.045;
  const Vec3 up = mirror.up();
  const double half_m[2] = {0.5 * mirror.width_m, 0.5 * mirror.height_m};
  const auto sunk_m = [&](double across_m, double upward_m) {
    return mirror.radius_m > 0.0 ? (across_m * across_m + upward_m * upward_m) / (2.0 * mirror.radius_m) : 0.0;
  };
  const auto at = [&](double across_m, double upward_m, double back_m) {
    return glm::vec3(mirror.middle_m + across_m * mirror.right + upward_m * up - back_m * mirror.normal);
  };
  builder.material = index_of(Finish::mirror);
  std::array<std::array<std::uint32_t, cells + 1>, cells + 1> corners{};
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const double across_m = half_m[0] * (2.0 * i / cells - 1.0), upward_m = half_m[1] * (2.0 * j / cells - 1.0);
      corners[i][j] = builder.vertex(at(across_m, upward_m, behind_m + sunk_m(across_m, upward_m)));
    }
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      builder.quad(corners[i][j], corners[i + 1][j], corners[i + 1][j + 1], corners[i][j + 1]);
  builder.material = index_of(Finish::trim);
  const double rim_m = behind_m + sunk_m(half_m[0], half_m[1]) + 0.002;
  const auto ring = [&](double wider_m, double back_m, int corner) {
    const double x = corner == 0 || corner == 3 ? -1.0 : 1.0, y = corner < 2 ? -1.0 : 1.0;
    return at(x * (half_m[0] + wider_m), y * (half_m[1] + wider_m), back_m);
  };
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    builder.patch(ring(0.0, rim_m - 0.008, k), ring(lip_m, rim_m - 0.008, k), ring(lip_m, rim_m - 0.008, next),
                  ring(0.0, rim_m - 0.008, next));
    builder.patch(ring(lip_m, rim_m - 0.008, k), ring(-0.2 * half_m[1], rim_m + deep_m, k),
                  ring(-0.2 * half_m[1], rim_m + deep_m, next), ring(lip_m, rim_m - 0.008, next));
  }
  builder.patch(ring(-0.2 * half_m[1], rim_m + deep_m, 0), ring(-0.2 * half_m[1], rim_m + deep_m, 3),
                ring(-0.2 * half_m[1], rim_m + deep_m, 2), ring(-0.2 * half_m[1], rim_m + deep_m, 1));
}

/// Adds what a mirror hangs on or stands on.
void add_holder(MeshBuilder& builder, const VehicleModel& model, const VehicleMirror& mirror) {
  const glm::vec3 back(mirror.middle_m - 0.03 * mirror.normal);
  const float side = back.y > 0.0f ? 1.0f : -1.0f;
  builder.material = index_of(Finish::trim);
  if (model.kind == ParticipantKind::motorcycle)
    add_limb(builder, back, {1.12f, side * 0.27f, 1.03f}, 0.009f, 0.009f, 6);
  else if (model.name == "farm-tractor")
    add_limb(builder, back, {0.74f, side * 0.72f, 2.3f}, 0.014f, 0.014f, 6);
  else if (model.kind == ParticipantKind::bus)
    add_limb(builder, back, back + glm::vec3(-0.25f, 0.0f, 0.45f), 0.02f, 0.02f, 6);
  else if (std::abs(back.y) < 0.3f)
    add_limb(builder, back, back + glm::vec3(-0.03f, 0.0f, 0.09f), 0.009f, 0.012f, 6);
}

}  // namespace

std::optional<RigidTransform> dials_in(const VehicleModel& model) {
  const Vec3 eye(eye_in(model));
  Vec3 edge(0.0);  // Upper edge of the panel.
  if (const auto dash = dashboard_of(model))
    edge = {dash->rear + 0.018, eye.y, dash->top + 0.04};
  else if (model.kind == ParticipantKind::motorcycle && is_driven(model))
    edge = {1.15, 0.0, 1.15};
  else
    return std::nullopt;
  namespace panel = instrument_panel;
  const double own_rad = std::asin(panel::normal.z), steepest_rad = 0.9,
               tilt_rad = std::clamp(std::atan2(eye.z - edge.z, edge.x - eye.x), own_rad, steepest_rad);
  const Vec3 up(std::sin(tilt_rad), 0.0, std::cos(tilt_rad));
  const Quat turn = glm::angleAxis(tilt_rad - own_rad, Vec3(0.0, 1.0, 0.0));
  return RigidTransform{edge - 0.5 * panel::height_m * up - turn * panel::middle_m, turn};
}

VehicleParts fittings(const VehicleModel& model) {
  const glm::vec3 eye(eye_in(model));
  MeshBuilder builder;
  VehicleParts parts;
  if (const auto dash = dashboard_of(model)) {
    add_dashboard(builder, *dash, eye.y);
    if (has_car_lines(model)) add_scuttle(builder, model, *dash);
    Placement place;
    place.role = scene::PartRole::steering_wheel;
    place.parent_from_object = {Vec3(dash->rear - 0.10, eye.y, dash->top - 0.10),
                                orientation_from_angles(0.0, dash->wheel_lean_rad, 0.0)};
    parts.push_back({"steering wheel", plain_wheel(dash->wheel_radius), 0, {place}});
  }
  if (model.name == "farm-tractor") {
    builder.material = index_of(Finish::trim);
    const auto top = static_cast<float>(model.height_m) - 0.1f;
    for (const float x : {-0.72f, 0.72f})
      for (const float y : {-0.69f, 0.69f}) add_limb(builder, {x, y, 1.25f}, {x, y, top}, 0.035f, 0.035f, 8);
  }
  if (model.kind == ParticipantKind::motorcycle)
    add_box(builder, Finish::trim, {1.14f, -0.11f, 1.00f}, {1.22f, 0.11f, 1.10f}, 0.02f);
  for (const VehicleMirror& mirror : vehicle_mirrors(model)) {
    add_mirror(builder, mirror);
    add_holder(builder, model, mirror);
  }
  if (!builder.mesh().polygons.empty()) parts.push_back({"fittings", builder.take(), 0, {Placement{}}});
  for (VehiclePart& part : parts) set_detail(part, DetailLevel::near);
  return parts;
}

}  // namespace septet::scenery
