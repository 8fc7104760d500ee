/// How those get on who stand behind a wreck, or behind anybody else who does not move.
///
/// SUMO's lane-change model lets nobody change lanes who is nearer to the one ahead than his standstill gap, and its IDM
/// stops some centimetres within it: all who once stand behind a wreck stand there for good. So a vehicle that has stood
/// for a second is held, which keeps its distance, and has next to no standstill gap, and half a metre from then until it
/// drives again: SUMO's own search for a free lane works, with its own safety. Beside a sublane that it shares with a wreck SUMO's search
/// finds nothing either; so who is held for long presses to one side and to the other in turn.

#include <algorithm>

#include "sim-server/sumo/room_ahead.hpp"
#include "sim-server/sumo/sumo_traffic.hpp"

namespace septet::server {
namespace {

constexpr double standing_mps = 0.1, driving_mps = 2.0;
constexpr int steps_to_hold = 20;                         // A second.
constexpr int steps_to_press = 200;                       // Ten seconds, each side in turn.
constexpr double held_gap_m = 0.1, close_up_gap_m = 0.5;  // Standstill gaps while held, and after that.
constexpr double press_m = 1.0;
/// Beyond the standstill gap: what counts as standing behind another, and the room at which it is let go.
constexpr double room_to_hold_m = 0.3, room_to_go_m = 0.6;
constexpr double beside_m = 0.2;

}  // namespace

void SumoTraffic::free_those_who_stand(std::span<const traffic::ForeignVehicle> foreign) {
  std::vector<PlanOutline> bodies;
  bodies.reserve(after_.size() + foreign.size());
  for (const Participant& p : after_) bodies.push_back(plan_outline(p.world_from_vehicle, vehicle_models()[p.model]));
  for (const auto& vehicle : foreign) bodies.push_back(plan_outline(vehicle.world_from_vehicle, vehicle.shape()));
  auto member = members_.begin();
  for (const Participant& p : after_) {
    if (!running_) return;
    member = std::ranges::find(member, members_.end(), p.id, &Member::id);
    auto& standing = member->standing;
    standing.steps = member->speed_mps < standing_mps ? standing.steps + 1 : 0;
    if (standing.close_up && member->speed_mps > driving_mps) {
      standing.close_up = false;
      ok(client_->set_standstill_gap(p.id, member->standstill_gap_m));
    }
    if (!standing.held && standing.steps < steps_to_hold) continue;
    const double room = room_ahead_m(p.world_from_vehicle, vehicle_models()[p.model], beside_m, bodies);
    const bool hold = room < member->standstill_gap_m + (standing.held ? room_to_go_m : room_to_hold_m);
    hold_standing(*member, hold);
  }
}

void SumoTraffic::hold_standing(Member& member, bool hold) {
  auto& standing = member.standing;
  if (hold && standing.held) {
    ++standing.steps_held;
    const int turns = standing.steps_held / steps_to_press;
    if (turns > 0 && running_) ok(client_->move_aside(member.id, turns % 2 == 1 ? press_m : -press_m));
    return;
  }
  if (hold == standing.held) return;
  standing.held = hold;
  standing.steps = standing.steps_held = 0;
  standing.close_up = true;
  if (running_) ok(client_->set_standstill_gap(member.id, hold ? held_gap_m : close_up_gap_m));
  if (running_) ok(client_->hold_vehicle(member.id, hold));
}

}  // namespace septet::server
