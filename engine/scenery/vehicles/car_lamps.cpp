#include <algorithm>
#include <optional>
#include <vector>

#include <glm/common.hpp>

#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/car_lines.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/lens.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using scene::PartRole;

/// Lamps of one role. Each is a part of its own, so that it shines at its position.
class LampPen {
 public:
  LampPen(const CarSurface& car, VehicleParts& parts, const char* name, PartRole role, Finish finish)
      : car_(car), parts_(parts), name_(name), role_(role), finish_(finish) {}

  /// Draws a rectangle on the car's left; `low` is nearer to the middle.
  void left(Face face, glm::vec2 low, glm::vec2 high) { draw(face, low, high); }
  void right(Face face, glm::vec2 low, glm::vec2 high) { draw(face, {-high.x, low.y}, {-low.x, high.y}); }
  void both(Face face, glm::vec2 low, glm::vec2 high) {
    left(face, low, high);
    right(face, low, high);
  }
  void draw(Face face, glm::vec2 low, glm::vec2 high) {
    if (car_.level != DetailLevel::near) return draw_plate(face, low, high);
    const PatchOptions options{0.014f, 0.12f};
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
  /// Draws a flat plate before the outermost point of the body that it covers.
  void draw_plate(Face face, glm::vec2 low, glm::vec2 high) {
    const bool ahead = face == Face::front;
    std::optional<float> x;
    for (const glm::vec2 at : {low, high, glm::vec2(low.x, high.y), glm::vec2(high.x, low.y), 0.5f * (low + high)})
      if (const auto point = surface_point(car_.body, face, at))
        x = !x ? point->x : ahead ? std::max(*x, point->x) : std::min(*x, point->x);
    if (!x) return;
    const glm::vec2 middle = 0.5f * (low + high);
    parts_.push_back(lens_plate(name_, role_, finish_, ahead, {*x + (ahead ? 0.02f : -0.02f), middle.x, middle.y},
                                glm::abs(high - low)));
  }

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
  const float nose = car.half_width_m() * s.nose_half_width;
  const bool van = car.model.kind != ParticipantKind::car, far = car.level == DetailLevel::far;
  const LampPlace ahead = head_lamp(car.model, s), behind = tail_lamp(car.model, s);
  LampPen head(car, parts, "lamp head", PartRole::lamp_head, Finish::lens_head);
  head.both(Face::front, {ahead.inner, ahead.low}, {ahead.outer, ahead.top});

  // Order from the outside in and from below: tail and brake, indicator, reverse.
  const float outer = behind.outer, inner = behind.inner, top = behind.top, low = behind.low;
  const float middle = (top * 0.45f + low * 0.55f), between = van ? inner : (inner * 0.62f + outer * 0.38f);
  LampPen tail(car, parts, "lamp tail", PartRole::lamp_tail, Finish::lens_tail);
  LampPen brake(car, parts, "lamp brake", PartRole::lamp_brake, Finish::lens_brake);
  if (van) {
    const float third = (top - low) / 3;
    tail.both(Face::rear, {inner, top - third * 0.5f}, {outer, top});
    brake.both(Face::rear, {inner, low + third * 1.1f}, {outer, top - third * 0.55f});
  } else {
    tail.both(Face::rear, {between, low}, {outer, middle});
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
    draw(Face::front, {0.80f * nose, ahead.low - 0.055f}, {0.95f * nose, ahead.low - 0.008f});
    if (van)
      draw(Face::rear, {inner, low + 0.09f}, {outer, low + 0.17f});
    else
      draw(Face::rear, {inner, middle + 0.004f}, {between - 0.004f, top});
  }
  return parts;
}

}  // namespace septet::scenery
