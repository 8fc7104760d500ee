#include <algorithm>

#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using scene::PartRole;

/// Lamps of one role. Each is a part of its own, so that it shines where it is.
class LampPen {
 public:
  LampPen(const CarSurface& car, VehicleParts& parts, const char* name, PartRole role, Finish finish)
      : car_(car), parts_(parts), name_(name), role_(role), finish_(finish) {}

  /// A rectangle on the car's left; `low` is nearer to the middle.
  void left(Face face, glm::vec2 low, glm::vec2 high) { draw(face, low, high); }
  void right(Face face, glm::vec2 low, glm::vec2 high) { draw(face, {-high.x, low.y}, {-low.x, high.y}); }
  void both(Face face, glm::vec2 low, glm::vec2 high) {
    left(face, low, high);
    right(face, low, high);
  }
  void draw(Face face, glm::vec2 low, glm::vec2 high) {
    const PatchOptions options = car_.level == DetailLevel::near     ? PatchOptions{0.014f, 0.12f}
                                 : car_.level == DetailLevel::middle ? PatchOptions{0.020f, 0.0f}
                                                                     : PatchOptions{0.030f, 0.0f};
    MeshBuilder builder;
    builder.material = index_of(finish_);
    draw_patch(builder, car_.body, face, rectangle(face, low, high), options);
    if (builder.mesh().polygons.empty()) return;
    Placement place;
    place.role = role_;
    place.casts_shadow = false;
    parts_.push_back({name_, builder.take(), 0, {place}});
  }

 private:
  const CarSurface& car_;
  VehicleParts& parts_;
  const char* name_;
  PartRole role_;
  Finish finish_;
};

}  // namespace

VehicleParts car_lamps(const CarSurface& car) {
  VehicleParts parts;
  const CarShape& s = car.shape;
  const float nose = car.half_width_m() * s.nose_half_width, tail = car.half_width_m() * s.tail_half_width;
  const bool van = car.model.kind != ParticipantKind::car, far = car.level == DetailLevel::far;
  const float lamp_top = s.hood_front_m - 0.115f, lamp_low = lamp_top - (van ? 0.19f : 0.135f);
  LampPen head(car, parts, "lamp head", PartRole::lamp_head, Finish::lens_head);
  head.both(Face::front, {0.50f * nose, lamp_low}, {0.93f * nose, lamp_top});

  // From the outside in and from below: tail and brake, indicator, reverse.
  const float outer = 0.95f * tail, inner = (van ? 0.80f : 0.56f) * tail;
  const float top = van ? 1.30f : s.tail_m - 0.055f, low = van ? 0.80f : s.tail_m - 0.235f;
  const float middle = (top * 0.45f + low * 0.55f), between = van ? inner : (inner * 0.62f + outer * 0.38f);
  LampPen tail_lamp(car, parts, "lamp tail", PartRole::lamp_tail, Finish::lens_tail);
  LampPen brake(car, parts, "lamp brake", PartRole::lamp_brake, Finish::lens_brake);
  if (van) {
    const float third = (top - low) / 3;
    tail_lamp.both(Face::rear, {inner, top - third * 0.5f}, {outer, top});
    brake.both(Face::rear, {inner, low + third * 1.1f}, {outer, top - third * 0.55f});
  } else {
    tail_lamp.both(Face::rear, {between, low}, {outer, middle});
    brake.both(Face::rear, {between, middle + 0.004f}, {outer, top});
  }
  if (!far) brake.draw(Face::rear, {-0.14f, car.height_m() - 0.18f}, {0.14f, car.height_m() - 0.15f});
  if (far) return parts;

  LampPen reverse(car, parts, "lamp reverse", PartRole::lamp_reverse, Finish::lens_reverse);
  const float reverse_high = van ? low + 0.08f : middle;
  reverse.both(Face::rear, {inner, low}, {van ? outer : between - 0.004f, reverse_high});
  for (const bool on_left : {true, false}) {
    LampPen indicator(car, parts, on_left ? "lamp indicator left" : "lamp indicator right",
                      on_left ? PartRole::lamp_indicator_left : PartRole::lamp_indicator_right, Finish::lens_indicator);
    const auto draw = [&](Face face, glm::vec2 a, glm::vec2 b) {
      on_left ? indicator.left(face, a, b) : indicator.right(face, a, b);
    };
    draw(Face::front, {0.80f * nose, lamp_low - 0.055f}, {0.95f * nose, lamp_low - 0.008f});
    if (van)
      draw(Face::rear, {inner, low + 0.09f}, {outer, low + 0.17f});
    else
      draw(Face::rear, {inner, middle + 0.004f}, {between - 0.004f, top});
  }
  return parts;
}

geometry::PolygonMesh ambulance_livery(const CarSurface& car) {
  MeshBuilder builder;
  const float front = static_cast<float>(car.model.wheelbase_m) - 0.30f,
              rear = static_cast<float>(-car.model.rear_overhang_m) + 0.08f;
  const PatchOptions flat{0.012f, 0.0f};
  // Lengths of four chequers, so that they stay square.
  builder.material = index_of(Finish::chequers);
  const float low = 0.92f, high = 1.40f, length = (high - low) / 2 * 8;
  for (float x = front; x - length * 0.4f > rear; x -= length) {
    const float end = x - length < rear ? rear : x - length;
    draw_patch_on_both_sides(builder, car.body, {{{{x, low}, {end, low}, {end, high}, {x, high}}}}, flat);
  }
  if (car.level == DetailLevel::far) return builder.take();
  const float half = car.half_width_m() * 0.72f, hood = car.shape.hood_front_m;
  draw_patch(builder, car.body, Face::rear, rectangle(Face::rear, {-half, 0.98f}, {half, 1.38f}), flat);
  builder.material = index_of(Finish::lettering_mirrored);
  draw_patch(builder, car.body, Face::front, rectangle(Face::front, {-0.58f, hood - 0.02f}, {0.58f, hood + 0.16f}),
             flat);
  if (car.level != DetailLevel::near) return builder.take();
  builder.material = index_of(Finish::lettering);
  draw_patch_on_both_sides(builder, car.body, {{{{0.25f, 2.08f}, {-0.95f, 2.08f}, {-0.95f, 2.30f}, {0.25f, 2.30f}}}},
                           flat);
  draw_patch(builder, car.body, Face::rear, rectangle(Face::rear, {-0.55f, 2.14f}, {0.55f, 2.34f}), flat);
  return builder.take();
}

VehiclePart ambulance_beacons(const CarSurface& car) {
  MeshBuilder builder;
  builder.material = index_of(Finish::lens_beacon);
  const auto axle = static_cast<float>(car.model.wheelbase_m), high = static_cast<float>(car.model.height_m);
  const bool far = car.level == DetailLevel::far;
  const auto bar = [&](float x, float from_y, float to_y) {
    const auto roof = surface_point(car.body, Face::top, {x, (from_y + to_y) / 2});
    const float low = roof ? roof->z - 0.05f : high - 0.3f;
    const auto lamp = [&](float y0, float y1) {
      builder.append(geometry::box({x - 0.11f, y0, low}, {x + 0.11f, y1, low + 0.2f},
                                   car.level == DetailLevel::near ? 0.03f : 0.0f),
                     glm::mat4(1.0f), true);
    };
    if (far) return lamp(-to_y, to_y);
    lamp(from_y, to_y);
    lamp(-to_y, -from_y);
  };
  bar(axle - 1.45f, 0.12f, 0.66f);
  bar(static_cast<float>(-car.model.rear_overhang_m) + 0.55f, 0.44f, 0.74f);
  if (car.level == DetailLevel::near)
    for (const float side : {1.0f, -1.0f})
      draw_patch(builder, car.body, Face::front,
                 rectangle(Face::front, {side * 0.30f - 0.07f, car.shape.hood_front_m - 0.10f},
                           {side * 0.30f + 0.07f, car.shape.hood_front_m - 0.05f}),
                 {0.03f, 0.0f});
  Placement place;
  place.role = PartRole::beacon;
  return {"beacon", builder.take(), 0, {place}};
}

}  // namespace septet::scenery
