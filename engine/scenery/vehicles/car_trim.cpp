#include <algorithm>
#include <cmath>

#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
#include "engine/scenery/vehicles/car_lines.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

/// Pushes every corner `margin` away from the middle, along both axes of the picture.
PatchOutline grown(const PatchOutline& outline, float margin) {
  PatchOutline result = outline;
  const glm::vec2 middle = (outline.corners[0] + outline.corners[1] + outline.corners[2] + outline.corners[3]) * 0.25f;
  for (glm::vec2& corner : result.corners) {
    corner.x += corner.x > middle.x ? margin : -margin;
    corner.y += corner.y > middle.y ? margin : -margin;
  }
  return result;
}

struct TrimPen {
  MeshBuilder& builder;
  const CarSurface& car;
  bool fine;

  PatchOptions options(float lift) const { return {lift, fine ? 0.10f : 0.0f}; }
  void both_sides(Finish finish, const PatchOutline& outline, PatchOptions patch) const {
    builder.material = index_of(finish);
    draw_patch_on_both_sides(builder, car.body, outline, patch);
  }
  void one(Finish finish, Face face, const PatchOutline& outline, PatchOptions patch) const {
    builder.material = index_of(finish);
    draw_patch(builder, car.body, face, outline, patch);
  }
  /// Draws a window; a near body has a hole there, and so has its frame.
  void window(const Window& window) const {
    const PatchOptions glass = window_options(car, window.face, 0.009f);
    const Finish finish = fine && window.clear ? Finish::clear_glass : Finish::glass;
    const bool side = window.face == Face::left;
    if (fine) {
      builder.material = index_of(Finish::trim);
      const PatchOptions frame = window_options(car, window.face, 0.004f);
      const auto band = [&](Face face, const PatchOutline& outline, const PatchOutline& wider) {
        draw_patch(builder, cut_out(car.body, face, outline, frame), face, wider, frame);
      };
      band(window.face, window.outline, grown(window.outline, 0.023f));
      if (side) band(Face::right, mirrored(window.outline), grown(mirrored(window.outline), 0.023f));
    }
    if (side)
      both_sides(finish, window.outline, glass);
    else
      one(finish, window.face, window.outline, glass);
  }
};

void draw_seams(const TrimPen& pen, const Glasshouse& g) {
  const CarSurface& car = pen.car;
  const auto radius = static_cast<float>(car.model.wheel_radius_m);
  const DoorSeams doors = door_seams(car.model, car.shape);
  const float low = doors.low, belt = doors.belt;
  const bool van = car.model.kind != ParticipantKind::car;
  const auto seam = [&](float x_low, float x_high) {
    pen.both_sides(Finish::trim,
                   {{{{x_low + 0.005f, low}, {x_low - 0.005f, low}, {x_high - 0.005f, belt}, {x_high + 0.005f, belt}}}},
                   {0.005f, 0.0f});
  };
  seam(doors.front, doors.front - 0.02f);
  seam(doors.middle, doors.middle);
  if (!van) seam(doors.rear_low, doors.rear_high);
  const auto handle = [&](float x) {
    pen.both_sides(van ? Finish::trim : Finish::paint,
                   rectangle(Face::left, {x - 0.09f, belt - 0.13f}, {x + 0.09f, belt - 0.095f}), {0.025f, 0.0f});
    pen.both_sides(Finish::trim, rectangle(Face::left, {x - 0.10f, belt - 0.14f}, {x + 0.10f, belt - 0.085f}),
                   {0.006f, 0.0f});
  };
  handle(van ? g.roof_front - 0.62f : g.pillar + 0.19f);
  if (!van) handle(radius * 0.9f + 0.22f);
  if (van) return;
  // Edge of the bonnet in front of the windscreen.
  const float half = car.half_width_m();
  pen.one(Finish::trim, Face::top,
          {{{{g.cowl + 0.03f, 0.72f * half},
             {g.cowl + 0.03f, -0.72f * half},
             {g.cowl + 0.075f, -0.72f * half},
             {g.cowl + 0.075f, 0.72f * half}}}},
          {0.006f, 0.0f});
}

void draw_ends(const TrimPen& pen) {
  const CarSurface& car = pen.car;
  const CarShape& s = car.shape;
  const float nose = car.half_width_m() * s.nose_half_width, tail = car.half_width_m() * s.tail_half_width;
  const float ground = s.ground_m;
  const bool van = car.model.kind != ParticipantKind::car;
  pen.one(Finish::trim, Face::front,
          {{{{-0.36f * nose, s.hood_front_m - 0.27f},
             {0.36f * nose, s.hood_front_m - 0.27f},
             {0.46f * nose, s.hood_front_m - 0.13f},
             {-0.46f * nose, s.hood_front_m - 0.13f}}}},
          pen.options(0.012f));
  pen.one(Finish::trim, Face::front,
          rectangle(Face::front, {-0.82f * nose, ground + 0.10f}, {0.82f * nose, ground + 0.24f}), pen.options(0.010f));
  pen.one(Finish::trim, Face::rear,
          rectangle(Face::rear, {-0.86f * tail, ground + 0.08f}, {0.86f * tail, ground + (van ? 0.28f : 0.20f)}),
          pen.options(0.010f));
  if (pen.fine)
    for (const float z : {0.165f, 0.20f, 0.235f})
      pen.one(Finish::chrome, Face::front,
              rectangle(Face::front, {-0.38f * nose, s.hood_front_m - z - 0.006f},
                        {0.38f * nose, s.hood_front_m - z + 0.006f}),
              {0.018f, 0.0f});
  pen.one(Finish::plate, Face::front, rectangle(Face::front, {-0.26f, ground + 0.265f}, {0.26f, ground + 0.375f}),
          {0.019f, 0.0f});
  const float plate = van ? 0.72f : s.tail_m - 0.42f;
  pen.one(Finish::plate, Face::rear, rectangle(Face::rear, {-0.26f, plate}, {0.26f, plate + 0.11f}), {0.014f, 0.0f});
  if (pen.fine)
    pen.both_sides(
        Finish::trim,
        rectangle(Face::left, {static_cast<float>(car.model.wheel_radius_m) * 1.3f, ground + 0.01f},
                  {static_cast<float>(car.model.wheelbase_m - car.model.wheel_radius_m * 1.3), ground + 0.075f}),
        {0.008f, 0.0f});
}

void add_mirrors(MeshBuilder& builder, const CarSurface& car, const Glasshouse& g) {
  const bool van = car.model.kind != ParticipantKind::car;
  const float x = g.cowl - (van ? 0.20f : 0.36f), half = car.half_width_m(), z = g.low_front + 0.01f;
  const float tall = van ? 0.34f : 0.15f;
  builder.material = index_of(van ? Finish::trim : Finish::paint);
  const geometry::PolygonMesh left =
      geometry::box({x - 0.07f, half * 0.94f, z}, {x + 0.07f, half + 0.17f, z + tall}, 0.035f);
  builder.append(left, glm::mat4(1.0f), true);
  builder.append(geometry::mirrored_y(left), glm::mat4(1.0f), true);
  builder.material = index_of(Finish::chrome);
  for (const float side : {1.0f, -1.0f}) {
    const float a = (half * 0.94f + 0.05f) * side, b = (half + 0.14f) * side;
    builder.patch({x - 0.073f, std::max(a, b), z + 0.03f}, {x - 0.073f, std::min(a, b), z + 0.03f},
                  {x - 0.073f, std::min(a, b), z + tall - 0.03f}, {x - 0.073f, std::max(a, b), z + tall - 0.03f});
  }
}

}  // namespace

geometry::PolygonMesh car_trim(const CarSurface& car) {
  MeshBuilder builder;
  const TrimPen pen{builder, car, car.level == DetailLevel::near};
  const Glasshouse glass = glasshouse_of(car);
  for (const Window& window : car_windows(car)) pen.window(window);
  draw_ends(pen);
  if (pen.fine) {
    draw_seams(pen, glass);
    add_mirrors(builder, car, glass);
  }
  return builder.take();
}

}  // namespace septet::scenery
