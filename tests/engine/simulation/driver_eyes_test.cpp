#include "engine/simulation/driver_eyes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/world/seen_participants.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/simulation/placed_participant.hpp"
#include "tests/relative.hpp"

namespace septet::simulation {
namespace {

constexpr ParticipantId other_id = 7;

/// A world without roads: the driver's car comes along x at y = 3 in daylight, and others stand beside its way.
struct OpenPlain {
  Model model;
  State state;
  std::vector<Participant> participants;
  std::vector<Event> events;

  OpenPlain() {
    state.scenario.environment.sun_elevation_rad = 0.8;
    state.tick = 1;
    put(driver_participant, "volvo-s80", 0.0, 3.0);
  }
  Participant& put(ParticipantId id, std::string_view body, double x_m, double y_m) {
    participants.push_back(placed_participant(id, body, x_m, y_m, 0.0, 0.0));
    return participants.back();
  }
  bool looks_and_sees(ParticipantId id) {
    look_for_others(model, participants, state, events);
    const auto keyframe = seen_keyframe(state);
    return keyframe && std::ranges::count(*decode_seen(keyframe->data), id) == 1;
  }
};

double number_after(const std::string& detail, std::string_view name) {
  return std::stod(detail.substr(detail.find(name) + name.size()));
}

}  // namespace

TEST_CASE(
    "a walker behind a van comes into sight where the line past its corner does, to a look, and the log has the "
    "distance") {
  constexpr double van_x_m = 60.0, speed_mps = 14.0;
  OpenPlain plain;
  plain.put(3, "van", van_x_m, 0.0);
  const VehicleModel van = vehicle_models()[*find_vehicle_model("van")],
                     person = vehicle_models()[*find_vehicle_model("pedestrian")];
  const double corner_x_m = van_x_m + van.front_m(), corner_y_m = 0.5 * van.width_m;
  plain.put(other_id, "pedestrian", corner_x_m + 4.0, 0.0);
  // From the nearest points of the walker to be seen past the corner of the van, to the line of the eyes.
  const double near_y_m = 0.95 * 0.5 * person.width_m;
  double clears_m = 1e9;
  for (const double end : {-0.95, 0.95}) {
    const double x_m = corner_x_m + 4.0 + person.centre_x_m() + end * 0.5 * person.length_m;
    clears_m = std::min(clears_m, x_m - (3.0 - near_y_m) * (x_m - corner_x_m) / (corner_y_m - near_y_m));
  }
  const double eye_ahead_m = 0.45 * vehicle_models()[*find_vehicle_model("volvo-s80")].wheelbase_m;
  for (; plain.participants[0].world_from_vehicle.position_m.x < 60.0; ++plain.state.tick) {
    const double eye_x_m = plain.participants[0].world_from_vehicle.position_m.x + eye_ahead_m;
    const bool sees = plain.looks_and_sees(other_id);
    if (eye_x_m < clears_m) REQUIRE_FALSE(sees);
    if (eye_x_m > clears_m + 0.1 * speed_mps + 1e-6) REQUIRE(sees);
    plain.participants[0].world_from_vehicle.position_m.x += speed_mps * tick_s;
  }
  REQUIRE(plain.events.size() == 1);
  CHECK(plain.events[0].kind == "first_sight");
  CHECK(plain.events[0].participant == other_id);
  const double straight_m = std::hypot(corner_x_m + 4.0 - clears_m, 3.0);
  CHECK(number_after(plain.events[0].detail, "distance_m=") == relative(straight_m, 0.12));
  CHECK(number_after(plain.events[0].detail, "hidden_s=") == relative((clears_m - eye_ahead_m) / speed_mps, 0.05));
}

TEST_CASE("a car hides no roof behind it and a lorry the whole car, and the beacon of who is behind changes nothing") {
  OpenPlain plain;
  plain.participants[0].world_from_vehicle.position_m.y = 0.0;
  plain.put(3, "saloon", 12.0, 0.0);
  plain.put(other_id, "saloon", 60.0, 0.0).lamps.set(Lamp::beacon, true);
  CHECK(plain.looks_and_sees(other_id));
  plain.participants[1].model = *find_vehicle_model("lorry");
  CHECK_FALSE(plain.looks_and_sees(other_id));
  plain.participants[1].world_from_vehicle.position_m.y = 3.5;
  CHECK(plain.looks_and_sees(other_id));
}

TEST_CASE(
    "who is hidden for less than three seconds is not told again when he comes into sight, and one for longer is") {
  for (const Tick hidden : {Tick{240}, Tick{480}}) {
    OpenPlain plain;
    plain.put(3, "lorry", 12.0, -20.0);
    plain.put(other_id, "saloon", 60.0, 3.0);
    const auto drive = [&](Tick ticks, double lorry_y_m) {
      plain.participants[1].world_from_vehicle.position_m.y = lorry_y_m;
      for (Tick n = 0; n < ticks; ++n, ++plain.state.tick) plain.looks_and_sees(other_id);
    };
    drive(120, -20.0);
    drive(hidden, 3.0);
    drive(120, -20.0);
    CHECK(plain.events.size() == (hidden > 360 ? 1u : 0u));
  }
}

TEST_CASE("the wall between the tubes of a tunnel hides the traffic of the other one") {
  OpenPlain plain;
  plain.model.roads = road::motorway();
  const auto in_tunnel = [&](int lane, double s_m) {
    return road::world_from_lane(road::evaluate_lane(plain.model.roads, {0, lane, s_m, 0.0}));
  };
  plain.participants[0].world_from_vehicle = in_tunnel(-5, 3300.0);
  plain.put(5, "saloon", 0.0, 0.0).world_from_vehicle = in_tunnel(-6, 3340.0);
  plain.put(other_id, "saloon", 0.0, 0.0).world_from_vehicle = in_tunnel(5, 3340.0);
  CHECK(plain.looks_and_sees(other_id));
  plain.model.obstacles = std::make_shared<const roadside::Obstacles>(plain.model.roads, 1);
  CHECK_FALSE(plain.looks_and_sees(other_id));
  CHECK(plain.looks_and_sees(5));
}

TEST_CASE("smoke hides a dark car at a depth of three and a lit one at eight") {
  for (const double per_m : {0.05, 0.1, 0.3}) {
    OpenPlain plain;
    plain.model.roads = road::motorway();
    const auto put = [&](ParticipantId id, double s_m, int lane) {
      plain.put(id, "saloon", 0.0, 0.0).world_from_vehicle =
          road::world_from_lane(road::evaluate_lane(plain.model.roads, {0, lane, s_m, 0.0}));
    };
    plain.participants.clear();
    put(driver_participant, 3300.0, -5);
    put(5, 3340.0, -5);
    put(other_id, 3340.0, -6);
    ignite(plain.model.roads, plain.participants[1], 1, plain.state.effects.fires);
    smoke::State& smoke = *plain.state.effects.fires.smoke;
    const double cell_m3 = smoke.grid.cell_m * smoke.grid.cell_m * smoke.grid.cell_m;
    std::ranges::fill(smoke.extinction_area_m2, static_cast<float>(per_m * cell_m3));
    CAPTURE(per_m);  // Some 38 m through it: depths of 1.9, 3.8 and 11.
    CHECK(plain.looks_and_sees(other_id) == (per_m < 0.08));
    CHECK(plain.looks_and_sees(5) == (per_m < 0.2));
  }
}

TEST_CASE("fog hides a car at a depth of three, and in the dark one without lamps is seen by one's own beams alone") {
  OpenPlain plain;
  plain.put(other_id, "saloon", 100.0, 3.0);
  plain.state.scenario.environment.visibility_m = 200.0;  // A depth of 1.9.
  CHECK(plain.looks_and_sees(other_id));
  plain.state.scenario.environment.visibility_m = 100.0;
  CHECK_FALSE(plain.looks_and_sees(other_id));
  plain.state.scenario.environment.visibility_m = 20000.0;
  plain.state.scenario.environment.sun_elevation_rad = -0.3;
  CHECK_FALSE(plain.looks_and_sees(other_id));
  plain.participants[1].world_from_vehicle.position_m.x = 45.0;
  CHECK_FALSE(plain.looks_and_sees(other_id));
  plain.participants[0].lamps.set(Lamp::low_beam, true);
  CHECK(plain.looks_and_sees(other_id));
  plain.participants[0].world_from_vehicle.orientation = orientation_from_angles(3.14159, 0.0, 0.0);
  CHECK_FALSE(plain.looks_and_sees(other_id));  // Behind.
  plain.participants[1].lamps.set(Lamp::low_beam, true);
  CHECK(plain.looks_and_sees(other_id));
}

TEST_CASE("nobody near means that nothing is sent, and a keyframe is renewed only when who is seen has changed") {
  OpenPlain plain;
  CHECK_FALSE(plain.looks_and_sees(other_id));
  CHECK_FALSE(seen_keyframe(plain.state).has_value());
  plain.put(other_id, "saloon", 60.0, 3.0);
  plain.state.tick = 13;
  CHECK(plain.looks_and_sees(other_id));
  plain.state.tick = 25;
  CHECK(plain.looks_and_sees(other_id));
  CHECK(seen_keyframe(plain.state)->tick == 13);
  plain.participants[1].world_from_vehicle.position_m.x = 300.0;
  plain.state.tick = 37;
  CHECK_FALSE(plain.looks_and_sees(other_id));
  CHECK_FALSE(seen_keyframe(plain.state).has_value());
}

}  // namespace septet::simulation
