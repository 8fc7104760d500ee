#include "engine/effects/debris/dent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/world/vehicle_body.hpp"

namespace septet::debris {
namespace {

struct DentValues {
  double undented_mps;
};
#define SEPTET_ENTRY(name, ...) constexpr DentValues name __VA_ARGS__;
#include "engine/effects/debris/dents.toml.inc"

/// 1 up to 0, and 0 from 1 on; its slope is nowhere more than 1.5.
double fading(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

/// Depth of the layer that moves as a whole: a skin and its lining.
constexpr double skin_m = 0.15;
/// Inward reach of a dent: far enough that the parts behind are compressed and never pushed through themselves.
double reach_m(const Dent& dent) { return std::clamp(skin_m + 2.2 * dent.depth_m, 0.4, 1.8); }

/// Width of the transition between the dented part and the rest.
double rim_m(const Dent& dent) { return 0.2 + 0.4 * dent.depth_m; }

/// Height over the striking body up to which the body gives way with the parts below.
constexpr double over_top_m = 0.5;

/// A point in the dent's frame.
struct InDent {
  double inwards_m, along_m;
  double share;  ///< Share of the depth by which it is moved.
};

InDent place_in(const Dent& dent, const Vec3& p) {
  const Vec2 inwards(std::cos(dent.heading_rad), std::sin(dent.heading_rad)), along(-inwards.y, inwards.x);
  const Vec2 from = Vec2(p.x, p.y) - dent.place_m;
  InDent place{glm::dot(from, inwards), glm::dot(from, along), 0.0};
  const double rim = rim_m(dent), high = fading((p.z - dent.top_m) / over_top_m),
               wide = fading((std::abs(place.along_m) - dent.half_width_m) / rim + 0.5);
  place.share = high * wide * fading((place.inwards_m - skin_m) / (reach_m(dent) - skin_m));
  return place;
}

/// Folds of sheet metal: uneven, within ±1, the same for all parts of the vehicle, and nearly so for points behind each
/// other.
double folds(const Dent& dent, const Vec3& place_m, double turned_rad) {
  const Vec3 inwards(std::cos(dent.heading_rad), std::sin(dent.heading_rad), 0.0);
  const Vec3 p = place_m - 0.7 * glm::dot(place_m, inwards) * inwards;
  const double phase = 40.0 * (dent.place_m.x + 1.7 * dent.place_m.y) + turned_rad;
  return 0.5 * std::sin(19.0 * p.x + 7.0 * p.y - 5.0 * p.z + phase) +
         0.3 * std::sin(-8.0 * p.x + 23.0 * p.y + 9.0 * p.z + 2.3 * phase) +
         0.2 * std::sin(31.0 * p.x - 17.0 * p.y + 27.0 * p.z + 3.1 * phase);
}

Vec3 moved(const Dent& dent, const Vec3& p) {
  const InDent place = place_in(dent, p);
  if (!(place.share > 0.0)) return Vec3(0.0);
  const Vec3 inwards(std::cos(dent.heading_rad), std::sin(dent.heading_rad), 0.0), up(0.0, 0.0, 1.0);
  const double lengthways = std::abs(inwards.x);
  // Less in doors, whose lining is near.
  const double fold_m = std::min(0.022, 0.08 * dent.depth_m) * (lengthways > 0.7 ? 1.0 : 0.4) * place.share;
  Vec3 way = (dent.depth_m * place.share + fold_m * folds(dent, p, 0.0)) * inwards;
  way += 0.7 * fold_m * folds(dent, p, 1.3) * up;
  // A compressed bonnet or lid rises between its edges.
  if (lengthways > 0.7 && place.inwards_m > 0.0 && place.inwards_m < reach_m(dent)) {
    const double wave = std::sin(std::numbers::pi * place.inwards_m / reach_m(dent)),
                 sheet = (1.0 - fading((p.z - 0.5) / 0.3)) * fading((p.z - 0.95) / 0.25),
                 wide = fading((std::abs(place.along_m) - dent.half_width_m) / rim_m(dent) + 0.5);
    way += std::min(0.35 * dent.depth_m, 0.14) * wave * wave * sheet * wide * up;
  }
  return way;
}

/// Null at the limit of dented vehicles.
DentedVehicle* entry_of(ParticipantId vehicle, std::vector<DentedVehicle>& vehicles) {
  const auto found = std::ranges::find(vehicles, vehicle, &DentedVehicle::vehicle);
  if (found != vehicles.end()) return &*found;
  if (vehicles.size() >= most_dented_vehicles) return nullptr;
  vehicles.push_back({vehicle, {}, 0});
  return &vehicles.back();
}

}  // namespace

double residual_crush_m(double lost_mps) {
  const Crush& crush = passenger_car_crush();
  if (!(lost_mps > car_dents.undented_mps)) return 0.0;
  const double even_m = (lost_mps - car_dents.undented_mps) / crush.frequency_radps,
               beyond_m = std::max(0.0, even_m - crush.crumple_m);
  return std::min(even_m - beyond_m + beyond_m / std::sqrt(crush.harder_times), most_depth_m);
}

void note_torn(ParticipantId vehicle, Mounts torn, std::vector<DentedVehicle>& vehicles) {
  if (torn == 0) return;
  if (DentedVehicle* found = entry_of(vehicle, vehicles)) found->torn |= torn;
}

void note_dent(ParticipantId vehicle, const Dent& dent, std::vector<DentedVehicle>& vehicles) {
  if (!(dent.depth_m > 0.0)) return;
  DentedVehicle* found = entry_of(vehicle, vehicles);
  if (!found) return;
  std::vector<Dent>& dents = found->dents;
  const auto beside = std::ranges::find_if(dents, [&](const Dent& other) {
    return glm::length(other.place_m - dent.place_m) < 0.3 && std::cos(other.heading_rad - dent.heading_rad) > 0.9;
  });
  if (beside != dents.end()) {
    beside->depth_m = std::min(std::hypot(beside->depth_m, dent.depth_m), most_depth_m);
    beside->half_width_m = std::max(beside->half_width_m, dent.half_width_m);
    beside->top_m = std::max(beside->top_m, dent.top_m);
    return;
  }
  if (dents.size() >= most_dents) {
    const auto shallowest = std::ranges::min_element(dents, {}, &Dent::depth_m);
    if (shallowest->depth_m >= dent.depth_m) return;
    dents.erase(shallowest);
  }
  dents.push_back(dent);
}

Vec3 dented(std::span<const Dent> dents, const Vec3& place_m) {
  Vec3 at = place_m;
  for (const Dent& dent : dents) at += moved(dent, at);
  return at;
}

Vec3 dented_normal(std::span<const Dent> dents, const Vec3& place_m, const Vec3& normal) {
  constexpr double step_m = 1e-3;
  glm::dmat3 gradient(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0.0);
    step[axis] = step_m;
    gradient[axis] = (dented(dents, place_m + step) - dented(dents, place_m - step)) / (2.0 * step_m);
  }
  // Surfaces turn with the inverse transpose: the cofactors, up to a factor.
  const Vec3 turned = normal.x * glm::cross(gradient[1], gradient[2]) +
                      normal.y * glm::cross(gradient[2], gradient[0]) + normal.z * glm::cross(gradient[0], gradient[1]);
  const double length = glm::length(turned);
  return length > 1e-9 ? turned / length : normal;
}

bool reaches(std::span<const Dent> dents, const Vec3& place_m) {
  return std::ranges::any_of(dents, [&](const Dent& dent) { return place_in(dent, place_m).share > 0.0; });
}

}  // namespace septet::debris
