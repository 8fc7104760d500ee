#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/scenery/vehicles/wheel.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using scene::PartRole;

void add_machine(MeshBuilder& b, float wheelbase, std::uint32_t sides, std::uint32_t splits) {
  b.material = index_of(Finish::paint);
  add_blob(b, {0.82f, 0, 0.86f}, {0.30f, 0.15f, 0.14f}, splits);   // Tank.
  add_blob(b, {1.32f, 0, 0.86f}, {0.25f, 0.15f, 0.21f}, splits);   // Fairing.
  add_blob(b, {-0.06f, 0, 0.84f}, {0.29f, 0.11f, 0.08f}, splits);  // Tail.
  b.material = index_of(Finish::trim);
  add_blob(b, {0.28f, 0, 0.80f}, {0.36f, 0.14f, 0.07f}, splits);  // Seat.
  add_blob(b, {0.72f, 0, 0.46f}, {0.32f, 0.17f, 0.20f}, splits);  // Engine.
  b.material = index_of(Finish::chrome);
  for (const float side : {1.0f, -1.0f}) {
    add_limb(b, {wheelbase, side * 0.10f, 0.31f}, {wheelbase - 0.30f, side * 0.10f, 0.92f}, 0.028f, 0.032f, sides);
    add_limb(b, {0.0f, side * 0.09f, 0.31f}, {0.48f, side * 0.09f, 0.42f}, 0.030f, 0.030f, sides);
  }
  add_limb(b, {0.62f, -0.17f, 0.26f}, {-0.18f, -0.20f, 0.40f}, 0.035f, 0.055f, sides);
  b.material = index_of(Finish::trim);
  add_mudguard(b, {wheelbase, 0, 0.31f}, {0.33f, 0.02f, 1.9f, 0.1f}, sides);
  add_limb(b, {1.12f, 0.39f, 1.02f}, {1.12f, -0.39f, 1.02f}, 0.018f, 0.018f, sides);
}

void add_rider(MeshBuilder& b, std::uint32_t sides, std::uint32_t splits) {
  b.material = index_of(Finish::leather);
  for (const float side : {1.0f, -1.0f}) {
    add_limb(b, {0.30f, side * 0.12f, 0.88f}, {0.74f, side * 0.20f, 0.72f}, 0.095f, 0.070f, sides);
    add_limb(b, {0.74f, side * 0.20f, 0.72f}, {0.46f, side * 0.19f, 0.32f}, 0.070f, 0.055f, sides);
    add_limb(b, {0.56f, side * 0.20f, 1.18f}, {0.82f, side * 0.30f, 1.04f}, 0.062f, 0.052f, sides);
    add_limb(b, {0.82f, side * 0.30f, 1.04f}, {1.10f, side * 0.29f, 1.04f}, 0.052f, 0.042f, sides);
    if (splits > 0) add_blob(b, {1.125f, side * 0.30f, 1.025f}, {0.055f, 0.055f, 0.042f}, 1);  // Gloves.
  }
  b.material = index_of(Finish::cloth_bright);
  add_limb(b, {0.27f, 0, 0.90f}, {0.48f, 0, 1.16f}, 0.15f, 0.17f, sides + 2);
  // The helmet stands clear of the shoulders: a rider is recognised by the head.
  add_limb(b, {0.52f, 0, 1.22f}, {0.60f, 0, 1.32f}, 0.075f, 0.07f, sides);
  b.material = index_of(Finish::white_panel);
  add_blob(b, {0.64f, 0, 1.40f}, {0.145f, 0.125f, 0.135f}, splits);
  b.material = index_of(Finish::glass);
  add_blob(b, {0.685f, 0, 1.405f}, {0.11f, 0.108f, 0.062f}, splits);
}

VehiclePart lamp(const char* name, PartRole role, Finish finish, const glm::vec3& centre, const glm::vec3& radii) {
  MeshBuilder b;
  b.material = index_of(finish);
  add_blob(b, centre, radii, 0);
  Placement place;
  place.role = role;
  place.casts_shadow = false;
  return {name, b.take(), 0, {place}};
}

}  // namespace

VehicleParts motorcycle_parts(const VehicleModel& model) {
  VehicleParts parts;
  const bool ridden = model.name == "motorcycle";
  const auto wheelbase = static_cast<float>(model.wheelbase_m);
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle, DetailLevel::far}) {
    const char* suffix = level == DetailLevel::near ? " near" : level == DetailLevel::middle ? " middle" : " far";
    MeshBuilder b;
    VehicleParts of_level;
    if (level == DetailLevel::far) {
      b.material = index_of(Finish::paint);
      add_blob(b, {0.75f, 0, 0.65f}, {0.75f, 0.17f, 0.28f}, 0);
      if (ridden) {
        b.material = index_of(Finish::cloth_bright);
        add_limb(b, {0.30f, 0, 0.9f}, {0.50f, 0, 1.16f}, 0.18f, 0.16f, 4);
        b.material = index_of(Finish::white_panel);
        add_blob(b, {0.64f, 0, 1.40f}, {0.145f, 0.125f, 0.135f}, 0);
      }
      b.material = index_of(Finish::tyre);
      for (const float x : {0.0f, wheelbase}) add_blob(b, {x, 0, 0.31f}, {0.31f, 0.06f, 0.31f}, 0);
    } else {
      const bool fine = level == DetailLevel::near;
      add_machine(b, wheelbase, fine ? 8 : 4, fine ? 2 : 0);
      if (ridden) add_rider(b, fine ? 8 : 4, fine ? 2 : 0);
    }
    of_level.push_back({"machine", b.take(), 0, {Placement{}}});
    of_level.push_back(
        lamp("lamp head", PartRole::lamp_head, Finish::lens_head, {1.52f, 0, 0.88f}, {0.05f, 0.09f, 0.07f}));
    of_level.push_back(
        lamp("lamp tail", PartRole::lamp_tail, Finish::lens_tail, {-0.33f, 0, 0.84f}, {0.03f, 0.06f, 0.03f}));
    if (level != DetailLevel::far) {
      of_level.push_back(
          lamp("lamp brake", PartRole::lamp_brake, Finish::lens_brake, {-0.33f, 0, 0.78f}, {0.03f, 0.07f, 0.03f}));
      of_level.push_back(lamp("lamp indicator left", PartRole::lamp_indicator_left, Finish::lens_indicator,
                              {-0.26f, 0.15f, 0.80f}, {0.03f, 0.03f, 0.03f}));
      of_level.push_back(lamp("lamp indicator right", PartRole::lamp_indicator_right, Finish::lens_indicator,
                              {-0.26f, -0.15f, 0.80f}, {0.03f, 0.03f, 0.03f}));
    }
    for (VehiclePart& p : of_level) {
      p.name += suffix;
      set_detail(p, level);
      parts.push_back(std::move(p));
    }
  }
  // One wheel at each end: the left-hand roles carry them.
  for (const bool front : {true, false}) {
    VehicleParts pair;
    add_axle(pair, {static_cast<float>(model.wheel_radius_m), 0.13f, 3}, front ? wheelbase : 0.0f, 0.0f, front);
    for (VehiclePart& p : pair)
      if (p.name.starts_with("wheel left")) {
        p.name += front ? " front" : " rear";
        parts.push_back(std::move(p));
      }
  }
  return parts;
}

}  // namespace septet::scenery
