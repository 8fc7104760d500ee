#include <array>
#include <string>
#include <utility>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/lens.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/person.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/scenery/vehicles/wheel.hpp"
#include "engine/world/limbs.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

constexpr glm::vec3 hips{0.22f, 0.0f, 0.95f}, saddle{0.20f, 0.0f, 0.89f}, bars{0.86f, 0.0f, 1.00f};
constexpr glm::vec3 bottom_bracket{hips.x + static_cast<float>(bracket_ahead_m), 0.0f,
                                   hips.z - static_cast<float>(bracket_below_m)};

void add_frame(MeshBuilder& b, float wheelbase, float radius, std::uint32_t sides) {
  b.material = index_of(Finish::paint);
  const glm::vec3 head_low{0.86f, 0, 0.68f}, head_high{0.83f, 0, 0.88f}, seat{0.25f, 0, 0.76f};
  add_limb(b, head_low, bottom_bracket, 0.022f, 0.022f, sides);
  add_limb(b, bottom_bracket, seat, 0.018f, 0.018f, sides);
  add_limb(b, seat, head_high, 0.018f, 0.018f, sides);
  for (const float side : {1.0f, -1.0f}) {
    add_limb(b, bottom_bracket + glm::vec3(0, side * 0.04f, 0), {0, side * 0.06f, radius}, 0.012f, 0.01f, sides);
    add_limb(b, seat, {0, side * 0.06f, radius}, 0.01f, 0.01f, sides);
    add_limb(b, head_low, {wheelbase, side * 0.05f, radius}, 0.014f, 0.012f, sides);
  }
  b.material = index_of(Finish::trim);
  add_mudguard(b, {wheelbase, 0, radius}, {0.365f, 0.012f, 1.9f, 0.05f}, sides);
  add_mudguard(b, {0, 0, radius}, {0.355f, 0.012f, 1.3f, 3.1f}, sides);
  add_limb(b, head_high, bars, 0.016f, 0.016f, sides);
  add_limb(b, bars + glm::vec3(0, 0.28f, 0), bars - glm::vec3(0, 0.28f, 0), 0.014f, 0.014f, sides);
  add_limb(b, seat, saddle, 0.014f, 0.014f, sides);
  add_blob(b, saddle, {0.14f, 0.08f, 0.035f}, 0);
}

void add_trunk(MeshBuilder& b, std::uint32_t sides, std::uint32_t splits) {
  const glm::vec3 shoulders{0.50f, 0, 1.38f};
  b.material = index_of(Finish::cloth_bright);
  add_limb(b, hips + glm::vec3(0, 0, 0.04f), shoulders, 0.13f, 0.16f, sides + 2);
  for (const float side : {1.0f, -1.0f}) {
    add_limb(b, shoulders + glm::vec3(0, side * 0.17f, -0.03f), {0.68f, side * 0.26f, 1.20f}, 0.05f, 0.042f, sides);
    add_limb(b, {0.68f, side * 0.26f, 1.20f}, bars + glm::vec3(0, side * 0.26f, 0.02f), 0.042f, 0.034f, sides);
  }
  b.material = index_of(Finish::skin);
  if (splits > 0)
    for (const float side : {1.0f, -1.0f})  // Hands round the grips.
      add_blob(b, bars + glm::vec3(0.01f, side * 0.255f, 0.0f), {0.05f, 0.045f, 0.036f}, 1);
  add_limb(b, shoulders, {0.58f, 0, 1.50f}, 0.052f, 0.05f, sides);
  add_blob(b, {0.61f, 0, 1.59f}, {0.095f, 0.078f, 0.115f}, splits);
  b.material = index_of(Finish::white_panel);
  add_blob(b, {0.60f, 0, 1.65f}, {0.125f, 0.095f, 0.075f}, splits);
}

/// Both cranks with their pedals: the left one on top, as in pedalling_leg.
geometry::PolygonMesh cranks(std::uint32_t sides) {
  MeshBuilder b;
  b.material = index_of(Finish::trim);
  constexpr auto length = static_cast<float>(crank_m);
  for (const float side : {1.0f, -1.0f}) {
    add_limb(b, {0, side * 0.055f, 0}, {0, side * 0.06f, side * length}, 0.014f, 0.012f, sides);
    add_box(b, Finish::trim, {-0.05f, side > 0 ? 0.065f : -0.15f, side * length - 0.015f},
            {0.05f, side > 0 ? 0.15f : -0.065f, side * length + 0.015f});
  }
  return b.take();
}

}  // namespace

VehicleParts bicycle_parts(const VehicleModel& model) {
  VehicleParts parts;
  const bool ridden = model.name == "bicycle";
  const auto wheelbase = static_cast<float>(model.wheelbase_m), radius = static_cast<float>(model.wheel_radius_m);
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    MeshBuilder b;
    if (level == DetailLevel::far) {
      b.material = index_of(Finish::trim);
      add_limb(b, {0, 0, radius}, {wheelbase, 0, radius}, radius, radius, 3);
      if (ridden) {
        b.material = index_of(Finish::cloth_bright);
        add_limb(b, {0.22f, 0, 0.75f}, {0.50f, 0, 1.42f}, 0.16f, 0.17f, 4);
        b.material = index_of(Finish::skin);
        add_blob(b, {0.61f, 0, 1.64f}, {0.11f, 0.09f, 0.12f}, 0);
      }
    } else {
      const bool fine = level == DetailLevel::near;
      add_frame(b, wheelbase, radius, fine ? 6 : 3);
      if (ridden) add_trunk(b, fine ? 8 : 4, fine ? 2 : 0);
    }
    VehicleParts of_level{{"rider", b.take(), 0, {Placement{}}}};
    if (level != DetailLevel::far) {
      const std::uint32_t sides = level == DetailLevel::near ? 8 : 3;
      if (ridden) add_pedalling_legs(of_level, hips, sides);
      Placement place;
      place.parent_from_object.position_m = Vec3(bottom_bracket);
      place.role = scene::PartRole::crank;
      of_level.push_back({"crank", cranks(level == DetailLevel::near ? 6 : 3), 0, {place}});
    }
    of_level.push_back(
        lens_plate("lamp head", scene::PartRole::lamp_head, Finish::lens_head, true, {0.95f, 0, 0.9f}, {0.06f, 0.06f}));
    of_level.push_back(lens_plate("lamp tail", scene::PartRole::lamp_tail, Finish::lens_tail, false, {-0.30f, 0, 0.72f},
                                  {0.05f, 0.05f}));
    add_level(parts, std::move(of_level), level);
  }
  for (const bool front : {true, false}) {
    VehicleParts pair;
    add_axle(pair, {radius, 0.04f, 9}, front ? wheelbase : 0.0f, 0.0f, front);
    for (VehiclePart& part : pair)
      if (part.name.starts_with("wheel left")) {
        part.name += front ? " front" : " rear";
        parts.push_back(std::move(part));
      }
  }
  return parts;
}

}  // namespace septet::scenery
