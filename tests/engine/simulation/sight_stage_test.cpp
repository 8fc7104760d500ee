#include "engine/simulation/sight_stage.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/effects/smoke/visibility.hpp"
#include "engine/road/lane_geometry.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::simulation {
namespace {

constexpr ParticipantId in_traffic = 1004;

/// The driver's car in the tunnel of the motorway, a car of traffic beside it, and, so far ahead of both rear axles, a van in the lane between.
struct Tube {
  Model model;
  State state;
  std::vector<Participant> participants;

  explicit Tube(double ahead_m, double s_m = 3300.0) {
    model.roads = road::motorway();
    const auto put = [&](ParticipantId id, std::string_view body, double at_m, int lane) {
      Participant vehicle;
      vehicle.id = id;
      vehicle.model = *find_vehicle_model(body);
      vehicle.world_from_vehicle = road::world_from_lane(road::evaluate_lane(model.roads, {0, lane, at_m, 0.0}));
      participants.push_back(vehicle);
    };
    put(driver_participant, "volvo-s80", s_m, -5);
    put(5, "van", s_m + ahead_m, -5);
    put(in_traffic, "saloon", s_m, -6);
    state.tick = 120;
    state.scenario.environment.sun_elevation_rad = 0.8;
  }
  std::vector<Event> look() {
    std::vector<Event> events;
    look_through_air(model, participants, state, events);
    return events;
  }
  std::optional<double> seen_m(ParticipantId driver) const {
    for (const LimitedSight& sight : state.sights)
      if (sight.driver == driver) return sight.seen_m;
    return std::nullopt;
  }
};

/// From the driver's eye to the front bumper of the S80.
double bonnet_m() {
  const VehicleModel& car = vehicle_models()[*find_vehicle_model("volvo-s80")];
  return car.front_m() - 0.45 * car.wheelbase_m;
}

}  // namespace

TEST_CASE("in clear air, rain or darkness nobody's sight is limited and nothing is logged or sent") {
  Tube tube(34.0);
  for (const double elevation_rad : {0.8, -0.3})
    for (const double mm_per_h : {0.0, 10.0}) {
      Environment& weather = tube.state.scenario.environment;
      weather.sun_elevation_rad = elevation_rad;
      weather.rain_mm_per_h = mm_per_h;
      weather.road_wetness = mm_per_h > 0.0 ? 1.0 : 0.0;
      CHECK(tube.look().empty());
      CHECK_FALSE(sight_keyframe(tube.state).has_value());
    }
}

TEST_CASE("in fog the driver and each of traffic see to a depth of three and the log names each") {
  Tube tube(120.0);
  tube.state.scenario.environment.visibility_m = 60.0;
  const auto events = tube.look();
  const double road_m = 3.0 / (3.912 / 60.0);
  CHECK(*tube.seen_m(driver_participant) == relative(road_m - bonnet_m(), 0.01));
  CHECK(tube.seen_m(in_traffic).has_value());
  CHECK_FALSE(tube.seen_m(5).has_value());  // Of the script.
  REQUIRE(events.size() == 2);
  CHECK(events[0].kind == "visibility");
  CHECK(events[0].participant == driver_participant);
  CHECK(events[1].participant == in_traffic);
  REQUIRE(sight_keyframe(tube.state).has_value());
  Snapshot snapshot;
  snapshot.effects = {*sight_keyframe(tube.state)};
  CHECK(*limited_sight_m(snapshot, driver_participant) == relative(*tube.seen_m(driver_participant), 0.005));
}

TEST_CASE("the lamps of a vehicle ahead extend the sight to it where a depth of eight does not hide them") {
  Tube tube(80.0);
  tube.state.scenario.environment.visibility_m = 60.0;
  tube.look();
  const double dark_m = *tube.seen_m(driver_participant);
  tube.participants[1].lamps.set(Lamp::low_beam, true);
  tube.look();
  const double rear_m = 80.0 - vehicle_models()[tube.participants[1].model].rear_overhang_m;
  const double front_m = vehicle_models()[tube.participants[0].model].front_m();
  CHECK(dark_m < 45.0);
  CHECK(*tube.seen_m(driver_participant) == relative(rear_m - front_m, 0.02));
  tube.state.scenario.environment.visibility_m = 35.0;  // 8.5 optical depths to it.
  tube.look();
  CHECK(*tube.seen_m(driver_participant) < 28.0);
}

TEST_CASE("wet snow and fog together hide more than each") {
  const auto seen_m = [](double visibility_m, double mm_per_h) {
    Tube tube(150.0);
    Environment& weather = tube.state.scenario.environment;
    weather.visibility_m = visibility_m;
    weather.rain_mm_per_h = mm_per_h;
    weather.temperature_k = 270.0;
    tube.look();
    return tube.seen_m(driver_participant).value_or(farthest_sight_m);
  };
  CHECK(seen_m(100.0, 5.0) < 0.95 * seen_m(100.0, 0.0));
  CHECK(seen_m(20000.0, 8.0) < 150.0);
}

TEST_CASE("by night in fog dark things are seen less far than the road that sends beams back") {
  Tube tube(150.0, 800.0);  // In the open.
  tube.state.scenario.environment.visibility_m = 100.0;
  tube.participants[0].lamps.set(Lamp::low_beam, true);
  const auto reflecting_m = [&](double elevation_rad) {
    tube.state.scenario.environment.sun_elevation_rad = elevation_rad;
    const std::string detail = tube.look().front().detail;
    return std::stod(detail.substr(detail.find('=') + 1));
  };
  const double by_day = reflecting_m(0.8), by_night = reflecting_m(-0.3);
  CHECK(by_day == relative(3.0 / 0.03912, 0.01));
  CHECK(by_night < 0.7 * by_day);
  CHECK(*tube.seen_m(driver_participant) == relative(by_day - bonnet_m(), 0.01));
}

TEST_CASE("smoke hides the road to a depth of three, a burning van to eight, and the log has the transmittance to it") {
  Tube tube(38.0);
  ignite(tube.model.roads, tube.participants[1], 1, tube.state.effects.fires);
  smoke::State& smoke = *tube.state.effects.fires.smoke;
  const auto detail_in = [&](double per_m) {
    const double cell_m3 = smoke.grid.cell_m * smoke.grid.cell_m * smoke.grid.cell_m;
    std::ranges::fill(smoke.extinction_area_m2, static_cast<float>(per_m * cell_m3));
    const auto events = tube.look();
    REQUIRE(events.size() == 2);
    CHECK(events[1].participant == in_traffic);
    return events[0].detail;
  };
  const VehicleModel &van = vehicle_models()[tube.participants[1].model],
                     &car = vehicle_models()[tube.participants[0].model];
  const double rear_m = 38.0 - van.rear_overhang_m;
  const std::string thin = detail_in(0.1);
  CHECK(*tube.seen_m(driver_participant) == relative(rear_m - car.front_m(), 0.02));
  CHECK(*tube.seen_m(in_traffic) < 30.0);
  CHECK(thin.find("vehicle=5 ") != std::string::npos);
  const double transmittance = std::stod(thin.substr(thin.find("transmittance=") + 14));
  CHECK(transmittance == relative(std::exp(-0.1 * (rear_m - car.front_m() + bonnet_m())), 0.06));
  detail_in(0.3);
  CHECK(*tube.seen_m(driver_participant) == relative(10.0 - bonnet_m(), 0.01));
  // Put out, it shines no more.
  extinguish(5, tube.state.effects.fires);
  detail_in(0.1);
  CHECK(*tube.seen_m(driver_participant) == relative(30.0 - bonnet_m(), 0.01));
}

}  // namespace septet::simulation
