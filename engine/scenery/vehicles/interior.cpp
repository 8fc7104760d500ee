#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/world/windscreen.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// The bonnet: what of the body's shown surface lies before the windscreen and looks up.
geometry::PolygonMesh bonnet(const VehicleModel& model) {
  const CarShape shape = car_shape(model);
  const geometry::PolygonMesh body = shown_surface(car_body_cage(model, shape, 1), 1);
  const auto cowl = static_cast<float>(model.wheelbase_m) - shape.cowl_m;
  MeshBuilder builder;
  builder.material = index_of(Finish::paint);
  for (const glm::vec3& p : body.vertices_m) builder.vertex(p);
  for (const auto& corners : body.polygons) {
    const glm::vec3 middle = (body.vertices_m[corners[0]] + body.vertices_m[corners[2]]) * 0.5f;
    const glm::vec3 area = glm::cross(body.vertices_m[corners[2]] - body.vertices_m[corners[0]],
                                      body.vertices_m[corners[3]] - body.vertices_m[corners[1]]);
    const bool ahead = middle.x > cowl - 0.08f && middle.z > 0.5f && middle.z < shape.hood_rear_m + 0.02f &&
                       area.z > 0.35f * glm::length(area);
    if (ahead) builder.quad(corners[0], corners[1], corners[2], corners[3]);
  }
  return builder.take();
}

/// A swept sheet across the car: dashboard top, rounded towards the driver, with a cowl over the
/// instruments.
geometry::PolygonMesh dashboard() {
  MeshBuilder builder;
  builder.material = index_of(Finish::cabin);
  // Profile from the scuttle under the bonnet's edge back and down, in (x, z).
  constexpr std::array<glm::vec2, 7> profile{{{2.66f, 0.908f},
                                              {2.34f, 0.915f},
                                              {1.98f, 0.945f},
                                              {1.83f, 0.935f},
                                              {1.77f, 0.90f},
                                              {1.76f, 0.84f},
                                              {1.80f, 0.66f}}};
  constexpr int columns = 18;
  for (int i = 0; i <= columns; ++i) {
    const float y = std::lerp(0.76f, -0.76f, static_cast<float>(i) / columns);
    const float hood = std::exp(-std::pow((y - 0.37f) / 0.19f, 4.0f));
    for (std::size_t k = 0; k < profile.size(); ++k) {
      const float raise = k == 3 ? 0.040f : k == 4 ? 0.055f : k == 2 ? 0.015f : 0.0f;
      builder.vertex({profile[k].x - (k == 4 ? 0.05f : 0.0f) * hood, y, profile[k].y + raise * hood});
    }
  }
  const auto count = static_cast<std::uint32_t>(profile.size());
  for (std::uint32_t i = 0; i < columns; ++i)
    for (std::uint32_t k = 0; k + 1 < count; ++k)
      builder.quad(i * count + k, i * count + k + 1, (i + 1) * count + k + 1, (i + 1) * count + k);
  return builder.take();
}

geometry::PolygonMesh steering_wheel() {
  MeshBuilder builder;
  builder.material = index_of(Finish::leather);
  constexpr int around = 28;
  constexpr float radius = 0.187f;
  // The wheel turns about x: its rim lies in the (y, z) plane.
  const auto on_rim = [&](int i) {
    const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / around;
    return glm::vec3(0, radius * std::cos(a), radius * std::sin(a));
  };
  std::array<glm::vec2, 7> section{};
  std::vector<geometry::PathFrame> path;
  for (std::size_t k = 0; k < section.size(); ++k) {
    const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(section.size());
    section[k] = {0.016f * std::cos(a), 0.016f * std::sin(a)};
  }
  for (int i = 0; i <= around; ++i) {
    const glm::vec3 p = on_rim(i), out = p / radius;
    path.push_back({p, out, glm::vec3(1, 0, 0), 0.0f});
  }
  builder.append(geometry::extrude(section, path, true), glm::mat4(1.0f), true);
  builder.material = index_of(Finish::cabin);
  for (const float angle : {0.12f, std::numbers::pi_v<float> - 0.12f, 1.5f * std::numbers::pi_v<float>})
    add_limb(builder, {0.03f, 0, 0}, {0, 0.97f * radius * std::cos(angle), 0.97f * radius * std::sin(angle)}, 0.026f,
             0.016f, 6);
  add_blob(builder, {0.035f, 0, -0.005f}, {0.03f, 0.075f, 0.062f}, 2);
  return builder.take();
}

}  // namespace

VehicleParts interior_parts() {
  const VehicleModel& model = vehicle_models()[*find_vehicle_model("volvo-s80")];
  VehicleParts parts;
  parts.push_back({"bonnet", bonnet(model), 0, {Placement{}}});
  parts.push_back({"dashboard", dashboard(), 0, {Placement{}}});
  MeshBuilder pillars;
  pillars.material = index_of(Finish::cabin);
  for (const float side : {1.0f, -1.0f}) {
    using namespace windscreen;
    const glm::vec3 foot(foot_left_m), head(head_left_m);
    add_limb(pillars, {foot.x, side * foot.y, foot.z}, {head.x, side * head.y, head.z}, 0.045f, 0.04f, 8);
  }
  // The doors below their windows, and the scuttle's ends.
  pillars.patch({1.4f, 0.80f, 0.2f}, {2.66f, 0.80f, 0.2f}, {2.66f, 0.80f, 0.93f}, {1.4f, 0.80f, 0.99f});
  pillars.patch({2.66f, -0.80f, 0.2f}, {1.4f, -0.80f, 0.2f}, {1.4f, -0.80f, 0.99f}, {2.66f, -0.80f, 0.93f});
  parts.push_back({"pillars", pillars.take(), 0, {Placement{}}});
  Placement wheel;
  wheel.role = scene::PartRole::steering_wheel;
  // The column leans back by 25°; +x of the wheel points along it, away from the driver.
  wheel.parent_from_object = {Vec3(1.58, 0.37, 0.80), orientation_from_angles(0.0, 0.42, 0.0)};
  parts.push_back({"steering wheel", steering_wheel(), 0, {wheel}});
  for (VehiclePart& part : parts)
    for (Placement& place : part.places) {
      place.visible_to_m = 10.0f;
      place.casts_shadow = false;
    }
  return parts;
}

}  // namespace septet::scenery
