#include <algorithm>
#include <cmath>

#include "engine/geometry/shapes.hpp"
#include "engine/scenery/vehicles/car_details.hpp"
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
  void side_window(const PatchOutline& outline) const {
    if (fine) both_sides(Finish::trim, grown(outline, 0.022f), options(0.004f));
    both_sides(Finish::glass, outline, options(0.009f));
  }
  void window(Face face, const PatchOutline& outline) const {
    // What is flatter than this is roof or bonnet.
    constexpr float steepest = 0.2f;
    if (fine) one(Finish::trim, face, grown(outline, 0.025f), {0.004f, 0.10f, steepest});
    one(Finish::glass, face, outline, {0.010f, fine ? 0.10f : 0.0f, steepest});
  }
};

/// Where the side windows end.
struct Glasshouse {
  float cowl, roof_front, roof_rear, backlight, pillar, low_front, low_rear, high;
};

Glasshouse glasshouse_of(const CarSurface& car) {
  const CarShape& s = car.shape;
  const auto axle = static_cast<float>(car.model.wheelbase_m), rear = static_cast<float>(-car.model.rear_overhang_m);
  Glasshouse g{axle - s.cowl_m,         axle - s.roof_front_m,  rear + s.roof_rear_m,   rear + s.backlight_m, 0.0f,
               s.belt_front_m + 0.035f, s.belt_rear_m + 0.035f, car.height_m() - 0.145f};
  g.pillar = g.roof_front - 0.64f;
  return g;
}

void draw_car_windows(const TrimPen& pen, const Glasshouse& g) {
  const CarSurface& car = pen.car;
  const float half = car.half_width_m(), height = car.height_m();
  const float middle_low = (g.low_front + g.low_rear) / 2;
  pen.side_window({{{{g.cowl - 0.20f, g.low_front},
                     {g.pillar + 0.045f, middle_low},
                     {g.pillar + 0.035f, g.high},
                     {g.roof_front - 0.10f, g.high}}}});
  const float rear_low =
      car.shape.third_window ? g.roof_rear + 0.62f : g.backlight * 0.35f + g.roof_rear * 0.65f + 0.02f;
  const float rear_high = car.shape.third_window ? g.roof_rear + 0.60f : g.roof_rear + 0.16f;
  pen.side_window({{{{g.pillar - 0.045f, middle_low},
                     {rear_low, g.low_rear},
                     {rear_high, g.high - 0.01f},
                     {g.pillar - 0.055f, g.high}}}});
  if (car.shape.third_window)
    pen.side_window({{{{rear_low - 0.09f, g.low_rear},
                       {g.roof_rear + 0.02f, g.low_rear + 0.02f},
                       {g.roof_rear + 0.16f, g.high - 0.03f},
                       {rear_high - 0.09f, g.high - 0.01f}}}});
  const float top = half * car.shape.roof_half_width;
  pen.window(Face::front, {{{{-0.76f * half, car.shape.hood_rear_m + 0.035f},
                             {0.76f * half, car.shape.hood_rear_m + 0.035f},
                             {top * 0.93f, height - 0.135f},
                             {-top * 0.93f, height - 0.135f}}}});
  const float foot = std::max(car.shape.deck_m + 0.04f, car.shape.belt_rear_m + 0.02f);
  pen.window(
      Face::rear,
      {{{{0.70f * half, foot}, {-0.70f * half, foot}, {-top * 0.88f, height - 0.14f}, {top * 0.88f, height - 0.14f}}}});
}

void draw_van_windows(const TrimPen& pen, const Glasshouse& g) {
  const CarSurface& car = pen.car;
  const float half = car.half_width_m(), height = car.height_m();
  const float top = std::min(height - 0.42f, car.shape.belt_front_m + 0.72f);
  pen.side_window({{{{g.cowl - 0.26f, g.low_front},
                     {g.roof_front - 0.72f, g.low_front},
                     {g.roof_front - 0.72f, top},
                     {g.roof_front + 0.08f, top}}}});
  pen.window(Face::front, {{{{-0.80f * half, car.shape.hood_rear_m + 0.06f},
                             {0.80f * half, car.shape.hood_rear_m + 0.06f},
                             {0.80f * half, top + 0.06f},
                             {-0.80f * half, top + 0.06f}}}});
  if (car.model.name == "minibus" || car.model.name == "police-van") {
    // Passengers look out as far as the tail.
    const float from = g.roof_front - 0.86f, to = static_cast<float>(-car.model.rear_overhang_m) + 0.28f;
    for (int k = 0; k < 3; ++k) {
      const float a = std::lerp(from, to, static_cast<float>(k) / 3.0f),
                  b = std::lerp(from, to, (static_cast<float>(k) + 1.0f) / 3.0f) + 0.09f;
      pen.side_window({{{{a, g.low_front}, {b, g.low_front}, {b, top}, {a, top}}}});
    }
  }
  if (car.model.name == "dropside-van" || car.model.name == "box-van") return;
  for (const float side : {-1.0f, 1.0f}) {
    const float inner = 0.06f * half, outer = 0.74f * half;
    pen.window(Face::rear, rectangle(Face::rear, {side > 0 ? inner : -outer, 1.45f}, {side > 0 ? outer : -inner, top}));
  }
  if (car.model.kind == ParticipantKind::ambulance)
    pen.side_window({{{{1.55f, 1.52f}, {0.55f, 1.52f}, {0.55f, 1.98f}, {1.55f, 1.98f}}}});
}

void draw_seams(const TrimPen& pen, const Glasshouse& g) {
  const CarSurface& car = pen.car;
  const auto axle = static_cast<float>(car.model.wheelbase_m), radius = static_cast<float>(car.model.wheel_radius_m);
  const float low = car.shape.ground_m + 0.14f, belt = g.low_front - 0.03f;
  const bool van = car.model.kind != ParticipantKind::car;
  const auto seam = [&](float x_low, float x_high) {
    pen.both_sides(Finish::trim,
                   {{{{x_low + 0.005f, low}, {x_low - 0.005f, low}, {x_high - 0.005f, belt}, {x_high + 0.005f, belt}}}},
                   {0.005f, 0.0f});
  };
  const float front = axle - radius * 1.2f - 0.14f;
  seam(front, front - 0.02f);
  seam(van ? g.roof_front - 0.80f : g.pillar, van ? g.roof_front - 0.80f : g.pillar);
  if (!van) seam(radius * 1.2f + 0.10f, radius * 0.9f + 0.04f);
  const auto handle = [&](float x) {
    pen.both_sides(van ? Finish::trim : Finish::paint,
                   rectangle(Face::left, {x - 0.09f, belt - 0.13f}, {x + 0.09f, belt - 0.095f}), {0.025f, 0.0f});
    pen.both_sides(Finish::trim, rectangle(Face::left, {x - 0.10f, belt - 0.14f}, {x + 0.10f, belt - 0.085f}),
                   {0.006f, 0.0f});
  };
  handle(van ? g.roof_front - 0.62f : g.pillar + 0.19f);
  if (!van) handle(radius * 0.9f + 0.22f);
  if (van) return;
  // The bonnet's edge in front of the windscreen.
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
          {0.022f, 0.0f});
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
  if (car.model.kind == ParticipantKind::car)
    draw_car_windows(pen, glass);
  else
    draw_van_windows(pen, glass);
  draw_ends(pen);
  if (pen.fine) {
    draw_seams(pen, glass);
    add_mirrors(builder, car, glass);
  }
  return builder.take();
}

}  // namespace septet::scenery
