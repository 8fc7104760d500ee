#include "engine/scenery/vehicles/car_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/mesh_measures.hpp"
#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using geometry::PolygonMesh;

constexpr int station_count = 15, side_points = 5, ring_points = 2 * side_points + 1;

/// Extents of the body, in world measures.
struct Lines {
  float rear, front, axle_front, radius, half_width, height;
};

Lines lines_of(const VehicleModel& model, const CarShape& shape) {
  return {static_cast<float>(-model.rear_overhang_m), static_cast<float>(model.front_m()),
          static_cast<float>(model.wheelbase_m),      static_cast<float>(model.wheel_radius_m),
          static_cast<float>(model.width_m / 2),      static_cast<float>(model.height_m) - shape.roof_below_m};
}

/// Stations of the lower body: tail, rear wheel arch (2…6), door, front wheel arch (8…12), nose.
std::array<float, station_count> station_x(const Lines& l) {
  const float r = l.radius;
  std::array<float, station_count> x{l.rear,
                                     l.rear + 0.12f,
                                     -1.2f * r,
                                     -0.8f * r,
                                     0.0f,
                                     0.8f * r,
                                     1.2f * r,
                                     0.0f,
                                     l.axle_front - 1.2f * r,
                                     l.axle_front - 0.8f * r,
                                     l.axle_front,
                                     l.axle_front + 0.8f * r,
                                     l.axle_front + 1.2f * r,
                                     l.front - 0.13f,
                                     l.front};
  x[7] = (x[6] + x[8]) / 2;
  return x;
}

/// Height of the wheel arch over the ground at a station; 0 away from the wheels.
float arch_m(int station, float radius) {
  constexpr std::array<float, 5> rise{0.0f, 0.80f, 1.16f, 0.80f, 0.0f};
  const int at = station >= 2 && station <= 6 ? station - 2 : station >= 8 && station <= 12 ? station - 8 : 0;
  return rise[at] > 0.0f ? radius * (1.0f + rise[at]) : 0.0f;
}

float taper(int station, const CarShape& shape) {
  switch (station) {
    case 0:
      return shape.tail_half_width;
    case 1:
      return 0.6f + 0.4f * shape.tail_half_width;
    case 2:
      return 0.98f;
    case 12:
      return 0.985f;
    case 13:
      return 0.5f + 0.5f * shape.nose_half_width;
    case 14:
      return shape.nose_half_width;
    default:
      return 1.0f;
  }
}

/// Point of the middle line over the car, and of the belt line beside it.
struct UpperPoint {
  float x, top, rail, rail_half_width, belt_x, belt;
};

std::array<UpperPoint, station_count> upper_points(const Lines& l, const CarShape& s) {
  std::array<UpperPoint, station_count> u{};
  const auto x = station_x(l);
  const float cowl = l.axle_front - s.cowl_m, roof_front = l.axle_front - s.roof_front_m;
  const float roof_rear = l.rear + s.roof_rear_m, backlight = l.rear + s.backlight_m;
  const float roof_w = s.roof_half_width, hood_w = 0.66f;
  const float roof = l.height;
  u[0] = {l.rear + 0.01f, s.tail_m, s.tail_m - 0.01f, 0.62f * s.tail_half_width, l.rear + 0.01f, s.tail_m - 0.05f};
  u[1] = {(l.rear + backlight) / 2,
          (s.deck_m * 2 + s.tail_m) / 3,
          (s.deck_m * 2 + s.tail_m) / 3 - 0.01f,
          0.68f,
          (l.rear + backlight) / 2,
          s.deck_m - 0.06f};
  u[2] = {backlight, s.deck_m, s.deck_m - 0.012f, 0.76f, backlight - 0.02f, s.belt_rear_m - 0.035f};
  for (int i = 3; i <= 8; ++i) {
    const float t = static_cast<float>(i - 3) / 5.0f;
    const float at = std::lerp(roof_rear, roof_front, t);
    // Roofs are highest a little before their middle and fall to both ends.
    const float fall = 0.075f * (t - 0.55f) * (t - 0.55f) * 4.0f;
    const float belt_x = std::lerp(std::lerp(backlight, roof_rear, 0.45f), std::lerp(cowl, roof_front, 0.22f), t);
    u[i] = {at, roof - fall, roof - fall - s.roof_arch_m, roof_w, belt_x, std::lerp(s.belt_rear_m, s.belt_front_m, t)};
  }
  u[9] = {cowl, s.hood_rear_m, s.hood_rear_m - 0.02f, 0.80f, cowl - 0.06f, s.belt_front_m - 0.02f};
  for (int i = 10; i <= 13; ++i) {
    const float t = static_cast<float>(i - 9) / 4.0f;
    const float at = i == 13 ? l.front - 0.16f : std::lerp(cowl, l.front - 0.16f, t);
    const float top = std::lerp(s.hood_rear_m, s.hood_front_m, t * t);
    u[i] = {at, top, top - 0.015f, std::lerp(0.74f, hood_w, t), std::max(at, x[i] - 0.1f), top - 0.05f - 0.03f * t};
  }
  u[14] = {l.front - 0.03f,          s.hood_front_m - 0.10f, s.hood_front_m - 0.11f,
           0.6f * s.nose_half_width, l.front - 0.02f,        s.hood_front_m - 0.14f};
  return u;
}

std::array<glm::vec3, side_points + 1> left_half(int i, const Lines& l, const CarShape& s) {
  const auto x = station_x(l);
  const auto upper = upper_points(l, s)[i];
  const float narrow = taper(i, s), width = l.half_width * narrow;
  const float arch = arch_m(i, l.radius);
  const bool end = i == 0 || i == 14;
  const float bottom = std::max(arch, end ? s.ground_m + 0.06f : s.ground_m);
  const float low = std::max(arch > 0 ? arch + 0.05f : 0.0f, std::lerp(s.ground_m, upper.belt, 0.30f));
  const float middle = std::max(low + 0.07f, std::lerp(s.ground_m, upper.belt, 0.66f));
  const float sill = arch > 0 ? 0.985f : 0.93f;
  return {{{x[i], width * sill, bottom},
           {x[i], width * 0.995f, low},
           {x[i], width, std::min(middle, upper.belt - 0.06f)},
           {upper.belt_x, width * (i >= 3 && i <= 8 ? 0.945f : 0.955f), upper.belt},
           {upper.x, l.half_width * upper.rail_half_width * (end ? 1.0f : std::min(1.0f, narrow + 0.04f)), upper.rail},
           {upper.x, 0.0f, upper.top}}};
}

}  // namespace

CarShape car_shape(const VehicleModel& model) {
  CarShape s;
  if (model.name == "hatchback") {
    s = {0.17f, 0.90f, 0.98f, 0.96f, 0.78f, 1.00f, 0.88f,  0.40f,
         1.22f, 0.42f, 0.14f, 0.68f, 0.72f, 0.86f, 0.045f, false};
  } else if (model.name == "saloon" || model.name == "taxi" || model.name == "police-car") {
    s.belt_rear_m = 0.96f;
    s.roof_rear_m = 1.10f;
    s.backlight_m = 0.50f;
    s.nose_half_width = 0.78f;
  } else if (model.name == "coupe") {
    s = {0.15f, 0.90f, 0.97f, 0.94f, 0.74f, 1.00f, 0.90f,  0.66f,
         1.58f, 1.72f, 0.22f, 0.62f, 0.74f, 0.82f, 0.045f, false};
  } else if (model.name == "sports-car") {
    s = {0.13f, 0.80f, 0.86f, 0.82f, 0.62f, 0.88f, 0.80f,  0.72f,
         1.50f, 1.42f, 0.50f, 0.60f, 0.72f, 0.86f, 0.040f, false};
  } else if (model.name == "pick-up") {
    s = {0.28f, 1.08f, 1.10f, 1.12f, 0.98f, 1.10f, 1.08f,  0.46f,
         1.20f, 1.85f, 1.66f, 0.72f, 0.84f, 0.94f, 0.040f, false};
  } else if (model.name == "mpv") {
    s = {0.18f, 0.98f, 1.02f, 1.00f, 0.82f, 1.06f, 0.98f,  0.12f,
         0.98f, 0.30f, 0.08f, 0.72f, 0.76f, 0.92f, 0.050f, true};
  } else if (model.name == "dropside-van" || model.name == "box-van") {
    // Cab with a low back, on which a bed or a box stands.
    s = {0.24f, 1.28f, 1.20f, 1.22f, 0.98f, 1.00f, 0.98f, 0.22f,
         1.02f, 3.00f, 2.72f, 0.82f, 0.82f, 0.98f, 0.05f, false};
    if (model.name == "box-van") s.roof_below_m = 0.10f;
  } else if (model.name == "estate") {
    s = {0.17f, 0.93f, 0.96f, 0.96f, 0.78f, 1.00f, 0.90f, 0.58f, 1.42f, 0.34f, 0.12f, 0.69f, 0.76f, 0.88f, 0.04f, true};
  } else if (model.name == "suv") {
    s = {0.26f, 1.08f, 1.12f, 1.12f, 0.98f, 1.14f, 1.02f, 0.42f, 1.22f, 0.40f, 0.14f, 0.70f, 0.82f, 0.90f, 0.04f, true};
  } else if (model.kind == ParticipantKind::van || model.kind == ParticipantKind::ambulance) {
    s = {0.24f, 1.28f, 1.30f, 1.22f, 0.98f, 1.34f, 1.20f, 0.22f,
         1.02f, 0.10f, 0.05f, 0.86f, 0.82f, 0.98f, 0.05f, false};
    if (model.kind == ParticipantKind::ambulance) s.roof_half_width = 0.88f;
  } else {
    SEPTET_CHECK(model.kind == ParticipantKind::car, "{} is not built from a car's lines", model.name);
  }
  return s;
}

PolygonMesh car_body_cage(const VehicleModel& model, const CarShape& shape, std::uint32_t subdivision_level) {
  const Lines l = lines_of(model, shape);
  MeshBuilder builder;
  builder.material = index_of(Finish::paint);
  // Ring order: left side upwards, the middle of the top, right side downwards.
  for (int i = 0; i < station_count; ++i) {
    const auto half = left_half(i, l, shape);
    for (const glm::vec3& p : half) builder.vertex(p);
    for (int k = side_points - 1; k >= 0; --k) builder.vertex({half[k].x, -half[k].y, half[k].z});
  }
  const auto at = [](int station, int ring) {
    return static_cast<std::uint32_t>(station * ring_points + ring % ring_points);
  };
  for (int i = 0; i + 1 < station_count; ++i)
    for (int k = 0; k < ring_points; ++k) {
      builder.material = index_of(k == ring_points - 1 ? Finish::underbody : Finish::paint);
      builder.quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    }
  builder.material = index_of(Finish::paint);
  const int last = station_count - 1;
  for (int k = 0; k + 1 < side_points; ++k) {
    const int other = ring_points - 1 - k;
    builder.quad(at(0, k), at(0, other), at(0, other - 1), at(0, k + 1));
    builder.quad(at(last, k), at(last, k + 1), at(last, other - 1), at(last, other));
  }
  builder.triangle(at(0, 4), at(0, 6), at(0, 5));
  builder.triangle(at(last, 4), at(last, 5), at(last, 6));
  PolygonMesh cage = builder.take();
  cage.vertex_creases.assign(cage.vertices_m.size(), geometry::crease_smooth);
  for (const int i : {2, 6, 8, 12})
    for (const int k : {0, ring_points - 1}) cage.vertex_creases[at(i, k)] = geometry::crease_sharp;
  for (int i = 0; i + 1 < station_count; ++i) {
    // Sharp along the sills and the wheel arches, firm along the shoulders, half firm at both ends.
    for (const int k : {0, ring_points - 1}) geometry::crease_edge(cage, at(i, k), at(i + 1, k));
    for (const int k : {3, 7}) geometry::crease_edge(cage, at(i, k), at(i + 1, k), crease_share(0.45f));
  }
  for (int k = 0; k < ring_points; ++k)
    for (const int i : {0, last}) geometry::crease_edge(cage, at(i, k), at(i, k + 1), crease_share(0.3f));
  for (const int k : {4, 5}) {
    for (const int i : {2, 9}) geometry::crease_edge(cage, at(i, k), at(i, k + 1), crease_share(0.5f));
    for (const int i : {2, 9})
      geometry::crease_edge(cage, at(i, k + 1), at(i, k + 2 > 6 ? 6 : k + 2), crease_share(0.5f));
  }
  fit_bounds(cage, subdivision_level, {{l.rear, -l.half_width, shape.ground_m}, {l.front, l.half_width, l.height}});
  return cage;
}

PolygonMesh car_body_far(const VehicleModel& model, const CarShape& s) {
  const Lines l = lines_of(model, s);
  const auto upper = upper_points(l, s);
  MeshBuilder builder;
  constexpr std::array<int, 6> stations{0, 2, 3, 8, 9, 14};
  for (const int i : stations) {
    const UpperPoint& u = upper[i];
    const float width = l.half_width * taper(i, s);
    const float body_x = i == 0 ? l.rear : i == 14 ? l.front : u.belt_x;
    const std::array<glm::vec3, 3> half{
        {{body_x, width * 0.97f, s.ground_m + 0.03f},
         {u.belt_x, width * 0.97f, u.belt},
         {u.x, l.half_width * u.rail_half_width, std::max(u.top - 0.01f, u.belt + 0.01f)}}};
    for (const glm::vec3& p : half) builder.vertex(p);
    for (int k = 2; k >= 0; --k) builder.vertex({half[k].x, -half[k].y, half[k].z});
  }
  const auto at = [](std::size_t i, int k) { return static_cast<std::uint32_t>(i * 6 + k % 6); };
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    for (int k = 0; k < 6; ++k) {
      const bool cabin = i >= 1 && i <= 3;
      // Windows: the sides between belt and roof, the slopes before and behind.
      const bool window = cabin && ((k == 1 || k == 3) || (k == 2 && i != 2));
      const bool panel_van = model.kind != ParticipantKind::car && model.name != "minibus" && i != 3;
      builder.material = index_of(k == 5 ? Finish::underbody : window && !panel_van ? Finish::glass : Finish::paint);
      builder.quad(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    }
  builder.material = index_of(Finish::paint);
  builder.quad(at(0, 0), at(0, 5), at(0, 4), at(0, 1));
  builder.quad(at(0, 1), at(0, 4), at(0, 3), at(0, 2));
  builder.quad(at(5, 0), at(5, 1), at(5, 4), at(5, 5));
  builder.quad(at(5, 1), at(5, 2), at(5, 3), at(5, 4));
  PolygonMesh mesh = builder.take();
  geometry::crease_by_angle(mesh, 0.7f);
  return mesh;
}

}  // namespace septet::scenery
