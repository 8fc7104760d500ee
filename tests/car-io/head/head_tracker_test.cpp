#include "car-io/head/head_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"

namespace septet::car_io {
namespace {

constexpr double tick_s = 1.0 / 120.0;

/// In OpenTrack's form.
std::vector<std::byte> datagram_of(const TrackedPose& pose) {
  std::vector<std::byte> bytes(sizeof pose);
  std::memcpy(bytes.data(), pose.data(), bytes.size());
  return bytes;
}

/// A tracker that has been followed for a while.
HeadMotion followed(const HeadPlace& place) {
  HeadMotion motion;
  for (int i = 0; i < 300; ++i) advance(motion, place, tick_s);
  return motion;
}

}  // namespace

TEST_CASE("a datagram of six doubles is read as centimetres and degrees along the axes that the rig names") {
  const auto pose = read_tracked_pose(datagram_of({-10.0, 5.0, -20.0, -30.0, 4.0, 3.0}));
  REQUIRE(pose);
  const HeadPlace place = place_of(*pose, {});
  CHECK(place.from_rest_m.x == doctest::Approx(0.2));
  CHECK(place.from_rest_m.y == doctest::Approx(0.1));
  CHECK(place.from_rest_m.z == doctest::Approx(0.05));
  CHECK(place.heading_rad == doctest::Approx(std::numbers::pi / 6.0));
  rig::HeadTracking other;
  other.forward = {rig::HeadAxis::Of::x, false};
  other.turn_left = {rig::HeadAxis::Of::roll, false};
  CHECK(place_of(*pose, other).from_rest_m.x == doctest::Approx(-0.1));
  CHECK(place_of(*pose, other).heading_rad == doctest::Approx(3.0 * std::numbers::pi / 180.0));
}

TEST_CASE("what is no pose is not read") {
  const auto whole = datagram_of({1, 2, 3, 4, 5, 6});
  for (std::size_t size = 0; size < whole.size(); ++size) CHECK_FALSE(read_tracked_pose(std::span(whole).first(size)));
  auto longer = whole;
  longer.push_back({});
  CHECK_FALSE(read_tracked_pose(longer));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (std::size_t i = 0; i < 6; ++i) {
      TrackedPose pose{1, 2, 3, 4, 5, 6};
      pose[i] = bad;
      CHECK_FALSE(read_tracked_pose(datagram_of(pose)));
    }
}

TEST_CASE("no datagram puts the eyes out of the rig's reach or the head past a half turn") {
  const rig::HeadTracking tracking;
  for (const double huge : {1e3, 1e12, std::numeric_limits<double>::max()})
    for (const double sign : {1.0, -1.0}) {
      TrackedPose pose;
      pose.fill(sign * huge);
      const HeadPlace place = place_of(pose, tracking);
      for (int i = 0; i < 3; ++i) CHECK(std::abs(place.from_rest_m[i]) <= tracking.reach_m[i]);
      CHECK(std::abs(place.heading_rad) <= std::numbers::pi);
    }
}

TEST_CASE("a tracker that is heard is followed exactly and one that falls silent leaves the eyes gliding to rest") {
  const HeadPlace told{.from_rest_m = {0.1, -0.2, 0.05}, .heading_rad = 0.6};
  HeadMotion motion = followed(told);
  CHECK(motion.place.from_rest_m == told.from_rest_m);
  CHECK(motion.place.heading_rad == doctest::Approx(0.6));
  double largest_step_m = 0.0, silent_s = 0.0;
  while (silent_s < 3.0) {
    const Vec3 before = motion.place.from_rest_m;
    advance(motion, {}, tick_s);
    silent_s += tick_s;
    largest_step_m = std::max(largest_step_m, glm::distance(before, motion.place.from_rest_m));
    if (silent_s < tracker_is_lost_after_s - tick_s) CHECK(motion.place.from_rest_m == told.from_rest_m);
  }
  CHECK(motion.place.from_rest_m == Vec3(0.0));
  CHECK(motion.place.heading_rad == 0.0);
  CHECK(largest_step_m > 0.0);
  CHECK(largest_step_m < 1.6 * glm::length(told.from_rest_m) * tick_s / glide_s);
}

TEST_CASE("a head that turns past a half turn goes on the same way, and comes back as it went") {
  constexpr double degree = std::numbers::pi / 180.0;
  for (const double side : {1.0, -1.0}) {
    HeadMotion motion = followed({});
    const auto turn_to = [&](double from_deg, double to_deg) {
      for (double told_deg = from_deg; told_deg != to_deg; told_deg += from_deg < to_deg ? 1.0 : -1.0) {
        const double before_rad = motion.place.heading_rad;
        const double told_rad = std::remainder(side * degree * told_deg, 2.0 * std::numbers::pi);
        for (int i = 0; i < 2; ++i) advance(motion, HeadPlace{{}, told_rad}, tick_s);
        REQUIRE(std::abs(std::remainder(motion.place.heading_rad - before_rad, 2.0 * std::numbers::pi)) < 3.0 * degree);
        REQUIRE(std::abs(std::remainder(motion.place.heading_rad - told_rad, 2.0 * std::numbers::pi)) < 1e-9);
      }
    };
    turn_to(0.0, 200.0);
    turn_to(200.0, 178.0);
    turn_to(178.0, 200.0);
    // Lost back there, it glides home over the side that it turned by.
    bool passed_the_side = false;
    for (int i = 0; i < 240; ++i) {
      advance(motion, {}, tick_s);
      passed_the_side |= std::abs(motion.place.heading_rad - side * 90.0 * degree) < 5.0 * degree;
      REQUIRE(std::abs(motion.place.heading_rad + side * 90.0 * degree) > 5.0 * degree);
    }
    CHECK(passed_the_side);
    CHECK(motion.place.heading_rad == 0.0);
    // Found again straight ahead, it makes no turn of it.
    for (int i = 0; i < 240; ++i) {
      advance(motion, HeadPlace{}, tick_s);
      REQUIRE(std::abs(motion.place.heading_rad) < 1e-9);
    }
    // Two turns of a swivel chair leave nothing to unwind.
    turn_to(0.0, 720.0);
    CHECK(std::abs(motion.told_rad) <= furthest_rad);
  }
}

TEST_CASE("a head that is told to jump to and fro moves no faster than heads do") {
  Random random(7);
  HeadMotion motion = followed({});
  for (int i = 0; i < 600; ++i) {
    const HeadPlace before = motion.place;
    const auto anywhere = [&](double most) { return most * (2.0 * random.uniform() - 1.0); };
    advance(motion, HeadPlace{{anywhere(0.3), anywhere(0.3), anywhere(0.2)}, anywhere(3.0)}, tick_s);
    REQUIRE(glm::distance(before.from_rest_m, motion.place.from_rest_m) <= fastest_mps * tick_s * 1.0000001);
    REQUIRE(std::abs(std::remainder(motion.place.heading_rad - before.heading_rad, 2.0 * std::numbers::pi)) <=
            fastest_radps * tick_s * 1.0000001);
  }
}

TEST_CASE("the port is read without waiting, rubbish and a flood included, and the head's heading is the input's") {
  rig::HeadTracking tracking;
  tracking.port = 0;
  auto tracker = HeadTracker::open(tracking);
  REQUIRE(tracker);
  auto sender = net::UdpSocket::open({.bind = {net::loopback_ip, 0}});
  REQUIRE(sender);
  const auto send = [&](std::span<const std::byte> bytes) {
    sender->send(tracker->address(), bytes);
    sender->flush();
  };
  DriverInput input;
  input.gaze_heading_rad = 0.25;  // Of another device.
  tracker->move(input, tick_s);
  CHECK(input.gaze_heading_rad == 0.25);
  CHECK_FALSE(tracker->take_message());
  const auto pose = datagram_of({0.0, 0.0, -10.0, -40.0, 0.0, 0.0});
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < 20; ++j) send(std::span(pose).first(static_cast<std::size_t>(j)));
    send(pose);
    tracker->move(input, tick_s);
  }
  CHECK(input.head.from_rest_m.x == doctest::Approx(0.1));
  CHECK(input.gaze_heading_rad == doctest::Approx(40.0 * std::numbers::pi / 180.0));
  CHECK(tracker->take_message());
  for (int i = 0; i < 10000; ++i) send(pose);
  for (int i = 0; i < 400; ++i) tracker->move(input, tick_s);
  CHECK(tracker->take_message());
  CHECK(input.head.from_rest_m == Vec3(0.0));
}

TEST_CASE("an address that is not this machine's is told") {
  rig::HeadTracking tracking;
  for (const char* address : {"", "head", "192.0.2.77"}) {
    tracking.listen = address;
    CHECK_FALSE(HeadTracker::open(tracking));
  }
}

}  // namespace septet::car_io
