#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/scenery/vehicles/car_details.hpp"

namespace septet::scenery {
namespace {

void add_car_windows(std::vector<Window>& windows, const CarSurface& car, const Glasshouse& g) {
  const auto add_side = [&](const PatchOutline& outline) { windows.push_back({Face::left, outline}); };
  const auto add_end = [&](Face face, const PatchOutline& outline) { windows.push_back({face, outline}); };
  const float half = car.half_width_m(), height = car.height_m();
  const float middle_low = (g.low_front + g.low_rear) / 2;
  // A windscreen that leans far back leaves no pillar at its head, unless the window beside it ends further back.
  const float head = car.model.name == "mpv" ? 0.22f : 0.10f;
  add_side({{{{g.cowl - 0.20f, g.low_front},
              {g.pillar + 0.045f, middle_low},
              {g.pillar + 0.035f, g.high},
              {g.roof_front - head, g.high}}}});
  const float rear_low =
      car.shape.third_window ? g.roof_rear + 0.62f : g.backlight * 0.35f + g.roof_rear * 0.65f + 0.02f;
  const float rear_high = car.shape.third_window ? g.roof_rear + 0.60f : g.roof_rear + 0.16f;
  add_side({{{{g.pillar - 0.045f, middle_low},
              {rear_low, g.low_rear},
              {rear_high, g.high - 0.01f},
              {g.pillar - 0.055f, g.high}}}});
  if (car.shape.third_window)
    add_side({{{{rear_low - 0.09f, g.low_rear},
                {g.roof_rear + 0.02f, g.low_rear + 0.02f},
                {g.roof_rear + 0.16f, g.high - 0.03f},
                {rear_high - 0.09f, g.high - 0.01f}}}});
  const float top = half * car.shape.roof_half_width;
  add_end(Face::front, {{{{-0.76f * half, car.shape.hood_rear_m + 0.035f},
                          {0.76f * half, car.shape.hood_rear_m + 0.035f},
                          {top * 0.93f, height - 0.135f},
                          {-top * 0.93f, height - 0.135f}}}});
  const float foot = std::max(car.shape.deck_m + 0.04f, car.shape.belt_rear_m + 0.02f);
  add_end(
      Face::rear,
      {{{{0.70f * half, foot}, {-0.70f * half, foot}, {-top * 0.88f, height - 0.14f}, {top * 0.88f, height - 0.14f}}}});
}

void add_van_windows(std::vector<Window>& windows, const CarSurface& car, const Glasshouse& g) {
  const auto add_side = [&](const PatchOutline& outline) { windows.push_back({Face::left, outline}); };
  const auto add_end = [&](Face face, const PatchOutline& outline) { windows.push_back({face, outline}); };
  const float half = car.half_width_m(), height = car.height_m();
  const float top = std::min(height - 0.42f, car.shape.belt_front_m + 0.72f);
  add_side({{{{g.cowl - 0.26f, g.low_front},
              {g.roof_front - 0.72f, g.low_front},
              {g.roof_front - 0.72f, top},
              {g.roof_front + 0.08f, top}}}});
  add_end(Face::front, {{{{-0.80f * half, car.shape.hood_rear_m + 0.06f},
                          {0.80f * half, car.shape.hood_rear_m + 0.06f},
                          {0.80f * half, top + 0.06f},
                          {-0.80f * half, top + 0.06f}}}});
  if (car.model.name == "minibus" || car.model.name == "police-van") {
    // Windows for passengers reach as far as the tail.
    const float from = g.roof_front - 0.86f, to = static_cast<float>(-car.model.rear_overhang_m) + 0.28f;
    for (int k = 0; k < 3; ++k) {
      const float a = std::lerp(from, to, static_cast<float>(k) / 3.0f),
                  b = std::lerp(from, to, (static_cast<float>(k) + 1.0f) / 3.0f) + 0.09f;
      add_side({{{{a, g.low_front}, {b, g.low_front}, {b, top}, {a, top}}}});
    }
  }
  if (car.model.name == "dropside-van" || car.model.name == "box-van") return;
  for (const float side : {-1.0f, 1.0f}) {
    const float inner = 0.06f * half, outer = 0.74f * half;
    add_end(Face::rear, rectangle(Face::rear, {side > 0 ? inner : -outer, 1.45f}, {side > 0 ? outer : -inner, top}));
  }
  if (car.model.kind == ParticipantKind::ambulance)
    add_side({{{{1.55f, 1.52f}, {0.55f, 1.52f}, {0.55f, 1.98f}, {1.55f, 1.98f}}}});
}

}  // namespace

Glasshouse glasshouse_of(const CarSurface& car) {
  const CarShape& s = car.shape;
  const auto axle = static_cast<float>(car.model.wheelbase_m), rear = static_cast<float>(-car.model.rear_overhang_m);
  Glasshouse g{axle - s.cowl_m,         axle - s.roof_front_m,  rear + s.roof_rear_m,   rear + s.backlight_m, 0.0f,
               s.belt_front_m + 0.035f, s.belt_rear_m + 0.035f, car.height_m() - 0.145f};
  g.pillar = g.roof_front - 0.64f;
  return g;
}

std::vector<Window> car_windows(const CarSurface& car) {
  std::vector<Window> windows;
  const Glasshouse glass = glasshouse_of(car);
  if (car.model.kind == ParticipantKind::car)
    add_car_windows(windows, car, glass);
  else
    add_van_windows(windows, car, glass);
  if (carries_goods(car.model))
    for (std::size_t i = 2; i < windows.size(); ++i) windows[i].clear = false;
  return windows;
}

PatchOptions window_options(const CarSurface& car, Face face, float lift_m) {
  // Flatter surfaces are roof or bonnet.
  constexpr float steepest = 0.2f;
  const float corner_cut = car.level == DetailLevel::near ? 0.10f : 0.0f;
  return face == Face::left ? PatchOptions{lift_m, corner_cut} : PatchOptions{lift_m, corner_cut, steepest};
}

}  // namespace septet::scenery
