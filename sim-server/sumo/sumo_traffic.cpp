#include "sim-server/sumo/sumo_traffic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>

#include "engine/road/road_locate.hpp"
#include "engine/world/interpolate.hpp"

namespace septet::server {
namespace {

using traffic::ForeignVehicle;

constexpr double rim_m = 60.0;
/// A place at the rim that SUMO finds no room at is given up after half a second.
constexpr int patient_steps = 10;
/// The first second, in which the swarm is set out, and how long each place is tried then.
constexpr int setting_out_steps = 20, patient_steps_at_first = 2;

bool is_emergency(const ForeignVehicle& vehicle) {
  return vehicle.lamps.has(Lamp::beacon) || vehicle.lamps.has(Lamp::siren);
}

std::string type_name(ParticipantId id) { return fmt::format("type{}", id); }
/// Of one that was SUMO's own and has a type there.
std::string wreck_type_name(ParticipantId id) { return fmt::format("wreck{}", id); }

}  // namespace

SumoTraffic::SumoTraffic(const road::RoadNetwork& roads, SumoNetwork network, std::shared_ptr<SumoClient> client,
                         std::uint64_t seed)
    : roads_(roads), network_(std::move(network)), client_(std::move(client)), random_(seed, 1) {}

bool SumoTraffic::ok(const Expected<void>& outcome) {
  if (!outcome && !error_) error_ = outcome.error();
  if (!outcome) running_ = false;
  return outcome.has_value();
}

void SumoTraffic::start(const traffic::TrafficParameters& parameters, std::span<const ForeignVehicle> foreign) {
  stop();
  parameters_ = parameters;
  auto swarm = traffic::populate(parameters, roads_, foreign, random_);
  corridors_ = std::move(swarm.corridors);
  running_ = true;
  for (std::size_t c = 0; c < corridors_.size() && running_; ++c) {
    const auto& corridor = corridors_[c];
    // From the front to the back: SUMO places each as fast as the one ahead allows, but never close ahead of a present
    // vehicle.
    std::vector<std::size_t> front_first(corridor.size());
    std::iota(front_first.begin(), front_first.end(), std::size_t{0});
    std::ranges::stable_sort(front_first,
                             [&](std::size_t a, std::size_t b) { return corridor.x_m[a] > corridor.x_m[b]; });
    for (const std::size_t i : front_first) {
      if (!running_) break;
      const VehicleModel& model = vehicle_models()[corridor.model[i]];
      members_.push_back({.id = corridor.id[i],
                          .model = corridor.model[i],
                          .paint = corridor.paint[i],
                          .corridor = c,
                          .desired_speed_mps = corridor.driver[i].following.desired_speed_mps,
                          .standstill_gap_m = corridor.driver[i].following.standstill_gap_m,
                          .place = std::nullopt});
      ok(client_->define_type({type_name(corridor.id[i]), "driver", model.length_m, model.width_m, model.height_m,
                               corridor.driver[i].following}));
      if (corridor.lane[i] > 0 && running_) enter(members_.back(), corridor.lane[i], corridor.x_m[i]);
    }
  }
  std::ranges::sort(members_, {}, &Member::id);
  // SUMO's clock begins one step before the drive: the first step places all vehicles.
  if (running_) place_foreign(foreign, 0.0);
  if (running_) step(foreign);
  if (running_) place_foreign(foreign, sumo_step_s);
  if (running_) step(foreign);
}

void SumoTraffic::stop() {
  for (Member& member : members_)
    if (running_ && member.stay != Member::Stay::outside) leave(member);
  for (const ParticipantId id : told_)
    if (running_) ok(client_->remove_vehicle(id));
  members_.clear();
  told_.clear();
  given_up_.clear();
  corridors_.clear();
  before_.clear();
  after_.clear();
  phase_s_ = 0.0;
  steps_ = 0;
  running_ = false;
}

void SumoTraffic::enter(Member& member, int lane, double x_m) {
  auto place = place_in_sumo(network_, roads_, corridors_[member.corridor].corridor, lane, x_m);
  if (place.route.empty()) return;
  member.stay = Member::Stay::asked_for;
  member.steps_waiting = 0;
  member.standing = {};
  member.place.reset();
  ok(client_->add_vehicle({.id = member.id,
                           .type = type_name(member.id),
                           .route = std::move(place.route),
                           .lane_index = place.lane_index,
                           .along_m = place.along_m}));
}

void SumoTraffic::leave(Member& member) {
  member.stay = Member::Stay::outside;
  ok(client_->remove_vehicle(member.id));
}

bool SumoTraffic::release(ParticipantId id) {
  const auto member = std::ranges::find(members_, id, &Member::id);
  if (!running_ || member == members_.end() || member->stay != Member::Stay::on_road) return false;
  leave(*member);
  members_.erase(member);
  for (auto* frame : {&before_, &after_})
    std::erase_if(*frame, [&](const Participant& participant) { return participant.id == id; });
  given_up_.push_back(id);
  parameters_.count -= std::min<std::uint32_t>(parameters_.count, 1);
  return true;
}

/// Placed anywhere within the swarm while it is being set out. Returns true if it was requested.
bool SumoTraffic::set_out_again(Member& member, double middle_x_m) {
  const auto& corridor = corridors_[member.corridor];
  const double length = corridor.corridor.length_m;
  double x = middle_x_m + random_.uniform(-parameters_.radius_m, parameters_.radius_m);
  if (corridor.corridor.closed) x = traffic::wrap_x(corridor.corridor, x);
  if (!corridor.corridor.closed && (x < rim_m || x > length - rim_m)) return false;
  const int lowest = corridor.table.lowest, highest = std::max(lowest, corridor.table.highest);
  const int lane = lowest + static_cast<int>(random_.below(static_cast<std::uint64_t>(highest - lowest + 1)));
  if (traffic::lane_end_m(corridor.table, lane, x) < x + 300.0) return false;
  enter(member, lane, x);
  return member.stay == Member::Stay::asked_for;
}

/// Recycles as Septet's own swarm does: out of the radius on one side, in again on the other; slower ones enter ahead.
void SumoTraffic::recycle(Member& member, const road::RoadPosition& middle, double middle_speed_mps) {
  const auto& corridor = corridors_[member.corridor];
  if (corridor.corridor.closed && steps_ > setting_out_steps) return;
  const auto x_of = [&](const road::RoadPosition& place) -> std::optional<double> {
    for (const auto& piece : corridor.corridor.pieces)
      if (piece.road == place.road) return traffic::x_of(roads_, corridor.corridor, place, piece.side);
    return std::nullopt;
  };
  const auto middle_x = x_of(middle);
  if (!middle_x) return;
  if (member.stay == Member::Stay::on_road) {
    if (corridor.corridor.closed) return;
    const auto x = member.place ? x_of(*member.place) : std::nullopt;
    if (x && std::abs(*x - *middle_x) < parameters_.radius_m + rim_m) return;
    leave(member);
  }
  const bool setting_out = steps_ <= setting_out_steps;
  if (member.stay == Member::Stay::asked_for) {
    if (++member.steps_waiting < (setting_out ? patient_steps_at_first : patient_steps)) return;
    leave(member);
  }
  if (setting_out) {
    for (int attempt = 0; attempt < 4 && running_ && member.stay == Member::Stay::outside; ++attempt)
      set_out_again(member, *middle_x);
    return;
  }
  const bool ahead = member.desired_speed_mps < middle_speed_mps;
  const bool this_side = random_.below(4) != 0;
  const double x = *middle_x + (ahead == this_side ? 1.0 : -1.0) * (parameters_.radius_m - random_.uniform(0.0, 40.0));
  if (x < rim_m || x > corridor.corridor.length_m - rim_m) return;
  const int lowest = corridor.table.lowest, highest = std::max(lowest, corridor.table.highest);
  const int lane = lowest + static_cast<int>(random_.below(static_cast<std::uint64_t>(highest - lowest + 1)));
  if (traffic::lane_end_m(corridor.table, lane, x) < x + 300.0) return;
  if (running_) enter(member, lane, x);
}

void SumoTraffic::place_foreign(std::span<const ForeignVehicle> foreign, double ahead_s) {
  for (const ForeignVehicle& vehicle : foreign) {
    if (std::ranges::find(given_up_, vehicle.id) != given_up_.end()) continue;
    const VehicleModel model = vehicle.shape();
    const Vec3 front = vehicle.world_from_vehicle * Vec3(model.front_m(), 0.0, 0.0) + ahead_s * vehicle.velocity_mps;
    if (std::ranges::find(told_, vehicle.id) == told_.end()) {
      if (network_.edges.empty()) return;
      told_.push_back(vehicle.id);
      const auto type = vehicle.adrift ? wreck_type_name(vehicle.id) : type_name(vehicle.id);
      ok(client_->define_type(
          {type, is_emergency(vehicle) ? "emergency" : "foreign", model.length_m, model.width_m, model.height_m, {}}));
      if (running_)
        ok(client_->add_vehicle(
            {.id = vehicle.id, .type = type, .route = {network_.edges.front().id}, .watched = false}));
    }
    if (running_)
      ok(client_->place_vehicle(vehicle.id, {front.x, front.y}, heading_rad(vehicle.world_from_vehicle.orientation)));
    if (!running_) return;
  }
}

void SumoTraffic::step(std::span<const ForeignVehicle> foreign) {
  const auto vehicles = client_->step();
  if (!vehicles) {
    ok(tl::unexpected(vehicles.error()));
    return;
  }
  ++steps_;
  given_up_.clear();
  before_ = std::move(after_);
  after_.clear();
  std::optional<road::Location> middle;  // Middle of the swarm: the first foreign vehicle.
  if (!foreign.empty()) middle = road::locate(roads_, Vec2(foreign.front().world_from_vehicle.position_m));
  auto seen = vehicles->begin();
  for (Member& member : members_) {
    while (seen != vehicles->end() && seen->id < member.id) ++seen;
    if (seen != vehicles->end() && seen->id == member.id) {
      const bool is_new = member.stay != Member::Stay::on_road;
      member.stay = Member::Stay::on_road;
      const double gained_mps = seen->speed_mps - member.speed_mps;
      if (auto participant = participant_of(member, *seen, is_new)) {
        const Participant* before = is_new ? nullptr : find_participant(before_, member.id);
        if (before) tell_sumo_motion(*before, gained_mps, *participant);
        after_.push_back(*participant);
      }
    } else if (member.stay == Member::Stay::on_road) {
      member.stay = Member::Stay::outside;  // It reached the end of its route.
    }
    if (middle) recycle(member, middle->position, glm::length(foreign.front().velocity_mps));
    if (!running_) return;
  }
  free_those_who_stand(foreign);
  make_remark();
}

void SumoTraffic::make_remark() {
  if (steps_ != setting_out_steps) return;
  const auto there = std::ranges::count(members_, Member::Stay::on_road, &Member::stay);
  remark_ = traffic::swarm_remark(parameters_.count, static_cast<std::size_t>(there));
}

void SumoTraffic::advance(std::span<const ForeignVehicle> foreign, double dt_s) {
  if (!running_) return;
  time_s_ += dt_s;
  phase_s_ += dt_s;
  while (running_ && phase_s_ > sumo_step_s - 1e-9) {
    phase_s_ -= sumo_step_s;
    place_foreign(foreign, sumo_step_s);
    if (running_) step(foreign);
  }
}

void SumoTraffic::append_participants(std::vector<Participant>& participants) const {
  auto before = before_.begin();
  for (const Participant& after : after_) {
    while (before != before_.end() && before->id < after.id) ++before;
    // A vehicle that has just entered is shown from the step on at which SUMO placed it.
    if (before == before_.end() || before->id != after.id) continue;
    participants.push_back(shown(interpolate(*before, after, sumo_step_s, phase_s_ / sumo_step_s)));
  }
}

void SumoTraffic::add_to_hash(StateHash& hash) const {
  hash.add(phase_s_);
  for (const auto* frame : {&before_, &after_})
    for (const Participant& participant : *frame) {
      hash.add(participant.id);
      for (int i = 0; i < 3; ++i) hash.add(participant.world_from_vehicle.position_m[i]);
      hash.add(participant.lamps.bits);
    }
  for (const Member& member : members_) hash.add(static_cast<int>(member.stay));
  for (const auto word : random_.state()) hash.add(word);
}

}  // namespace septet::server
