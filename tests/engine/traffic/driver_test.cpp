// Kinds of drivers, and the path of a lane change across the road.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/traffic/lane_order.hpp"
#include "engine/traffic/lateral.hpp"
#include "engine/traffic/traffic_stages.hpp"
#include "tests/engine/traffic/ring_road.hpp"
#include "tests/relative.hpp"

namespace septet::traffic {

TEST_CASE("the more aggressive a driver the faster, nearer, sooner and less polite") {
  const Driver middle{{32.0, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
  const Driver same = with_temperament(middle, 0.5), timid = with_temperament(middle, 0.0),
               aggressive = with_temperament(middle, 1.0);
  const auto ordered = [&](auto&& of, double at_timid, double at_aggressive) {
    CHECK(of(same) == doctest::Approx(of(middle)));
    CHECK(of(timid) / of(middle) == doctest::Approx(at_timid));
    CHECK(of(aggressive) / of(middle) == doctest::Approx(at_aggressive));
  };
  ordered([](const Driver& d) { return d.following.desired_speed_mps; }, 0.90, 1.15);
  ordered([](const Driver& d) { return d.following.time_gap_s; }, 1.35, 0.62);
  ordered([](const Driver& d) { return d.following.acceleration_mps2; }, 0.65, 1.40);
  ordered([](const Driver& d) { return d.following.standstill_gap_m; }, 1.40, 0.75);
  ordered([](const Driver& d) { return d.lane_change.politeness; }, 2.5, 0.05);
  ordered([](const Driver& d) { return d.lane_change.threshold_mps2; }, 2.5, 0.5);
  ordered([](const Driver& d) { return d.lane_change.largest_braking_mps2; }, 0.67, 1.7);
  ordered([](const Driver& d) { return d.reaction_s; }, 1.8, 0.6);
  CHECK(with_temperament(middle, 3.0).reaction_s == aggressive.reaction_s);
}

namespace {

struct OneCar {
  road::RoadNetwork network = ring_road(5000.0, 3);
  CorridorTraffic traffic;

  explicit OneCar(double speed_mps, const char* model = "saloon") {
    traffic = empty_corridor(network, road::LanePosition{0, -2, 1.0, 0.0});
    add_vehicle(traffic, 10, model_named(model), Driver{{30.0, 1.3, 1.5, 2.5, 2.0}, {}, 1.0}, 2, 500.0, speed_mps);
  }
  /// Metres of its lane a metre of x: it drives outside of the bend.
  double stretch() const { return 1.0 + 1.5 * 3.75 * 2.0 * std::acos(-1.0) / 5000.0; }
};

}  // namespace

TEST_CASE("a change of lane takes its time at speed and a vehicle's own length at least") {
  OneCar fast(25.0), slow(1.0), lorry(1.0, "lorry");
  CHECK(change_length_m(fast.traffic, 0, 25.0) ==
        doctest::Approx(25.0 * fast.traffic.driver[0].lane_change.duration_s));
  CHECK(change_length_m(slow.traffic, 0, 1.0) == doctest::Approx(10.0 + 3.0 * slow.traffic.length_m[0]));
  CHECK(change_length_m(lorry.traffic, 0, 1.0) > change_length_m(slow.traffic, 0, 1.0) + 15.0);
}

TEST_CASE("the curve of a lane change has the slope and curvature of its offset and ends straight in its lane") {
  OneCar car(20.0);
  CorridorTraffic& traffic = car.traffic;
  begin_change(traffic, 0, 3.75, 0.02);
  const double length_m = change_length_m(traffic, 0, 20.0);
  const auto at = [&](double part) {
    traffic.change_part[0] = part;
    return lateral(traffic, 0);
  };
  CHECK(at(0.0).offset_m == doctest::Approx(3.75));
  CHECK(at(0.0).slope == doctest::Approx(0.02));
  CHECK(at(0.0).curvature_per_m == doctest::Approx(0.0));
  CHECK(at(1.0).offset_m == 0.0);
  CHECK(std::abs(at(0.999999).slope) < 1e-9);
  constexpr double h = 1e-5;
  for (const double u : {0.1, 0.35, 0.6, 0.9}) {
    const double slope = (at(u + h).offset_m - at(u - h).offset_m) / (2.0 * h * length_m);
    const double curvature = (at(u + h).slope - at(u - h).slope) / (2.0 * h * length_m);
    CHECK(at(u).slope == relative(slope, 1e-4));
    CHECK(at(u).curvature_per_m == relative(curvature, 1e-3));
  }
  // A body that stands askew is wider.
  at(0.5);
  CHECK(across(traffic, 0).half_width_m ==
        doctest::Approx(traffic.half_width_m[0] + 0.5 * traffic.length_m[0] * std::abs(at(0.5).slope)));
}

TEST_CASE("who stops within a step stops where its braking ends") {
  OneCar car(0.5);
  car.traffic.acceleration_mps2[0] = -5.0;
  move(car.network, car.traffic, 0.2);  // It stands after 0.1 s.
  CHECK(car.traffic.speed_mps[0] == 0.0);
  CHECK(car.traffic.x_m[0] == relative(500.0 + 0.5 * 0.5 / (2.0 * 5.0) / car.stretch(), 1e-9));
  car.traffic.speed_mps[0] = 10.0;
  car.traffic.acceleration_mps2[0] = 2.0;
  const double from_m = car.traffic.x_m[0];
  move(car.network, car.traffic, 0.1);
  CHECK(car.traffic.speed_mps[0] == doctest::Approx(10.2));
  CHECK((car.traffic.x_m[0] - from_m) * car.stretch() == doctest::Approx(1.01));
}

TEST_CASE("a ring's vehicle comes round and a rank keeps who is level before who is ahead") {
  OneCar car(20.0);
  car.traffic.x_m[0] = 4999.5;
  car.traffic.acceleration_mps2[0] = 0.0;
  move(car.network, car.traffic, 0.1);
  CHECK(car.traffic.x_m[0] == doctest::Approx(2.0 / car.stretch() - 0.5));
  std::vector<LaneEntry> lane(3);
  lane[0].x_m = 10.0, lane[1].x_m = 20.0, lane[2].x_m = 30.0;
  for (const std::size_t hint : {0u, 1u, 3u, 99u}) {
    CHECK(first_ahead(lane, 19.9, hint) == 1);
    CHECK(first_ahead(lane, 20.0, hint) == 2);
    CHECK(first_ahead(lane, 5.0, hint) == 0);
    CHECK(first_ahead(lane, 35.0, hint) == 3);
  }
}

}  // namespace septet::traffic
