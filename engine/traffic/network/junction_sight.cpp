#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/traffic/network/approach_view.hpp"
#include "engine/traffic/network/town_stages.hpp"
#include "engine/world/participant_sight.hpp"

namespace septet::traffic {
namespace {

constexpr double looks_s = 2.0;  ///< Who stands so long before a line does not get any nearer to it.
constexpr double around_m = 60.0;

/// True where, by a function of a way and its conflict, one of those in the passage's first junction is hidden.
template <class Hides>
bool hides_any(const LaneGraph& graph, const TownVehicle& vehicle, const Passage& passage, double line_m,
               const Hides& hides) {
  if (line_m <= at_stop_line_m || vehicle.waits_s > looks_s) return false;
  const std::uint32_t junction = graph.ways[vehicle.route[passage.first]].junction;
  for (std::size_t k = passage.first; k <= passage.last; ++k) {
    const Way& mine = graph.ways[vehicle.route[k]];
    if (mine.junction != junction) break;
    for (const WayConflict& conflict : graph.conflicts_of(mine))
      if (hides(mine, conflict)) return true;
  }
  return false;
}

/// One of the town's own that is near enough, and higher than eyes.
void add_if_high(const LaneGraph& graph, const TownVehicle& vehicle, std::int32_t who, const Vec3& eyes_m,
                 std::vector<HighBody>& around) {
  if (vehicle.outside || !hides_behind(vehicle_models()[vehicle.model])) return;
  const BodyOnRoute on_route = body_on_route(graph, vehicle);
  if (glm::distance(on_route.rear_axle_m, eyes_m) > around_m) return;
  Participant body;
  body.model = vehicle.model;
  const double heading_rad = std::atan2(on_route.forwards.y, on_route.forwards.x);
  body.world_from_vehicle = {on_route.rear_axle_m, orientation_from_angles(heading_rad, 0.0, 0.0)};
  if (const auto box = opaque_box_of(body)) around.push_back({who, does_move(vehicle.speed_mps), *box});
}

/// All others that are higher than the eyes of a vehicle's driver, and near.
std::vector<HighBody> high_ones_around(const LaneGraph& graph, const Presences& presences, const TownState& town,
                                       std::size_t index, const Vec3& eyes_m) {
  std::vector<HighBody> around;
  for (std::size_t k = 0; k < town.vehicles.size(); ++k)
    if (k != index) add_if_high(graph, town.vehicles[k], static_cast<std::int32_t>(k), eyes_m, around);
  for (const HighBody& body : presences.high)
    if (glm::distance(body.box.world_from_box.position_m, eyes_m) < around_m) around.push_back(body);
  return around;
}

}  // namespace

bool walls_hide(const LaneGraph& graph, const TownVehicle& vehicle, const Passage& passage, double line_m) {
  return hides_any(graph, vehicle, passage, line_m,
                   [&](const Way&, const WayConflict& conflict) { return line_m > conflict.seen_from_m; });
}

bool bodies_or_air_hide(const LaneGraph& graph, const Presences& presences, const TownState& town, std::size_t index,
                        const Passage& passage, double line_m) {
  const TownVehicle& vehicle = town.vehicles[index];
  if (line_m <= at_stop_line_m || vehicle.waits_s > looks_s) return false;
  const double up_m = driver_eyes_m(vehicle_models()[vehicle.model]).z;
  const Vec3 eyes_m = place_on_route(graph, vehicle, vehicle.front_m - eye_behind_m).position_m + Vec3(0.0, 0.0, up_m);
  const std::vector<HighBody> around = high_ones_around(graph, presences, town, index, eyes_m);
  if (around.empty() && !town.air) return false;
  return hides_any(graph, vehicle, passage, line_m, [&](const Way& mine, const WayConflict& conflict) {
    const Way& his = graph.ways[conflict.with];
    return conflict.kind != WayConflict::Kind::diverging && yields_to(mine, his) &&
           is_hidden_by(around, town.air, graph, eyes_m, his, looked_for_back_m(mine, conflict, his));
  });
}

}  // namespace septet::traffic
