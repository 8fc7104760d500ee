// Vehicles that leave their rails: pairs that are found, momentum, rest, a pile-up, and who stays on the rails.

#include "engine/simulation/bodies/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/simulation/bodies/near_pairs.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

constexpr ParticipantId first_other = first_scripted_participant + 1;

/// By how much the crushed outlines of two overlap.
double overlap_m(const CrashSite& site, const BodyContact& contact) {
  const auto crushed_outline = [&](ParticipantId id, const impact::Cuts& cuts) {
    const auto one = std::ranges::find(site.participants, id, &Participant::id);
    return impact::crushed(impact_side(*one, 1.0).outline, cuts);
  };
  const auto met = impact::contact_of(crushed_outline(contact.first, contact.engagement.first),
                                      crushed_outline(contact.second, contact.engagement.second));
  return met ? -met->gap_m : 0.0;
}

}  // namespace

TEST_CASE("near pairs are those that a look at all pairs finds, and none of one traffic engine") {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<Participant> participants;
    for (ParticipantId i = 0; i < 60; ++i) {
      const ParticipantId id = i < 20 ? i + 1 : first_traffic_participant + i;
      const char* model = i % 7 == 0 ? "lorry" : i % 5 == 0 ? "pedestrian" : "saloon";
      participants.push_back(
          placed_participant(id, model, random.uniform(-60.0, 60.0), random.uniform(-60.0, 60.0), 0.0, 0.0));
    }
    const std::vector<ParticipantId> loose{participants[30].id, participants[45].id};
    const auto pairs = near_pairs(participants, first_traffic_participant, loose);
    CHECK(std::ranges::is_sorted(pairs));
    for (std::size_t a = 0; a < participants.size(); ++a)
      for (std::size_t b = a + 1; b < participants.size(); ++b) {
        const bool engine = a >= 20 && a != 30 && a != 45 && b != 30 && b != 45;
        const bool found = std::ranges::binary_search(pairs, std::pair(a, b));
        const bool touch = contact_of(body_box(participants[a]), body_box(participants[b])).has_value();
        if (engine) CHECK_FALSE(found);
        if (!engine && touch) CHECK(found);
      }
  }
}

TEST_CASE("one that runs into a standing one takes it along, both rest, and one event tells of it") {
  CrashSite site({placed_participant(first_other, "saloon", 0.0, 0.0, 0.0, 12.0),
                  placed_participant(first_other + 1, "saloon", 8.0, 0.3, 0.0, 0.0)});
  const Vec2 before = site.momentum();
  int ticks = 0;
  for (; site.state.bodies.bodies.empty() && ticks < 120; ++ticks) site.tick();
  REQUIRE(site.state.bodies.bodies.size() == 2);
  CHECK(glm::distance(site.momentum(), before) < 1e-9 * glm::length(before));
  REQUIRE(site.count("crash_of_others") == 1);
  CHECK(told(site.events.back(), "by") == first_other);
  CHECK(told(site.events.back(), "with") == first_other + 1);
  CHECK(told(site.events.back(), "closing_speed_mps") == relative(12.0, 0.001));
  double fastest_mps = 0.0;
  for (; !site.rests() && ticks < 1200; ++ticks) {
    site.tick();
    fastest_mps = std::max(fastest_mps, glm::length(site.participants[2].velocity_mps));
  }
  CHECK(site.rests());
  CHECK(fastest_mps > 5.0);
  CHECK(fastest_mps < 8.0);
  CHECK(site.count("crash_of_others") == 1);
  CHECK(site.state.diagnostics.collisions == 0);
  CHECK(site.state.scenario.entities[1].external);
  CHECK(site.participants[2].world_from_vehicle.position_m.x > 9.0);
}

TEST_CASE("who drives across on rails is hit in the side, turned, and lies across") {
  CrashSite site({placed_participant(first_other, "saloon", 0.0, 0.0, 0.0, 13.5),
                  placed_participant(first_other + 1, "saloon", 11.0, -9.0, 0.5 * 3.141592653589793, 12.0)});
  for (int i = 0; i < 600; ++i) site.tick();
  REQUIRE(site.state.bodies.bodies.size() == 2);
  CHECK(site.rests());
  CHECK(std::abs(site.participants[2].velocity_mps.x) < 1e-9);
  const double turned_rad = std::remainder(
      heading_rad(site.participants[2].world_from_vehicle.orientation) - 0.5 * 3.141592653589793, 6.283185307179586);
  CHECK(std::abs(turned_rad) > 0.1);
}

TEST_CASE("a pile-up of five leaves nobody in anybody, and keeps momentum and energy in its books") {
  std::vector<Participant> row;
  for (ParticipantId i = 0; i < 5; ++i)
    row.push_back(placed_participant(first_other + i, i == 2 ? "van" : "saloon", -12.0 * i, 0.25 * (i % 3), 0.0,
                                     i == 0 ? 0.0 : 22.0));
  CrashSite site(row);
  double deepest_m = 0.0, missing = 0.0;
  for (int i = 0; i < 1200; ++i) {
    site.tick();
    for (const BodyContact& contact : site.state.bodies.contacts) {
      deepest_m = std::max(deepest_m, overlap_m(site, contact));
      const impact::Ledger& ledger = contact.engagement.ledger;
      if (ledger.kinetic_j > 1e3)
        missing = std::max(missing, std::abs(ledger.kinetic_j - ledger.crush_j - ledger.friction_j) / ledger.kinetic_j);
    }
  }
  CHECK(site.state.bodies.bodies.size() == 5);
  CHECK(site.count("crash_of_others") >= 4);
  CHECK(site.rests());
  MESSAGE("deepest overlap " << 1000.0 * deepest_m << " mm, energy missing " << missing);
  CHECK(deepest_m < 0.01);
  CHECK(missing < 0.001);
  // Nobody has passed another.
  for (std::size_t i = 2; i < site.participants.size(); ++i)
    CHECK(site.participants[i].world_from_vehicle.position_m.x <
          site.participants[i - 1].world_from_vehicle.position_m.x);
}

TEST_CASE("contacts of bodies keep momentum in every tick of a pile-up") {
  std::vector<Participant> row;
  for (ParticipantId i = 0; i < 5; ++i)
    row.push_back(placed_participant(first_other + i, "saloon", -9.0 * i, 0.4 * (i % 3), 0.0, i == 0 ? 0.0 : 18.0));
  CrashSite site(row);
  const Vec2 before = site.momentum();
  double most = 0.0;
  for (int i = 0; i < 900; ++i) {
    site.tick(false);
    most = std::max(most, glm::distance(site.momentum(), before) / glm::length(before));
  }
  CHECK(site.state.bodies.bodies.size() == 5);
  CHECK(most < 1e-9);
}

TEST_CASE("two who can both be thrown stay on their rails, and one event tells of their touch") {
  CrashSite site({placed_participant(first_other, "motorcycle", 0.0, 0.0, 0.0, 10.0),
                  placed_participant(first_other + 1, "pedestrian", 6.0, 0.2, 0.0, 0.0)});
  for (int i = 0; i < 120; ++i) site.tick();
  CHECK(site.count("crash_of_others") == 1);
  CHECK(site.state.bodies.bodies.empty());
  CHECK(site.state.bodies.contacts.empty());
}

TEST_CASE("a wreck keeps what it was: number, model, paint, place and motion at the touch") {
  Participant before = placed_participant(first_other, "estate", 3.0, -2.0, 0.7, 9.0);
  before.world_from_vehicle.orientation = orientation_from_angles(0.7, -0.03, 0.02);
  before.velocity_mps = before.world_from_vehicle.orientation * Vec3(9.0, 0.0, 0.0);
  before.angular_velocity_radps = {0.0, 0.0, 0.2};
  before.paint = 5;
  const Participant after = participant_of(loose_body(before, 1500.0));
  CHECK(after.id == before.id);
  CHECK(after.model == before.model);
  CHECK(after.paint == before.paint);
  CHECK(glm::distance(after.world_from_vehicle.position_m, before.world_from_vehicle.position_m) < 1e-9);
  CHECK(std::abs(glm::dot(after.world_from_vehicle.orientation, before.world_from_vehicle.orientation)) ==
        relative(1.0, 1e-12));
  CHECK(glm::distance(after.velocity_mps, before.velocity_mps) < 1e-2);
  CHECK(after.lamps.has(Lamp::brake));
}
