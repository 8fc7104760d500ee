#include "sim-client/film/accident/accident_facts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/outline.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/rider.hpp"
#include "engine/world/solid.hpp"
#include "logging/session/participants.hpp"
#include "logging/study/measures/collisions.hpp"
#include "logging/study/measures/crashes.hpp"

namespace septet::film {
namespace {

constexpr double same_instant_s = 1e-6;

/// Contacts of the driver's car, and of two others.
bool tells_contact(const logging::Event& event) { return event.kind == "collision" || event.kind == "crash_of_others"; }

WayPoint way_point(const Participant& participant, double time_s) {
  return {time_s, participant.world_from_vehicle.position_m, heading_rad(participant.world_from_vehicle.orientation),
          glm::length(Vec2(participant.velocity_mps))};
}

/// Somebody's body: a rectangle in plan, of their own length and width, from the ground to their height.
struct Standing {
  impact::Outline outline;
  double low_m = 0.0, high_m = 0.0;
};

Standing standing(const Participant& participant) {
  const VehicleModel shape = shape_of(participant);
  const RigidTransform& place = participant.world_from_vehicle;
  const double heading = heading_rad(place.orientation);
  return {
      impact::box_outline(Vec2(place * Vec3(shape.centre_x_m(), 0.0, 0.0)), Vec2(std::cos(heading), std::sin(heading)),
                          0.5 * Vec2(shape.length_m, shape.width_m), 0.0),
      place.position_m.z, place.position_m.z + shape.height_m};
}

/// Below zero: the outlines overlap so far. One who is on a bridge is as far from who is below it as the bridge is high.
double distance_m(const Standing& one, const Standing& other) {
  const double in_plan_m = impact::nearest(one.outline, other.outline).gap_m;
  const double above_m = std::max(one.low_m - other.high_m, other.low_m - one.high_m);
  return above_m > 0.0 ? std::hypot(std::max(0.0, in_plan_m), above_m) : in_plan_m;
}

/// No outlines of these two are nearer than this.
double least_distance_m(const Standing& one, const Standing& other) {
  return glm::length(one.outline.centre_m - other.outline.centre_m) - glm::length(one.outline.half_m) -
         glm::length(other.outline.half_m);
}

/// The two that came nearest, and when: the driver's car and another one, or without it somebody whom the scenario
/// names and another one.
struct NearestTwo {
  std::optional<ParticipantId> first, second;
  double time_s = 0.0, distance_m = std::numeric_limits<double>::infinity();
};

void look_for_nearest(const Snapshot& world, const logging::ParticipantNames& names, NearestTwo& nearest) {
  const bool has_driver = find_participant(world, world.driver_car.participant) != nullptr;
  for (const Participant& one : world.participants) {
    if (has_driver ? one.id != world.driver_car.participant : !names.contains(one.id)) continue;
    if (!nearest.first) nearest.first = one.id, nearest.time_s = world.simulated_time_s;
    const Standing own = standing(one);
    for (const Participant& other : world.participants) {
      if (other.id == one.id) continue;
      const Standing its = standing(other);
      if (least_distance_m(own, its) >= nearest.distance_m) continue;
      const double apart_m = distance_m(own, its);
      if (apart_m < nearest.distance_m) nearest = {one.id, other.id, world.simulated_time_s, apart_m};
    }
  }
}

/// Calls `visit` with each snapshot between the two instants.
template <class Visit>
Expected<void> for_each_world(const logging::SessionReader& session, std::pair<double, double> span_s,
                              const Visit& visit) {
  auto cursor = session.snapshots_from(span_s.first);
  if (!cursor) return tl::unexpected(cursor.error());
  for (;;) {
    const auto world = cursor->next();
    if (!world) return tl::unexpected(world.error());
    if (!*world || (*world)->simulated_time_s > span_s.second + same_instant_s) return {};
    if ((*world)->simulated_time_s >= span_s.first - same_instant_s) visit(**world);
  }
}

MovedBy driven_by(const AccidentFacts& facts) {
  if (!facts.table.empty()) return MovedBy::table;
  return facts.driver.empty() ? MovedBy::person : MovedBy::simulated_driver;
}

/// First snapshot's driver.
Expected<ParticipantId> driver_of(const logging::SessionReader& session) {
  auto cursor = session.snapshots();
  if (!cursor) return tl::unexpected(cursor.error());
  const auto world = cursor->next();
  if (!world) return tl::unexpected(world.error());
  return *world ? (*world)->driver_car.participant : 0;
}

}  // namespace

Contact contact_of(const logging::Event& event, ParticipantId driver) {
  Contact contact{.time_s = event.simulated_time_s,
                  .first = driver,
                  .second = event.participant,
                  .stands = {},
                  .closing_mps = logging::number_in_detail(event.detail, "closing_speed_mps"),
                  .delta_v_mps = logging::number_in_detail(event.detail, "delta_v_mps")};
  const auto with = logging::number_in_detail(event.detail, "with");
  if (event.participant && with && *with >= 0.0 && *with <= std::numeric_limits<ParticipantId>::max())
    contact.first = *event.participant, contact.second = static_cast<ParticipantId>(*with);
  if (contact.second) contact.stands = struck_by_name(event.detail).value_or("");
  const bool is_wreck = event.kind == "crash_of_others" && event.participant && !with;
  if (is_wreck) contact.first = *event.participant, contact.second = std::nullopt;
  if (!event.participant || is_wreck) {
    // "guard rail closing_speed_mps=…": what stands is told before the first key.
    std::string words = event.detail.substr(0, event.detail.find('='));
    words.erase(std::min(words.size(), words.find_last_of(' ') == std::string::npos ? 0 : words.find_last_of(' ')));
    contact.stands = words.empty() ? "something that stands" : words;
  }
  return contact;
}

std::string name_of(const Involved& involved) {
  return involved.name.empty() ? std::to_string(involved.number) : involved.name;
}

Expected<AccidentFacts> read_accident(const logging::SessionReader& session, std::optional<std::size_t> event) {
  AccidentFacts facts;
  const auto span_s = session.shown_span_s();
  if (!span_s) return tl::unexpected(span_s.error());
  facts.session_s = *span_s;
  const auto names = logging::participant_names(session);
  if (!names) return tl::unexpected(names.error());
  const auto driver = driver_of(session);
  if (!driver) return tl::unexpected(driver.error());
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  const auto crashes = logging::find_crashes(*events);
  for (const logging::Event& one : *events) {
    if (!tells_contact(one) || one.simulated_time_s < span_s->first || one.simulated_time_s > span_s->second) continue;
    facts.contacts.push_back(contact_of(one, *driver));
    facts.contacts.back().crash = logging::crash_of(one, crashes);
  }
  std::ranges::stable_sort(facts.contacts, {}, &Contact::time_s);
  if (event && (*event < 1 || *event > facts.contacts.size()))
    return failure(facts.contacts.empty() ? std::string("the log tells of no contact")
                                          : fmt::format("the log tells of {} contacts", facts.contacts.size()),
                   fmt::format("--event {}", *event),
                   facts.contacts.empty() ? "leave --event out: the nearest approach is filmed"
                                          : fmt::format("choose 1 to {}", facts.contacts.size()));
  std::vector<ParticipantId> numbers;
  double middle_s = span_s->second;
  if (!facts.contacts.empty()) {
    facts.chosen = event.value_or(1) - 1;
    const Contact& contact = facts.contacts[*facts.chosen];
    middle_s = contact.time_s;
    numbers.push_back(contact.first);
    if (contact.second && *contact.second != contact.first) numbers.push_back(*contact.second);
  } else {
    NearestTwo nearest;
    const auto looked = for_each_world(session, *span_s, [&](const Snapshot& world) {
      if (logging::is_sample_due(world.tick, session.info().ticks_per_second)) look_for_nearest(world, *names, nearest);
    });
    if (!looked) return tl::unexpected(looked.error());
    if (!nearest.first)
      return failure("it holds neither a driver's car nor anybody whom a scenario names", session.path().string(),
                     "film it by a script of your own: septet film --shots");
    numbers.push_back(*nearest.first);
    if (nearest.second) {
      numbers.push_back(*nearest.second);
      facts.nearest_s = middle_s = nearest.time_s;
      facts.nearest_m = std::max(0.0, nearest.distance_m);
    }
  }
  facts.window_s = {std::max(span_s->first, middle_s - before_contact_s),
                    std::min(span_s->second, middle_s + after_contact_s)};
  const logging::SessionInfo& info = session.info();
  const auto table = std::ranges::find(info.files, "motion", &logging::SourceFile::role);
  if (table != info.files.end()) facts.table = table->name;
  // Who was to drive is logged also where a table moved the car.
  const auto kind = info.other.find("driver");
  if (kind != info.other.end() && facts.table.empty()) facts.driver = kind->second;
  const auto changes = info.other.find("what_if_changes");
  if (changes != info.other.end()) facts.changes = changes->second;
  for (const ParticipantId number : numbers) {
    const auto name = names->find(number);
    facts.involved.push_back({.number = number, .name = name == names->end() ? std::string() : name->second});
    Involved& one = facts.involved.back();
    // A number serves several things; the contact's own name is of its time.
    if (is_solid(number) && facts.chosen && !facts.contacts[*facts.chosen].stands.empty())
      one.name = facts.contacts[*facts.chosen].stands;
    one.moved_by = is_solid(number)       ? MovedBy::editor
                   : number == *driver    ? driven_by(facts)
                   : name != names->end() ? MovedBy::scenario
                                          : MovedBy::traffic;
  }
  std::map<ParticipantId, Involved> others;
  const auto read = for_each_world(session, facts.window_s, [&](const Snapshot& world) {
    const Participant* first = find_participant(world, numbers.front());
    for (const Participant& participant : world.participants) {
      const auto one = std::ranges::find(facts.involved, machine_of(participant.id), &Involved::number);
      const bool is_left_machine = one != facts.involved.end() && find_person(world, one->number) != &participant;
      const WayPoint point = way_point(participant, world.simulated_time_s);
      if (one != facts.involved.end() && !is_left_machine) {
        if (participant.id == one->number) one->model = participant.model, one->box_size_m = box_size_of(participant);
        one->way.push_back(point);
      } else if (first && glm::length(first->world_from_vehicle.position_m - point.position_m) < bystanders_within_m) {
        Involved& other = others[participant.id];
        other.number = participant.id, other.model = participant.model, other.box_size_m = box_size_of(participant);
        other.way.push_back(point);
      }
    }
  });
  for (auto& [number, other] : others) facts.bystanders.push_back(std::move(other));
  if (!read) return tl::unexpected(read.error());
  std::erase_if(facts.involved, [](const Involved& one) { return one.way.empty(); });
  if (facts.involved.empty())
    return failure("nobody of the contact is in the session around it", session.path().string(),
                   "choose another contact with --event");
  return facts;
}

}  // namespace septet::film
