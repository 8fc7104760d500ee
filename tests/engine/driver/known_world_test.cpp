#include "engine/driver/known_world.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "engine/world/seen_participants.hpp"
#include "tests/relative.hpp"

namespace septet::driver {
namespace {

constexpr double look_s = 0.05;

/// The driver's car at the origin and another one ahead, which the eyes see or not.
struct TwoCars {
  Snapshot snapshot;
  KnownWorld known;

  TwoCars(double ahead_m, double speed_mps) {
    snapshot.driver_car.participant = 1;
    for (const ParticipantId id : {1u, 4u}) {
      Participant body;
      body.id = id;
      body.model = *find_vehicle_model("saloon");
      if (id == 4) {
        body.world_from_vehicle.position_m = Vec3(ahead_m, 0.0, 0.0);
        body.velocity_mps = Vec3(speed_mps, 0.0, 0.0);
      }
      snapshot.participants.push_back(body);
    }
  }
  Participant& other() { return snapshot.participants[1]; }
  void look(bool sees) {
    const std::vector<ParticipantId> seen = sees ? std::vector<ParticipantId>{4} : std::vector<ParticipantId>{};
    snapshot.effects = {{seen_effect_id, seen_keyframe_kind, encode_seen(seen), 0}};
    look_around(known, snapshot, look_s);
  }
  std::optional<Vec3> believed_m() const {
    const auto found = std::ranges::find(known.bodies, ParticipantId{4}, &Participant::id);
    if (found == known.bodies.end()) return std::nullopt;
    return found->world_from_vehicle.position_m;
  }
};

}  // namespace

TEST_CASE("who has never been seen is not known, and the driver's own car is") {
  TwoCars cars(40.0, 0.0);
  cars.look(false);
  CHECK_FALSE(cars.believed_m().has_value());
  REQUIRE(cars.known.bodies.size() == 1);
  CHECK(cars.known.bodies[0].id == 1);
  cars.look(true);
  CHECK(cars.believed_m().has_value());
}

TEST_CASE(
    "who was seen and is hidden is taken to go on evenly, whatever he does, and is forgotten after three seconds") {
  TwoCars cars(40.0, 20.0);
  cars.look(true);
  cars.other().world_from_vehicle.position_m = Vec3(-500.0, 0.0, 0.0);
  for (int look = 1; look <= 59; ++look) {
    cars.look(false);
    REQUIRE(cars.believed_m().has_value());
    CHECK(cars.believed_m()->x == doctest::Approx(40.0 + 20.0 * look_s * look));
  }
  for (int look = 0; look < 2; ++look) cars.look(false);
  CHECK_FALSE(cars.believed_m().has_value());
}

TEST_CASE("who was hidden in a bend is taken to go on round it") {
  constexpr double speed_mps = 20.0, radius_m = 100.0, after_s = 2.0;
  TwoCars cars(40.0, speed_mps);
  cars.other().angular_velocity_radps = Vec3(0.0, 0.0, speed_mps / radius_m);
  cars.look(true);
  for (int look = 0; look < static_cast<int>(after_s / look_s); ++look) cars.look(false);
  const double turned_rad = speed_mps * after_s / radius_m;
  CHECK(cars.believed_m()->x == relative(40.0 + radius_m * std::sin(turned_rad), 0.01));
  CHECK(cars.believed_m()->y == relative(radius_m * (1.0 - std::cos(turned_rad)), 0.05));
}

TEST_CASE("a siren within 50 m is heard through what hides it, one farther away or a silent beacon is not") {
  for (const double away_m : {45.0, 55.0}) {
    TwoCars cars(away_m, 0.0);
    cars.other().lamps.set(Lamp::beacon, true);
    cars.look(false);
    CHECK_FALSE(cars.believed_m().has_value());
    cars.other().lamps.set(Lamp::siren, true);
    cars.look(false);
    CHECK(cars.believed_m().has_value() == (away_m < 50.0));
  }
}

TEST_CASE("a snapshot that does not tell who is seen hides nobody") {
  TwoCars cars(40.0, 0.0);
  look_around(cars.known, cars.snapshot, look_s);
  CHECK(cars.believed_m().has_value());
}

}  // namespace septet::driver
