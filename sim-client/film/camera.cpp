#include "sim-client/film/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/rider.hpp"

namespace septet::film {
namespace {

constexpr double least_height_m = 0.3;  ///< Least height of a camera above the ground below its participant.

bool is_outside(const Shot& shot) { return shot.distance_m > 0.0; }

/// Viewpoint at the eyes of who has left his machine: what a shot through a rider's eyes sees from then on.
std::optional<frame::Viewpoint> rider_viewpoint(const Pivot& pivot, const Snapshot& world) {
  const Participant* rider = pivot.participant ? find_participant(world, rider_of(*pivot.participant)) : nullptr;
  if (!rider) return std::nullopt;
  const Vec3 eye_m = scenery::eye_in(shape_of(*rider));
  return frame::Viewpoint{rider->world_from_vehicle * RigidTransform{eye_m - pivot.in_views_m, Quat(1, 0, 0, 0)},
                          rider->id};
}

VehicleModel model_of(const Participant& participant) { return shape_of(participant); }

/// Heading of what is set upright the shortest way: who tumbles forwards does not turn about by it, as his yaw would.
double heading_upright_rad(const Quat& orientation) {
  return std::remainder(2.0 * std::atan2(orientation.z, orientation.w), 2.0 * std::numbers::pi);
}

/// Height of the lower end of a participant's upright axis, which is on the ground or, of one who lies, little above it.
double lower_end_m(const VehicleModel& model, const RigidTransform& world_from_vehicle) {
  return std::min((world_from_vehicle * Vec3(model.centre_x_m(), 0.0, 0.0)).z,
                  (world_from_vehicle * Vec3(model.centre_x_m(), 0.0, model.height_m)).z);
}

/// Participant with `is_meant` that is nearest to the driver's car, the car itself excepted.
template <class Meant>
const Participant* nearest(const Snapshot& world, const Meant& is_meant) {
  const Participant* driver = find_participant(world, world.driver_car.participant);
  const auto distance_m = [&](const Participant& other) {
    return driver ? glm::length(other.world_from_vehicle.position_m - driver->world_from_vehicle.position_m) : 0.0;
  };
  const Participant* found = nullptr;
  for (const Participant& other : world.participants)
    if (&other != driver && is_meant(other) && (!found || distance_m(other) < distance_m(*found))) found = &other;
  return found;
}

const Participant* find_meant(const std::string& name, const Snapshot& world, const logging::ParticipantNames& names) {
  if (name == "driver") return find_participant(world, world.driver_car.participant);
  if (name == "nearest") return nearest(world, [](const Participant&) { return true; });
  if (const auto number = logging::number_of(names, name)) return find_participant(world, *number);
  return nearest(world, [&](const Participant& other) { return model_of(other).name == name; });
}

/// List of a few participants: "1 ego (volvo-s80), 2 (ambulance), …".
std::string list_of(const Snapshot& world, const logging::ParticipantNames& names) {
  std::string list;
  for (std::size_t n = 0; n < world.participants.size() && n < 12; ++n)
    list += fmt::format("{}{}", n ? ", " : "", logging::called(names, world.participants[n]));
  if (list.empty()) return "nobody; give a place";
  return list + (world.participants.size() > 12 ? fmt::format(" and {} more", world.participants.size() - 12) : "");
}

}  // namespace

Expected<Pivot> find_pivot(const Shot& shot, const Snapshot& world, const Vec3& driver_eye_m,
                           const std::vector<Look>& path, const logging::ParticipantNames& names) {
  if (shot.place_m) return Pivot{};
  const Participant* participant = find_meant(shot.participant, world, names);
  if (!participant)
    return failure(
        fmt::format("there is no participant \"{}\" at {} s", shot.participant, shot.from_s), shot.where,
        fmt::format("choose \"driver\", \"nearest\", or the name, number or model of somebody there then: {}",
                    list_of(world, names)));
  const VehicleModel& model = model_of(*participant);
  const bool drives = participant->id == world.driver_car.participant;
  if (!is_outside(shot)) return Pivot{participant->id, drives ? driver_eye_m : scenery::eye_in(model)};
  const Vec3 middle_m(model.centre_x_m(), 0.0, 0.5 * model.height_m);
  double least_middle_m = least_height_m;
  for (const Look& look : path) {
    least_middle_m = std::max(least_middle_m, least_height_m + shot.distance_m * look.direction().z);
    if (middle_m.z < least_middle_m)
      return failure(fmt::format("with a pitch of {:.0f}° at a distance of {} m the camera goes below the road",
                                 look.pitch_rad() * 180.0 / std::numbers::pi, shot.distance_m),
                     shot.where, "let it look further down, or hang nearer");
  }
  return Pivot{participant->id, middle_m, least_middle_m};
}

frame::Viewpoint viewpoint_at(const Shot& shot, const Pivot& pivot, const Snapshot& world,
                              const frame::Viewpoint& before) {
  if (shot.place_m) return {{*shot.place_m, Quat(1, 0, 0, 0)}, std::nullopt};
  const Participant* participant = pivot.participant ? find_participant(world, *pivot.participant) : nullptr;
  if (!participant) return before;
  if (!is_outside(shot))
    if (auto rider = rider_viewpoint(pivot, world)) return *rider;
  frame::Viewpoint viewpoint{participant->world_from_vehicle, participant->id};
  if (is_outside(shot)) viewpoint.inside.reset();
  if (!is_outside(shot) && shot.bearings == Bearings::vehicle) return viewpoint;
  if (!is_outside(shot) && shot.bearings == Bearings::gaze) {
    const DriverCar& driver = world.driver_car;
    if (participant->id != driver.participant) return viewpoint;
    const Quat turn = orientation_from_angles(driver.gaze_heading_rad, 0.0, 0.0);
    viewpoint.world_from_views =
        participant->world_from_vehicle *
        RigidTransform{pivot.in_views_m + driver.head.from_rest_m - turn * pivot.in_views_m, turn};
    return viewpoint;
  }
  // Level frame below the same pivot, which is raised above one who lies, or the camera could be below the road.
  const RigidTransform& body = participant->world_from_vehicle;
  const Quat level = orientation_from_angles(
      shot.bearings == Bearings::vehicle ? heading_upright_rad(body.orientation) : 0.0, 0.0, 0.0);
  Vec3 pivot_m = body * pivot.in_views_m;
  if (is_outside(shot))
    pivot_m.z = std::max(pivot_m.z, lower_end_m(model_of(*participant), body) + pivot.least_above_ground_m);
  viewpoint.world_from_views = {pivot_m - level * pivot.in_views_m, level};
  return viewpoint;
}

frame::ScreenViews views_at(const Shot& shot, const Pivot& pivot, const Look& look, std::uint32_t width_px,
                            std::uint32_t height_px) {
  const double slope = std::tan(0.5 * shot.field_of_view_rad);
  instant::FrameView view;
  view.projection =
      instant::symmetric_view(pivot.in_views_m - shot.distance_m * look.direction(), look.heading_rad(),
                              look.pitch_rad(), shot.field_of_view_rad, 2.0 * std::atan(slope * height_px / width_px));
  view.viewport = {0, 0, width_px, height_px};
  return {{view}, {}, shot.interior};
}

}  // namespace septet::film
