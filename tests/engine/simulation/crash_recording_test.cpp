// What the record of a crash tells is what the bodies did: their changes of motion, the crush, the energies.

#include "engine/simulation/crash_recording.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/impulse.hpp"
#include "engine/physics/impact/meet.hpp"
#include "engine/physics/impact/outline.hpp"
#include "engine/physics/impact/pulse.hpp"
#include "engine/physics/impact/restitution.hpp"
#include "engine/simulation/broken_off.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/relative.hpp"

namespace septet::simulation {
namespace {

constexpr ParticipantId first_struck = first_scripted_participant + 1;
constexpr double quarter_rad = 0.5 * 3.141592653589793;

struct Pair {
  const char* name;
  const char* first_model;
  double first_mps;
  const char* second_model;
  double x_m, y_m, heading_rad, second_mps;
};
const std::vector<Pair> pairs{{"rear end", "saloon", 14.0, "saloon", 8.0, 0.3, 0.0, 0.0},
                              {"into the side", "saloon", 13.5, "saloon", 11.0, -9.0, quarter_rad, 12.0},
                              {"offset head-on", "saloon", 15.0, "van", 30.0, 0.9, 2.0 * quarter_rad, 10.0},
                              {"oblique", "van", 18.0, "saloon", 16.0, -5.0, 0.6, 8.0},
                              {"lorry behind", "lorry", 12.0, "saloon", 14.0, -0.5, 0.0, 3.0},
                              {"a slow one", "saloon", 1.5, "saloon", 5.2, 0.0, 0.0, 0.0}};

/// A pair that has crashed, with both bodies before the touch and after the last push.
struct Crashed {
  CrashRecord record;
  impact::Body before[2], after[2];
  double deepest_m = 0.0;  ///< Overlap of the whole outlines along the record's normal.
};

std::optional<CrashRecord> record_among(const std::vector<Event>& events) {
  const auto found = std::ranges::find(events, crash_event, &Event::kind);
  return found == events.end() ? std::nullopt : read_crash(*found->participant, found->detail);
}

Crashed crashed(CrashSite& site, bool with_wheels, std::size_t first, std::size_t second) {
  Crashed pair;
  std::vector<std::array<impact::Body, 2>> bodies;
  std::vector<std::array<impact::Outline, 2>> outlines;
  for (int i = 0; i < 600 && site.count(crash_event) == 0; ++i) {
    site.tick(with_wheels);
    const Participant &a = site.participants[first], &b = site.participants[second];
    bodies.push_back({site.body_of(a), site.body_of(b)});
    outlines.push_back({impact_side(a, 1.0).outline, impact_side(b, 1.0).outline});
  }
  const auto record = record_among(site.events);
  REQUIRE(record.has_value());
  pair.record = *record;
  for (std::size_t i = 0; i < 2; ++i) {
    pair.before[i] = bodies[record->tick - 2][i];
    pair.after[i] = bodies[record->tick + record->ticks - 1][i];
  }
  const Vec2 normal(std::cos(record->normal_rad), std::sin(record->normal_rad));
  for (Tick tick = record->tick; tick <= record->tick + record->ticks; ++tick) {
    const auto& [a, b] = outlines[tick - 1];
    pair.deepest_m = std::max(pair.deepest_m, impact::reach_m(a, normal) + impact::reach_m(b, -normal) -
                                                  glm::dot(b.centre_m - a.centre_m, normal));
  }
  return pair;
}

CrashSite site_of(const Pair& pair) {
  return CrashSite(
      {placed_participant(first_struck, pair.first_model, 0.0, 0.0, 0.0, pair.first_mps),
       placed_participant(first_struck + 1, pair.second_model, pair.x_m, pair.y_m, pair.heading_rad, pair.second_mps)});
}

}  // namespace

TEST_CASE("the ledger of every pair closes to 0.1 %, each part reckoned by itself, wheels or none") {
  for (const Pair& pair : pairs)
    for (const bool with_wheels : {true, false}) {
      CAPTURE(std::string(pair.name));
      CrashSite site = site_of(pair);
      const Crashed told = crashed(site, with_wheels, 1, 2);
      REQUIRE(told.record.ledger.has_value());
      const CrashLedger& ledger = *told.record.ledger;
      MESSAGE(std::string(pair.name) << ": kinetic " << ledger.kinetic_before_j << " to " << ledger.kinetic_after_j
                                     << " J, crush " << ledger.crush_j << ", friction " << ledger.friction_j
                                     << ", wheels " << ledger.wheels_j << ", missing " << share_missing(ledger));
      CHECK(share_missing(ledger) < 0.001);
      CHECK(ledger.crush_j > 0.0);
      CHECK(ledger.friction_j >= 0.0);
      if (with_wheels)
        CHECK(ledger.wheels_j > 0.0);
      else
        CHECK(std::abs(ledger.wheels_j) < 1e-6 * ledger.kinetic_before_j);
      // The kinetic energies are those of the bodies' own motion.
      const auto kinetic_j = [](const impact::Body* bodies) {
        double sum_j = 0.0;
        for (const impact::Body* body : {bodies, bodies + 1})
          sum_j += 0.5 * body->mass_kg * glm::dot(body->velocity_mps, body->velocity_mps) +
                   0.5 * body->yaw_inertia_kgm2 * body->yaw_rate_radps * body->yaw_rate_radps;
        return sum_j;
      };
      CHECK(ledger.kinetic_before_j == relative(kinetic_j(told.before), 1e-6));
      CHECK(ledger.kinetic_after_j == relative(kinetic_j(told.after), 1e-6));
    }
}

TEST_CASE("changes of velocity and of yaw rate are those of the bodies, and the pulse is their momentum") {
  for (const Pair& pair : pairs) {
    CAPTURE(std::string(pair.name));
    CrashSite site = site_of(pair);
    const Crashed told = crashed(site, false, 1, 2);
    const CrashedBody* sides[] = {&told.record.of_first, &told.record.of_second};
    for (std::size_t i = 0; i < 2; ++i) {
      REQUIRE(sides[i]->delta_v_mps.has_value());
      CHECK(glm::distance(*sides[i]->delta_v_mps, told.after[i].velocity_mps - told.before[i].velocity_mps) < 1e-6);
      CHECK(std::abs(*sides[i]->delta_yaw_rate_radps - told.after[i].yaw_rate_radps + told.before[i].yaw_rate_radps) <
            1e-6);
      CHECK(*sides[i]->mass_kg == told.before[i].mass_kg);
    }
    const auto impulse = impulse_ns(told.record);
    REQUIRE(impulse.has_value());
    CHECK(told.record.pulse_ns.size() == told.record.ticks + 1);
    const Vec2 second_ns = *told.record.of_second.mass_kg * *told.record.of_second.delta_v_mps;
    CHECK(glm::distance(*impulse, second_ns) < 1e-4 * glm::length(second_ns));
  }
}

TEST_CASE(
    "in a drive without tyres ΔV and Δω are those of the closed form's instants, within 2 %, contact by contact") {
  for (const Pair& pair : pairs) {
    CAPTURE(std::string(pair.name));
    CrashSite site = site_of(pair);
    std::vector<Participant> free = site.participants;
    while (site.state.open_crashes.empty() && site.state.tick < 600) {
      free = site.participants;
      site.tick(false);
    }
    REQUIRE_FALSE(site.state.open_crashes.empty());
    // Both at the end of the tick in which they touch, as if nobody were in their way.
    const auto side = [&](Participant one) {
      one.world_from_vehicle.position_m += tick_s * one.velocity_mps;
      return impact_side(one, mass_kg(site.model, one));
    };
    const impact::Side first = side(free[1]), second = side(free[2]);
    const auto impact = impact::meet(first, second, impact::vehicle_friction(), tick_s);
    REQUIRE(impact.has_value());
    impact::Body instant[] = {first.body, second.body};
    impact::exchange(impact->pulse.impulse, 1.0, instant[0], instant[1]);
    // Where they meet again before that is over, the next instant is reckoned from the one before, at the drive's place.
    std::vector<Vec2> met_ns{impact->pulse.impulse.on_second_ns};
    double left_s = impact::duration_s(impact->pulse);
    for (; left_s > 0.0; left_s -= tick_s) {
      site.tick(false);
      REQUIRE_FALSE(site.state.bodies.contacts.empty());
      for (const impact::Pulse& pulse : site.state.bodies.contacts.front().engagement.pulses) {
        const impact::Impulse& told = pulse.impulse;
        const auto is_known = [&](const Vec2& known_ns) {
          return glm::distance(known_ns, told.on_second_ns) < 0.02 * glm::length(known_ns);
        };
        if (std::ranges::any_of(met_ns, is_known)) continue;
        met_ns.push_back(told.on_second_ns);
        instant[0].mass_centre_m = -told.first_arm_m, instant[1].mass_centre_m = -told.second_arm_m;
        const auto again = impact::impulse_at(instant[0], instant[1], {Vec2(0.0), pulse.normal},
                                              {pulse.restitution, impact::vehicle_friction(), told.stopped_mps});
        REQUIRE(again.has_value());
        impact::exchange(*again, 1.0, instant[0], instant[1]);
        left_s = std::max(left_s, impact::duration_s(pulse) - pulse.age_s + tick_s);
      }
    }
    CHECK(met_ns.size() == (std::string(pair.name) == "into the side" ? 2 : 1));
    const impact::Body* before[] = {&first.body, &second.body};
    for (std::size_t i = 0; i < 2; ++i) {
      const impact::Body after = site.body_of(site.participants[1 + i]);
      const Vec2 delta_v_mps = instant[i].velocity_mps - before[i]->velocity_mps;
      const double turned_radps = instant[i].yaw_rate_radps - before[i]->yaw_rate_radps;
      const double missed_mps = glm::distance(after.velocity_mps, instant[i].velocity_mps);
      const double missed_radps = std::abs(after.yaw_rate_radps - instant[i].yaw_rate_radps);
      MESSAGE(std::string(pair.name) << ", contacts " << met_ns.size() << ": of ΔV " << glm::length(delta_v_mps)
                                     << " m/s missed " << missed_mps << ", of Δω " << turned_radps << " rad/s "
                                     << missed_radps);
      CHECK(missed_mps < 0.02 * glm::length(delta_v_mps));
      CHECK(missed_radps < 0.02 * std::max(std::abs(turned_radps), 0.1));
    }
  }
}

TEST_CASE(
    "the crush of two that do not turn is the depth to which their outlines came into each other, within a "
    "centimetre") {
  for (const std::size_t straight : {0u, 4u, 5u}) {
    const Pair& pair = pairs[straight];
    CAPTURE(std::string(pair.name));
    CrashSite site = site_of(pair);
    const Crashed told = crashed(site, false, 1, 2);
    REQUIRE(told.record.of_first.crush_m.has_value());
    const double crush_m = *told.record.of_first.crush_m + *told.record.of_second.crush_m;
    MESSAGE(std::string(pair.name) << ": crush " << crush_m << " m, depth " << told.deepest_m << " m");
    CHECK(crush_m > 0.0);
    CHECK(std::abs(crush_m - told.deepest_m) < 0.01);
  }
}

TEST_CASE("the principal direction is whence the blow came: ahead for who runs into another, behind for him") {
  CrashSite rear = site_of(pairs[0]);
  const CrashRecord behind = crashed(rear, true, 1, 2).record;
  CHECK(std::abs(*behind.of_first.principal_direction_rad) < 0.05);
  CHECK(std::abs(*behind.of_second.principal_direction_rad) > 3.0);
  CHECK(behind.overlap_share.value_or(0.0) == relative(1.0 - 0.3 / 1.82, 0.05));
  CrashSite across = site_of(pairs[1]);
  const CrashRecord side = crashed(across, true, 1, 2).record;
  // Who drives to the left across the other's way is hit from his left.
  CHECK(*side.of_second.principal_direction_rad > 0.5);
  CHECK(*side.of_second.principal_direction_rad < 2.6);
}

TEST_CASE("a crash of the driver's car is recorded as any other, in the same words") {
  CrashSite site(plane_model(1), {{0.0, 0.0, 0.0}, {}}, 15.0,
                 {placed_participant(first_struck, "saloon", 12.0, 0.4, 0.0, 0.0)});
  const Crashed told = crashed(site, false, 0, 1);
  CHECK(told.record.first == driver_participant);
  CHECK(told.record.second == first_struck);
  REQUIRE(told.record.ledger.has_value());
  CHECK(share_missing(*told.record.ledger) < 0.001);
  CHECK(*told.record.of_first.mass_kg == site.model.car.body.mass_kg);
  CHECK(*told.record.of_first.yaw_inertia_kgm2 == site.model.car.body.inertia_kgm2.z);
  CHECK(glm::distance(*told.record.of_first.delta_v_mps, told.after[0].velocity_mps - told.before[0].velocity_mps) <
        1e-6);
  CHECK(told.record.closing_speed_mps == relative(15.0, 1e-3));
}

TEST_CASE("two that stay on their rails have a record without what nobody measured") {
  CrashSite site({placed_participant(first_struck, "motorcycle", 0.0, 0.0, 0.0, 10.0),
                  placed_participant(first_struck + 1, "pedestrian", 6.0, 0.2, 0.0, 0.0)});
  for (int i = 0; i < 120; ++i) site.tick();
  const auto record = record_among(site.events);
  REQUIRE(record.has_value());
  CHECK(record->closing_speed_mps == relative(10.0, 0.01));
  CHECK(record->of_first.before_mps.has_value());
  CHECK_FALSE(record->of_first.delta_v_mps.has_value());
  CHECK_FALSE(record->of_second.delta_v_mps.has_value());
  CHECK_FALSE(record->ledger.has_value());
  CHECK(record->pulse_ns.empty());
}

TEST_CASE("the depth of a crash is how far the outlines came into each other until the last push, by their poses") {
  for (const Pair& pair : pairs) {
    CAPTURE(std::string(pair.name));
    CrashSite site = site_of(pair);
    double deepest_m = 0.0, told_until_m = 0.0;
    for (int i = 0; i < 600 && site.count(crash_event) == 0; ++i) {
      site.tick();
      const auto outline = [&](std::size_t of) { return impact_side(site.participants[of], 1.0).outline; };
      deepest_m = std::max(deepest_m, -impact::nearest(outline(1), outline(2)).gap_m);
      if (!site.state.open_crashes.empty() && site.state.open_crashes.front().last_push == site.state.tick)
        told_until_m = deepest_m;
    }
    const auto record = record_among(site.events);
    REQUIRE(record.has_value());
    CHECK(record->depth_m.value_or(0.0) == relative(told_until_m, 1e-6));
    CHECK(told_until_m > 0.01);
  }
}

TEST_CASE("what breaks off of two others pushes both, and what it took stands in the ledger, which closes") {
  CrashSite site = site_of(pairs[0]);
  while (site.state.open_crashes.empty()) site.tick();
  const auto body = [&](std::size_t of) { return site.body_of(site.participants[of]); };
  const impact::Body before[] = {body(1), body(2)};
  const BrokenOff broken{.first = first_struck,
                         .second = first_struck + 1,
                         .on_first_ns = Vec3(-60.0, 5.0, -20.0),
                         .on_second_ns = Vec3(30.0, 0.0, 0.0),
                         .kinetic_j = 250.0};
  give_back(broken, {}, site.participants, site.state);
  CHECK(glm::distance(body(1).velocity_mps - before[0].velocity_mps, Vec2(-60.0, 5.0) / before[0].mass_kg) < 1e-12);
  CHECK(glm::distance(body(2).velocity_mps - before[1].velocity_mps, Vec2(30.0, 0.0) / before[1].mass_kg) < 1e-12);
  CHECK(Vec2(site.participants[1].velocity_mps) ==
        Vec2(participant_of(*find_loose(site.state, first_struck)).velocity_mps));
  const double lost_j = impact::kinetic_loss_j(before[0], body(1)) + impact::kinetic_loss_j(before[1], body(2));
  while (site.count(crash_event) == 0) site.tick();
  const auto record = record_among(site.events);
  REQUIRE(record.has_value());
  REQUIRE(record->ledger.has_value());
  CHECK(record->ledger->debris_j == relative(lost_j, 1e-6));
  CHECK(record->pieces_kinetic_j.value_or(0.0) == 250.0);
  CHECK(share_missing(*record->ledger) < 0.001);
}

TEST_CASE("a touch after which nothing pushes tells no change of motion, and no energies") {
  CrashSite site(plane_model(1), {{0.0, 0.0, 0.0}, {}}, 0.9,
                 {placed_participant(first_struck, "pedestrian", 4.2, 0.2, 0.0, 0.0)});
  for (int i = 0; i < 300 && site.count(crash_event) == 0; ++i) site.tick();
  const auto record = record_among(site.events);
  REQUIRE(record.has_value());
  CHECK(record->of_first.before_mps.has_value());
  CHECK_FALSE(record->of_first.delta_v_mps.has_value());
  CHECK_FALSE(record->of_first.delta_yaw_rate_radps.has_value());
  CHECK_FALSE(record->depth_m.has_value());
  CHECK_FALSE(record->ledger.has_value());
}

TEST_CASE("the record of a crash that goes on is told as far as it is, and once more when it is over") {
  CrashSite site = site_of(pairs[0]);
  while (site.state.open_crashes.empty()) site.tick();
  for (int i = 0; i < 3; ++i) site.tick();
  const auto so_far = record_among(unfinished_crashes(site.state));
  REQUIRE(so_far.has_value());
  CHECK(so_far->is_unfinished);
  CHECK(so_far->pulse_ns.size() == 4);
  REQUIRE(so_far->of_first.delta_v_mps.has_value());
  while (site.count(crash_event) == 0) site.tick();
  const auto whole = record_among(site.events);
  REQUIRE(whole.has_value());
  CHECK_FALSE(whole->is_unfinished);
  CHECK(glm::length(*whole->of_first.delta_v_mps) > glm::length(*so_far->of_first.delta_v_mps));
}

TEST_CASE("five that pile up are told pair by pair, and every ledger closes") {
  std::vector<Participant> row;
  for (ParticipantId i = 0; i < 5; ++i)
    row.push_back(placed_participant(first_struck + i, "saloon", -12.0 * i, 0.25 * (i % 3), 0.0, i == 0 ? 0.0 : 22.0));
  CrashSite site(row);
  for (int i = 0; i < 900; ++i) site.tick();
  int told = 0;
  for (const Event& event : site.events) {
    if (event.kind != crash_event) continue;
    const auto record = read_crash(*event.participant, event.detail);
    REQUIRE(record.has_value());
    REQUIRE(record->ledger.has_value());
    CHECK(share_missing(*record->ledger) < 0.001);
    ++told;
  }
  CHECK(told >= 4);
  CHECK(site.state.open_crashes.empty());
}

TEST_CASE(
    "a car that pushes another for seconds is one crash with its contact's time, and a blow after they parted a "
    "second") {
  CrashSite site(plane_model(1), {{0.0, 0.0, 0.0}, {}}, 4.0,
                 {placed_participant(first_struck, "saloon", 5.5, 0.0, 0.0, 0.0)});
  const auto drive_at = [&](double mps, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      site.state.car.velocity_mps = Vec3(mps + 0.01 * i, 0.0, 0.0);
      site.tick();
    }
  };
  drive_at(4.0, 200);
  CHECK(site.count(crash_event) == 0);
  CHECK_FALSE(is_impact_running(site.state));
  const auto so_far = record_among(unfinished_crashes(site.state));
  REQUIRE(so_far.has_value());
  CHECK_FALSE(so_far->is_unfinished);
  CHECK(so_far->contact_s.value_or(0.0) > 1.0);
  // It is told two seconds after the touch, and not again at the end of a drive.
  drive_at(6.0, 400);
  CHECK(site.count(crash_event) == 1);
  CHECK(site.state.open_crashes.size() == 1);
  CHECK(unfinished_crashes(site.state).empty());
  drive_at(-3.0, 120);
  CHECK(site.count(crash_event) == 1);
  CHECK(site.state.open_crashes.empty());
  const auto pushed = record_among(site.events);
  REQUIRE(pushed.has_value());
  CHECK(pushed->ticks <= 120);
  CHECK(pushed->contact_s.value_or(0.0) > told_within_s - parted_s);
  CHECK(pushed->contact_s.value_or(0.0) <= told_within_s);
  CHECK(pushed->pulse_ns == so_far->pulse_ns);
  CHECK(pushed->of_first == so_far->of_first);
  drive_at(8.0, 240);
  drive_at(-3.0, 120);
  CHECK(site.count(crash_event) == 2);
}

TEST_CASE("a second blow so soon after a push that they have not parted is a crash of its own") {
  CrashSite site(plane_model(1), {{0.0, 0.0, 0.0}, {}}, 4.0,
                 {placed_participant(first_struck, "saloon", 5.5, 0.0, 0.0, 0.0)});
  const auto drive_at = [&](double mps, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      site.state.car.velocity_mps = Vec3(mps, 0.0, 0.0);
      site.tick();
    }
  };
  drive_at(4.0, 100);
  REQUIRE(site.state.open_crashes.size() == 1);
  const Tick pushed = site.state.open_crashes.front().last_in_contact;
  drive_at(1.0, 8);
  site.state.effects.crashes.struck_vehicles.clear();
  while (site.state.open_crashes.size() == 1 && site.state.tick < pushed + 30) drive_at(9.0, 1);
  REQUIRE(site.state.open_crashes.size() == 2);
  CHECK(site.state.effects.crashes.struck_vehicles.size() == 1);  // It dents.
  CHECK(site.state.open_crashes.back().record.closing_speed_mps > 1.0);
  drive_at(0.0, 120);
  CHECK(site.count(crash_event) == 2);
  for (const Event& event : site.events) {
    if (event.kind != crash_event) continue;
    const auto record = read_crash(*event.participant, event.detail);
    REQUIRE(record.has_value());
    REQUIRE(record->ledger.has_value());
    CHECK(share_missing(*record->ledger) < 0.001);
    CHECK(record->of_second.delta_v_mps->x > 0.5);
  }
}

TEST_CASE("a blow is told a quarter of a second after its last push, with a contact no longer than its impact") {
  CrashSite site = site_of(pairs[0]);
  Tick last_push = 0;
  while (site.count(crash_event) == 0) {
    site.tick();
    if (!site.state.open_crashes.empty()) last_push = site.state.open_crashes.front().last_in_contact;
  }
  const auto record = record_among(site.events);
  REQUIRE(record.has_value());
  CHECK(site.state.tick == last_push + 31);
  CHECK(record->contact_s.value_or(0.0) == relative(static_cast<double>(record->ticks) * tick_s, 1e-6));
}

}  // namespace septet::simulation
