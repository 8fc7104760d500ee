#include "engine/simulation/effects/dents.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/roadside/obstacle_profile.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
namespace {

using Outline = std::vector<Vec2>;  ///< Convex, counter-clockwise, in plan.

constexpr double narrowest_dent_m = 0.08;         ///< Half its width.
constexpr double longer_than_a_vehicle_m = 10.0;  ///< Half the length of a wall or rail, as far as a dent goes.

Outline rectangle(const Vec2& middle_m, const Vec2& ahead, double half_length_m, double half_width_m) {
  const Vec2 left(-ahead.y, ahead.x);
  const Vec2 along = half_length_m * ahead, across = half_width_m * left;
  return {middle_m - along - across, middle_m + along - across, middle_m + along + across, middle_m - along + across};
}

Outline outline_of(const Participant& vehicle) {
  const debris::Box box = body_box(vehicle);
  const Vec3 x = box.world_from_box.orientation * Vec3(1.0, 0.0, 0.0);
  return rectangle(Vec2(box.world_from_box.position_m), glm::normalize(Vec2(x)), box.half_size_m.x, box.half_size_m.y);
}

/// Intersection of both outlines (Sutherland and Hodgman 1974).
Outline common(Outline outline, const Outline& with) {
  for (std::size_t i = 0; i < with.size() && !outline.empty(); ++i) {
    const Vec2 from = with[i], edge = with[(i + 1) % with.size()] - from;
    const auto inside = [&](const Vec2& p) { return edge.x * (p.y - from.y) - edge.y * (p.x - from.x); };
    Outline kept;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
      const double at_a = inside(a), at_b = inside(b);
      if (at_a >= 0.0) kept.push_back(a);
      if ((at_a < 0.0) != (at_b < 0.0)) kept.push_back(a + (at_a / (at_a - at_b)) * (b - a));
    }
    outline = std::move(kept);
  }
  return outline;
}

/// Least and most of an outline along an axis.
std::pair<double, double> extent(const Outline& outline, const Vec2& axis) {
  std::pair<double, double> extent{INFINITY, -INFINITY};
  for (const Vec2& corner : outline) {
    extent.first = std::min(extent.first, glm::dot(corner, axis));
    extent.second = std::max(extent.second, glm::dot(corner, axis));
  }
  return extent;
}

/// Adds a dent to `vehicle`, pushed along `inwards` by an obstacle of outline `other`, which has come in to its final
/// depth of `depth_m`.
void add_dent(const Participant& vehicle, const Vec2& inwards, double depth_m, const Outline& other, double top_m,
              std::vector<MadeDent>& made) {
  if (!(depth_m > 0.0) || !has_four_wheels(vehicle_models()[vehicle.model].kind)) return;
  const Outline own = outline_of(vehicle);
  const Vec2 along(-inwards.y, inwards.x);
  const Outline crushed = common(own, other);
  if (crushed.empty()) return;
  const auto [low, high] = extent(crushed, along);
  const double face = extent(own, inwards).first;
  const RigidTransform vehicle_from_world = inverse(vehicle.world_from_vehicle);
  const Vec2 middle = face * inwards + 0.5 * (low + high) * along;
  const Vec3 place_m = vehicle_from_world * Vec3(middle, vehicle.world_from_vehicle.position_m.z),
             way = vehicle_from_world.orientation * Vec3(inwards, 0.0);
  MadeDent& dent = made.emplace_back();
  dent.vehicle = vehicle.id;
  dent.dent.place_m = Vec2(place_m);
  dent.dent.heading_rad = std::atan2(way.y, way.x);
  dent.dent.depth_m = depth_m;
  dent.dent.half_width_m = std::max(narrowest_dent_m, 0.5 * (high - low));
  dent.dent.top_m = std::min(top_m, vehicle_models()[vehicle.model].height_m);
}

/// Height of a vehicle at its side that faces `outwards`: of its bonnet before its slope, else of the whole body.
double struck_height_m(const Participant& vehicle, const Vec2& outwards) {
  const VehicleModel model = shape_of(vehicle);
  const Vec3 local = inverse(vehicle.world_from_vehicle).orientation * Vec3(outwards, 0.0);
  const auto slope = front_slope(model.kind);
  return slope && local.x > std::abs(local.y) ? slope->edge_height * model.height_m : model.height_m;
}

Outline moved_by(Outline outline, const Vec2& way_m) {
  for (Vec2& corner : outline) corner += way_m;
  return outline;
}

/// Half the breadth and the height of an obstacle as it dents a body; nothing for one that yields.
struct DentingShape {
  double half_breadth_m = 0.0, high_m = 0.0;
};
std::optional<DentingShape> denting_shape(ObstacleKind kind) {
  const roadside::ObstacleProfile profile = roadside::profile_of(kind);
  if (profile.yielding_kg > 0.0) return std::nullopt;
  switch (kind) {
    case ObstacleKind::gantry_leg:
    case ObstacleKind::tree:
    case ObstacleKind::post:
      return DentingShape{std::max(profile.radius_m, narrowest_dent_m), profile.height_m};
    case ObstacleKind::ground_face:  // Its height is not known; a bumper's is chosen, as of a rail.
      return DentingShape{longer_than_a_vehicle_m, roadside::profile_of(ObstacleKind::guard_rail).height_m};
    default:
      return DentingShape{longer_than_a_vehicle_m, profile.height_m};
  }
}

}  // namespace

std::vector<MadeDent> dents_of_crash(const Participant& first, const Participant& second, const VehicleCrash& struck) {
  std::vector<MadeDent> made;
  // Each takes the other's share of the mass; of what stands fast, all.
  const auto share = [](double own_kg, double other_kg) {
    return std::isfinite(own_kg) ? 1.0 / (1.0 + own_kg / other_kg) : 0.0;
  };
  const double closing_mps = struck.closing_speed_mps, first_kg = struck.first.mass_kg,
               second_kg = struck.second.mass_kg;
  const double first_m = debris::residual_crush_m(closing_mps * share(first_kg, second_kg)),
               second_m = debris::residual_crush_m(closing_mps * share(second_kg, first_kg));
  const Vec2 away(struck.normal);
  if (!(glm::length(away) > 0.5)) return made;
  const Vec2 inwards = glm::normalize(away);
  const Vec2 in_m = (first_m + second_m) * inwards;
  add_dent(first, inwards, first_m, moved_by(outline_of(second), in_m), struck_height_m(second, inwards), made);
  add_dent(second, -inwards, second_m, moved_by(outline_of(first), -in_m), struck_height_m(first, -inwards), made);
  return made;
}

std::vector<MadeDent> dents_of_touch(const Participant& vehicle, const vehicle::HullTouch& touch) {
  std::vector<MadeDent> made;
  const auto what = denting_shape(touch.kind);
  const Vec2 away(touch.normal);
  if (!what || !(glm::length(away) > 0.5)) return made;
  const Vec2 inwards = glm::normalize(away);
  const double depth_m = debris::residual_crush_m(touch.closing_speed_mps);
  constexpr double thick_m = 1.0;
  // Its face is at the place of contact; the vehicle comes on from there.
  const Vec2 middle_m = Vec2(touch.point_m) + (depth_m + 0.02 - thick_m) * inwards;
  add_dent(vehicle, inwards, depth_m, rectangle(middle_m, inwards, thick_m, what->half_breadth_m), what->high_m, made);
  return made;
}

void advance_dents(const std::vector<MadeDent>& made, const std::vector<TornOff>& torn,
                   const std::vector<Participant>& participants, Tick shows, DentState& state) {
  if (made.empty() && torn.empty() && state.vehicles.empty()) return;
  for (const MadeDent& dent : made) debris::note_dent(dent.vehicle, dent.dent, state.vehicles);
  for (const TornOff& off : torn) debris::note_torn(off.vehicle, off.mounts, state.vehicles);
  std::erase_if(state.vehicles, [&](const debris::DentedVehicle& dented) {
    return !std::ranges::binary_search(participants, dented.vehicle, {}, &Participant::id);
  });
  if (state.vehicles.empty() && state.keyframe.data.empty()) return;
  Bytes data = debris::encode_dents(state.vehicles);
  if (data != state.keyframe.data)
    state.keyframe = {debris::dent_effect_id, debris::dent_keyframe_kind, std::move(data), shows};
}

}  // namespace septet::simulation
