#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/lens.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

bool is_police(const VehicleModel& model) { return model.name == "police-car" || model.name == "police-van"; }

/// Adds lamps on the roof at x, one to the left and one to the right, between these distances from the middle.
void add_bar(VehicleParts& parts, const CarSurface& car, float x, float inner, float outer, float high) {
  const bool far = car.level == DetailLevel::far;
  if (far) inner = 0.0f;
  // Height of the lowest point under it, into which it reaches a little, so that it never floats.
  float roof = car.height_m();
  for (const float at_x : {x - 0.11f, x + 0.11f})
    for (const float y : {inner, outer})
      if (const auto point = surface_point(car.body, Face::top, {at_x, y})) roof = std::min(roof, point->z);
  for (const float side : {1.0f, -1.0f})
    parts.push_back(beacon_box({x, side * 0.5f * (inner + outer), roof + 0.5f * high - 0.01f},
                               {0.22f, outer - inner, high + 0.02f}));
}

/// Draws a band of two rows on both sides, in pieces of four pairs: as many as keep the chequers square.
void draw_chequers(MeshBuilder& builder, const CarSurface& car, float rear, float front, float low, float high) {
  builder.material = index_of(Finish::chequers);
  const float pieces = std::max(1.0f, std::round((front - rear) / ((high - low) * 4.0f)));
  const float length = (front - rear) / pieces;
  for (float k = 0.0f; k < pieces; k += 1.0f) {
    const float x = front - k * length, end = x - length;
    draw_patch_on_both_sides(builder, car.body, {{{{x, low}, {end, low}, {end, high}, {x, high}}}}, {0.014f, 0.0f});
  }
}

geometry::PolygonMesh police_livery(const CarSurface& car) {
  MeshBuilder builder;
  const bool van = car.model.kind == ParticipantKind::van;
  const float front = static_cast<float>(car.model.wheelbase_m) - 0.42f, rear = 0.42f, low = van ? 0.85f : 0.52f,
              high = van ? 1.2f : 0.82f;
  draw_chequers(builder, car, rear, front, low, high);
  if (car.level == DetailLevel::far) return builder.take();
  builder.material = index_of(Finish::police_lettering);
  if (van)
    draw_patch_on_both_sides(builder, car.body, {{{{1.9f, 0.5f}, {1.0f, 0.5f}, {1.0f, 0.78f}, {1.9f, 0.78f}}}},
                             {0.014f, 0.0f});
  else
    draw_patch(builder, car.body, Face::rear, rectangle(Face::rear, {-0.3f, 0.70f}, {0.3f, 0.86f}), {0.014f, 0.0f});
  const float cowl = static_cast<float>(car.model.wheelbase_m) - car.shape.cowl_m;
  if (!van)
    draw_patch(builder, car.body, Face::top,
               {{{{cowl + 0.95f, -0.4f}, {cowl + 0.95f, 0.4f}, {cowl + 0.7f, 0.4f}, {cowl + 0.7f, -0.4f}}}},
               {0.012f, 0.0f});
  return builder.take();
}

}  // namespace

geometry::PolygonMesh ambulance_livery(const CarSurface& car) {
  MeshBuilder builder;
  const float front = static_cast<float>(car.model.wheelbase_m) - 0.46f,
              rear = static_cast<float>(-car.model.rear_overhang_m) + 0.08f;
  const PatchOptions flat{0.012f, 0.0f};
  // Below the windows, and behind the foot of the windscreen.
  draw_chequers(builder, car, rear, front, 0.82f, 1.24f);
  if (car.level == DetailLevel::far) return builder.take();
  const float half = car.half_width_m() * 0.72f, hood = car.shape.hood_front_m;
  draw_patch(builder, car.body, Face::rear, rectangle(Face::rear, {-half, 0.98f}, {half, 1.38f}), flat);
  builder.material = index_of(Finish::lettering_mirrored);
  // Over the radiator, for drivers ahead who read it in the mirror: on surfaces that lean back no further than a bonnet
  // does.
  draw_patch(builder, car.body, Face::front, rectangle(Face::front, {-0.58f, hood - 0.02f}, {0.58f, hood + 0.16f}),
             {0.012f, 0.0f, 0.25f});
  if (car.level != DetailLevel::near) return builder.take();
  builder.material = index_of(Finish::lettering);
  draw_patch_on_both_sides(builder, car.body, {{{{0.25f, 2.08f}, {-0.95f, 2.08f}, {-0.95f, 2.30f}, {0.25f, 2.30f}}}},
                           flat);
  draw_patch(builder, car.body, Face::rear, rectangle(Face::rear, {-0.55f, 2.14f}, {0.55f, 2.34f}), flat);
  return builder.take();
}

geometry::PolygonMesh livery(const CarSurface& car) {
  if (car.model.kind == ParticipantKind::ambulance) return ambulance_livery(car);
  if (is_police(car.model)) return police_livery(car);
  return {};
}

Finish body_finish(const VehicleModel& model) {
  if (model.kind == ParticipantKind::ambulance) return Finish::livery_yellow;
  return is_police(model) ? Finish::white_panel : Finish::paint;
}

VehicleParts roof_parts(const CarSurface& car) {
  VehicleParts parts;
  const auto axle = static_cast<float>(car.model.wheelbase_m), rear = static_cast<float>(-car.model.rear_overhang_m);
  if (car.model.kind == ParticipantKind::ambulance) {
    add_bar(parts, car, axle - 1.45f, 0.12f, 0.66f, 0.16f);
    add_bar(parts, car, rear + 0.55f, 0.44f, 0.74f, 0.16f);
    if (car.level == DetailLevel::near)
      for (const float side : {1.0f, -1.0f})
        if (const auto grille = surface_point(car.body, Face::front, {side * 0.30f, car.shape.hood_front_m - 0.08f}))
          parts.push_back(beacon_box({grille->x, side * 0.30f, car.shape.hood_front_m - 0.08f}, {0.06f, 0.14f, 0.05f}));
  } else if (is_police(car.model)) {
    const float middle = car.model.kind == ParticipantKind::van ? axle - 1.45f : axle - 1.85f;
    add_bar(parts, car, middle, 0.10f, 0.52f, 0.11f);
  } else if (car.model.name == "taxi" && car.level != DetailLevel::far) {
    const float x = axle - 1.75f;
    const auto roof = surface_point(car.body, Face::top, {x, 0.0f});
    const float low = roof ? roof->z - 0.01f : car.height_m() - 0.02f, half = 0.19f, high = low + 0.13f;
    MeshBuilder builder;
    builder.material = index_of(Finish::taxi_sign);
    const float a = x + 0.08f, b = x - 0.08f;
    builder.patch({a, -half, low}, {a, half, low}, {a - 0.02f, half, high}, {a - 0.02f, -half, high});
    builder.patch({b, half, low}, {b, -half, low}, {b + 0.02f, -half, high}, {b + 0.02f, half, high});
    builder.material = index_of(Finish::livery_yellow);
    builder.patch({a, half, low}, {b, half, low}, {b + 0.02f, half, high}, {a - 0.02f, half, high});
    builder.patch({b, -half, low}, {a, -half, low}, {a - 0.02f, -half, high}, {b + 0.02f, -half, high});
    builder.patch({a - 0.02f, -half, high}, {a - 0.02f, half, high}, {b + 0.02f, half, high}, {b + 0.02f, -half, high});
    parts.push_back({"taxi sign", builder.take(), 0, {Placement{}}});
  }
  return parts;
}

}  // namespace septet::scenery
