#include "engine/simulation/collisions.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/bodies/near_pairs.hpp"
#include "engine/simulation/car_impacts.hpp"
#include "engine/simulation/crash_poses.hpp"
#include "engine/simulation/crash_recording.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/solid_motion.hpp"
#include "engine/simulation/thrown_stage.hpp"

namespace septet::simulation {
namespace {

using Pair = std::pair<ParticipantId, ParticipantId>;

Pair pair_of(const BodyContact& contact) { return {contact.first, contact.second}; }

bool is_walker(ParticipantKind kind) { return kind == ParticipantKind::pedestrian; }

/// The speed of the first body's surface towards the second's, and of the second's towards the first's.
struct Approach {
  double first_mps = 0.0, second_mps = 0.0;
};
Approach approach_of(const impact::Body& first, const impact::Body& second, const impact::Place& place) {
  return {glm::dot(impact::velocity_at(first, place.point_m - first.mass_centre_m), place.normal),
          -glm::dot(impact::velocity_at(second, place.point_m - second.mass_centre_m), place.normal)};
}

/// One tick of all contacts.
class Contacts {
 public:
  Contacts(const Model& model, DrivenCar& car, std::vector<Participant>& participants, State& state,
           std::vector<Event>& events)
      : model_(model), car_(car), participants_(participants), state_(state), events_(events) {}

  void run() {
    std::vector<ParticipantId> loose;
    for (const LooseBody& body : state_.bodies.bodies) loose.push_back(body.id);
    // Who errs, or has just erred, may run into another of his engine.
    if (state_.traffic)
      for (const ParticipantId id : state_.traffic->erring()) loose.push_back(id);
    std::ranges::sort(loose);
    auto pairs = near_pairs(participants_, first_traffic_participant, loose);
    drop_contacts_of_the_gone();
    for (const BodyContact& contact : state_.bodies.contacts) {
      const std::pair known(index_of(contact.first), index_of(contact.second));
      if (const auto at = std::ranges::lower_bound(pairs, known); at == pairs.end() || *at != known)
        pairs.insert(at, known);
    }
    for (const auto& pair : pairs) look_at(pair.first, pair.second);
    free_pushed_solids(state_, participants_);
    state_.touching = std::move(touching_);
    note_poses(model_, participants_, state_);
    close_crashes(state_, events_);
  }

 private:
  std::size_t index_of(ParticipantId id) const {
    return static_cast<std::size_t>(find_participant(participants_, id) - participants_.data());
  }
  void drop_contacts_of_the_gone() {
    const auto is_here = [&](ParticipantId id) { return find_participant(participants_, id) != nullptr; };
    std::erase_if(state_.bodies.contacts,
                  [&](const BodyContact& contact) { return !is_here(contact.first) || !is_here(contact.second); });
  }

  bool is_driver(const Participant& one) const { return one.id == car_.participant.id; }
  bool is_pushed(const Participant& one) const { return is_driver(one) || find_loose(state_, one.id) != nullptr; }

  impact::Side side(const Participant& one) const {
    if (const LooseBody* loose = find_loose(state_, one.id)) return side_of(*loose);
    impact::Side side = impact_side(one, mass_kg(model_, one));
    if (is_driver(one)) {
      const double heading_rad = side.body.heading_rad;
      side.body = vehicle::planar_body(model_.car.body, state_.car);
      side.body.heading_rad = heading_rad;
    }
    return side;
  }

  impact::Due due_to(const Participant& one, const impact::Body& body, const BodyContact* besides) const {
    impact::Due due = due_of_contacts(state_, one.id, body, besides);
    const LooseBody* loose = find_loose(state_, one.id);
    if (!is_driver(one) && !loose) return due;
    if (!loose)
      for (const CarImpact& running : state_.impacts) impact::add_due(running.pulse, body, due);
    const impact::Due hull = vehicle::due_to_hull(loose ? loose->hull : state_.hull, body);
    due.velocity_mps += hull.velocity_mps;
    due.yaw_rate_radps += hull.yaw_rate_radps;
    due.runs = due.runs || hull.runs;
    return due;
  }

  /// The body as a contact has pushed it in this tick.
  void take(std::size_t index, const impact::Body& before, const impact::Body& after) {
    Participant& one = participants_[index];
    if (is_driver(one)) {
      vehicle::take_over(before, after, tick_s, state_.car);
      car_ = driven_car(model_, state_);
      one = car_.participant;
    } else if (LooseBody* loose = find_loose(state_, one.id)) {
      loose->body = after;
      loose->acceleration_mps2 += (after.velocity_mps - before.velocity_mps) / tick_s;
      one = participant_of(*loose);
    }
  }

  void look_at(std::size_t a, std::size_t b) {
    if (is_for_thrown_stage(state_, participants_[a], participants_[b])) return;
    const bool overlap = simulation::overlap(participants_[a], participants_[b]);
    const Pair ids(participants_[a].id, participants_[b].id);
    const auto known = std::ranges::lower_bound(state_.bodies.contacts, ids, {}, pair_of);
    const bool is_known = known != state_.bodies.contacts.end() && pair_of(*known) == ids;
    if (is_driver(participants_[a]) && overlap) touching_.push_back(ids.second);
    if (is_known && is_pushed(participants_[a]) && is_pushed(participants_[b])) {
      press(a, b, *known);
      const bool over =
          impact::is_over(known->engagement, side(participants_[a]).outline, side(participants_[b]).outline);
      if (over) state_.bodies.contacts.erase(known);
    } else if (is_known) {
      if (!overlap) state_.bodies.contacts.erase(known);
    } else if (overlap) {
      begin(a, b);
    }
  }

  std::optional<impact::Impact> press(std::size_t a, std::size_t b, BodyContact& contact) {
    impact::Side first = side(participants_[a]), second = side(participants_[b]);
    const impact::Side first_before = first, second_before = second;
    const Participant one = participants_[a], other = participants_[b];
    const auto rests = [](const impact::Body& body) {
      return body.velocity_mps == Vec2(0.0) && body.yaw_rate_radps == 0.0;
    };
    if (contact.engagement.pulses.empty() && rests(first.body) && rests(second.body)) return std::nullopt;
    const impact::Due due = due_to(participants_[a], first.body, &contact),
                      due_to_second = due_to(participants_[b], second.body, &contact);
    const impact::Ledger work_before = contact.engagement.ledger;
    const Vec2 given_before_ns = contact.engagement.given_ns;
    auto impact = impact::advance_engagement(impact::vehicle_friction(), tick_s, contact.engagement, first, second, due,
                                             due_to_second);
    take(a, first_before.body, first.body);
    take(b, second_before.body, second.body);
    OpenCrash* crash = find_open_crash(state_, contact.first, contact.second);
    if (impact && begins_record(crash, impact->pulse.impulse.closing_mps)) {
      // A second blow dents and breaks as the first one did (begin).
      if (crash || given_before_ns != Vec2(0.0))
        state_.effects.crashes.struck_vehicles.push_back(crash_of(one, other, *impact));
      crash = &open(one, other, first_before, second_before, *impact);
    }
    if (!crash || contact.engagement.given_ns == given_before_ns) return impact;
    note_push(state_.tick,
              {first.body, second.body, contact.engagement.given_ns - given_before_ns,
               impact::difference(contact.engagement.ledger, work_before)},
              *crash);
    note_crush(contact.engagement, first, second, *crash);
    return impact;
  }

  /// Begins the record of two that meet; `first` and `second` as they are before the first push.
  OpenCrash& open(const Participant& a, const Participant& b, const impact::Side& first, const impact::Side& second,
                  const impact::Impact& impact) {
    OpenCrash& crash = open_crash(
        {a.id, b.id, impact.touch.place, contact_height_m(body_box(a), body_box(b)), impact.pulse.impulse.closing_mps},
        state_);
    crash.record.sliding_mps = impact.pulse.impulse.sliding_mps;
    note_overlap(first, second, crash);
    const bool both = is_pushed(a) && is_pushed(b);
    note_first(first.body, mass_centre_ahead_m(model_, a), both || is_driver(a), crash);
    note_second(second.body, mass_centre_ahead_m(model_, b), both, crash);
    crash.has_ledger = both;
    return crash;
  }

  /// The touch of two that have been apart, or have not approached each other yet.
  void begin(std::size_t a, std::size_t b) {
    const Participant first = participants_[a], second = participants_[b];
    const ParticipantKind first_kind = vehicle_models()[first.model].kind,
                          second_kind = vehicle_models()[second.model].kind;
    if (is_walker(first_kind) && is_walker(second_kind)) return;
    // Placed in each other (a tractor and its trailer): they belong together until they are apart.
    if (state_.tick <= 1 && !is_driver(first)) return insert({first.id, second.id, {}});
    const impact::Side own = side(first), other = side(second);
    const auto impact = impact::meet(own, other, impact::vehicle_friction(), tick_s, due_to(first, own.body, nullptr),
                                     due_to(second, other.body, nullptr));
    const bool is_new = !is_driver(first) || !std::ranges::binary_search(state_.touching, second.id);
    if (!impact) {
      if (is_driver(first) && is_new) tell(first, second, own, other, nullptr);
      return;
    }
    // Here it is decided what becomes of those that are hit: a body, or somebody who stays on the rails.
    const bool bodies = may_loosen(first) && may_loosen(second) && loosen(second) && loosen(first);
    if (!bodies && is_driver(first) && !is_new) return;
    if (bodies || !is_driver(first)) {
      BodyContact contact{first.id, second.id, {}};
      if (bodies) press(a, b, contact);
      insert(std::move(contact));
    } else {
      begin_impact(model_, first, second, state_);
    }
    if (begins_record(find_open_crash(state_, first.id, second.id), impact->pulse.impulse.closing_mps))
      open(first, second, own, other, *impact);
    if (is_new) tell(first, second, own, other, &*impact);
    state_.effects.crashes.struck_vehicles.push_back(crash_of(first, second, *impact));
  }

  bool may_loosen(const Participant& one) const { return is_pushed(one) || may_leave_rails(model_, one); }
  /// True where it is, or becomes, a body that contacts push.
  bool loosen(const Participant& one) {
    return is_pushed(one) || leave_rails(model_, one, car_.participant, state_, events_);
  }

  void insert(BodyContact contact) {
    auto& contacts = state_.bodies.contacts;
    contacts.insert(std::ranges::lower_bound(contacts, pair_of(contact), {}, pair_of), std::move(contact));
  }

  VehicleCrash crash_of(const Participant& first, const Participant& second, const impact::Impact& impact) const {
    const auto crashed = [&](const Participant& one) {
      return CrashedVehicle{one.id, mass_kg(model_, state_, one), one.velocity_mps, one.angular_velocity_radps};
    };
    VehicleCrash crash;
    crash.first = crashed(first);
    crash.second = crashed(second);
    crash.point_m = Vec3(impact.touch.place.point_m, contact_height_m(body_box(first), body_box(second)));
    crash.normal = Vec3(-impact.touch.place.normal, 0.0);
    crash.closing_speed_mps = impact.pulse.impulse.closing_mps;
    return crash;
  }

  /// Logs a touch. Whose crash it was: of the one whose surface came on faster.
  void tell(const Participant& first, const Participant& second, const impact::Side& own, const impact::Side& other,
            const impact::Impact* impact) {
    double closing_mps = 0.0, impulse_ns = 0.0;
    Approach approach;
    if (impact) {
      closing_mps = impact->pulse.impulse.closing_mps;
      impulse_ns = glm::length(impact->pulse.impulse.on_second_ns);
      approach = approach_of(own.body, other.body, impact->touch.place);
    }
    const bool by_first = approach.first_mps >= approach.second_mps;
    if (is_driver(first)) {
      ++state_.diagnostics.collisions;
      const char* by = !impact ? "nobody" : by_first ? "driver" : "other";
      events_.push_back({"collision", second.id,
                         fmt::format("closing_speed_mps={:.2f} delta_v_mps={:.2f} by={}", closing_mps,
                                     impulse_ns / own.body.mass_kg, by)});
      return;
    }
    events_.push_back({"crash_of_others", first.id,
                       fmt::format("with={} closing_speed_mps={:.2f} delta_v_mps={:.2f} its_delta_v_mps={:.2f} by={}",
                                   second.id, closing_mps, impulse_ns / own.body.mass_kg,
                                   impulse_ns / other.body.mass_kg, by_first ? first.id : second.id)});
  }

  const Model& model_;
  DrivenCar& car_;
  std::vector<Participant>& participants_;
  State& state_;
  std::vector<Event>& events_;
  std::vector<ParticipantId> touching_;
};

}  // namespace

void find_collisions(const Model& model, DrivenCar& car, std::vector<Participant>& participants, State& state,
                     std::vector<Event>& events) {
  Contacts(model, car, participants, state, events).run();
}

}  // namespace septet::simulation
