#include "engine/math/incremental_turn.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/math/spherical_interpolation.hpp"
#include "tests/engine/math/orientation_turn.hpp"
#include "tests/engine/math/other_turns.hpp"
#include "tests/relative.hpp"

using namespace septet;

namespace {

template <class Scalar, std::size_t Dimension>
Scalar length_error(const UnitVector<Scalar, Dimension>& v) {
  long double squares = 0;
  for (const Scalar part : v) squares += static_cast<long double>(part) * part;
  return static_cast<Scalar>(std::abs(std::sqrt(squares) - 1.0L));
}

/// The angle from the first axis in the plane of the first two.
template <class Scalar>
double angle_of(const UnitVector<Scalar, 2>& v) {
  return std::atan2(static_cast<double>(v[1]), static_cast<double>(v[0]));
}

struct Drift {
  double length = 0.0, end_rad = 0.0;
};

/// The worst of speeding up, half of it and slowing down, over a turn of two radians.
template <class Scalar>
Drift drift_after(std::size_t steps) {
  Drift worst;
  for (const double sigma : {1.0, 0.5, -1.0}) {
    const double theta = 2.0;
    auto turn = *IncrementalTurn<Scalar, 2>::between(
        {1, 0}, {static_cast<Scalar>(std::cos(theta)), static_cast<Scalar>(std::sin(theta))}, steps,
        static_cast<Scalar>(sigma));
    for (std::size_t n = 0; n < steps; ++n) turn.advance();
    worst.length = std::max<double>(worst.length, length_error<Scalar, 2>(turn.value()));
    worst.end_rad = std::max(worst.end_rad, std::abs(angle_of<Scalar>(turn.value()) - theta));
  }
  return worst;
}

}  // namespace

TEST_CASE("every step of a turn lies where the quadratic angle says") {
  for (const double sigma : {-1.0, -0.3, 0.0, 0.6, 1.0}) {
    const double theta = 1.3;
    auto turn = *IncrementalTurn<double, 2>::between({1, 0}, {std::cos(theta), std::sin(theta)}, 50, sigma);
    for (int n = 0; n <= 50; ++n, turn.advance()) {
      const double t = n / 50.0;
      REQUIRE(std::abs(angle_of<double>(turn.value()) - theta * (sigma * t * t + (1 - sigma) * t)) < 1e-13);
    }
  }
}

TEST_CASE("orientations turn step by step as they do at a single instant") {
  const Quat from = orientation_from_angles(0.3, 0.2, -0.4), to = orientation_from_angles(2.0, -0.5, 0.9);
  for (const Quat& target : {to, -to}) {
    auto turn = *turn_between(from, target, 40, 0.7);
    for (int n = 0; n <= 40; ++n, turn.advance()) {
      const Quat expected = slerp_quadratic(from, target, 0.7, n / 40.0);
      REQUIRE(std::abs(std::abs(glm::dot(to_quat(turn.value()), expected)) - 1.0) < 1e-13);
    }
  }
}

TEST_CASE("vectors of seven dimensions turn within their plane") {
  UnitVector<double, 7> from{}, to{};
  from[1] = 1.0;
  to[1] = 0.6, to[5] = -0.8;
  auto turn = *IncrementalTurn<double, 7>::between(from, to, 10);
  for (int n = 0; n < 10; ++n) {
    turn.advance();
    REQUIRE(length_error<double, 7>(turn.value()) < 1e-14);
    REQUIRE(turn.value()[0] == 0.0);
  }
  CHECK(turn.value()[5] == doctest::Approx(-0.8));
}

TEST_CASE("in double the length drifts little without renormalisation") {
  const Drift thousand = drift_after<double>(1000), million = drift_after<double>(1'000'000);
  CHECK(thousand.length < 1e-10);
  CHECK(thousand.end_rad < 1e-12);
  CHECK(million.length < 5e-5);
  CHECK(million.end_rad < 1e-8);
}

TEST_CASE("in float renormalisation keeps unit length for a million steps") {
  CHECK(drift_after<float>(1000).length < 3e-7);
  CHECK(drift_after<float>(1000).end_rad < 5e-4);
  CHECK(drift_after<float>(1'000'000).length < 3e-7);
}

TEST_CASE("equal vectors stay and antipodal ones are refused") {
  using Turn = IncrementalTurn<double, 3>;
  auto still = *Turn::between({0, 1, 0}, {0, 1, 0}, 5, 0.5);
  still.advance();
  CHECK(still.value() == UnitVector<double, 3>{0, 1, 0});
  CHECK(!Turn::between({0, 1, 0}, {0, -1, 0}, 5));
  // Orientations with opposite signs are equal.
  const Quat q = orientation_from_angles(1.0, 0.0, 0.0);
  auto same = *turn_between(q, -q, 5);
  same.advance();
  CHECK(to_quat(same.value()) == q);
  // A turn by nearly half a circle still ends where it should.
  auto half = *Turn::between({1, 0, 0}, {-std::cos(1e-5), std::sin(1e-5), 0}, 100);
  for (int n = 0; n < 100; ++n) half.advance();
  CHECK(half.value()[1] == relative(std::sin(1e-5), 1e-6));
}

TEST_CASE("a turn refuses sigma beyond one and no steps and vectors that are not of unit length") {
  using Turn = IncrementalTurn<double, 3>;
  CHECK(!Turn::between({1, 0, 0}, {0, 1, 0}, 5, 1.01));
  CHECK(!Turn::between({1, 0, 0}, {0, 1, 0}, 5, std::nan("")));
  CHECK(!Turn::between({1, 0, 0}, {0, 1, 0}, 0));
  CHECK(!Turn::between({1, 0, 0}, {0, 0, 0}, 5));
  CHECK(!Turn::between({1, 0, 0}, {std::nan(""), 1, 0}, 5));
}

TEST_CASE("Chebyshev's recurrence turns by equal angles, and its error grows with steps over angle") {
  const double theta = 1.3;
  for (const auto& bound : {std::pair(50, 1e-12), std::pair(4096, 1e-8)}) {
    const int steps = bound.first;
    CAPTURE(steps);
    ChebyshevTurn<2> turn({1, 0}, {std::cos(theta), std::sin(theta)}, static_cast<std::size_t>(steps));
    double worst_rad = 0.0;
    for (int n = 0; n <= steps; ++n, turn.advance())
      worst_rad = std::max(worst_rad, std::abs(angle_of<double>(turn.value()) - theta * n / steps));
    CHECK(worst_rad < bound.second);
  }
}

TEST_CASE("many orientations turn in step as each does alone, speeding up and slowing down") {
  constexpr std::size_t steps = 200;
  std::array<TurnChannels<9>::Channel, 9> channels;
  for (int i = 0; i < 9; ++i) {
    const Quat from = orientation_from_angles(0.3 * i, 0.2, -0.4),
               to = orientation_from_angles(0.3 * i + 1.0, -0.5, 0.9);
    channels[static_cast<std::size_t>(i)] = {
        {from.w, from.x, from.y, from.z}, {to.w, to.x, to.y, to.z}, 0.25 * i - 1.0};
  }
  TurnChannels<9> all(channels, steps);
  TurnChannels<9>::Row component{};
  std::vector<IncrementalTurn<double, 4>> each;
  each.reserve(channels.size());
  for (const auto& channel : channels)
    each.push_back(*IncrementalTurn<double, 4>::between(channel.from, channel.to, steps, channel.sigma));
  for (std::size_t step = 0; step < steps; ++step) {
    all.advance();
    for (auto& turn : each) turn.advance();
    for (std::size_t n = 0; n < 4; ++n) {
      all.write(n, component);
      for (std::size_t i = 0; i < each.size(); ++i) REQUIRE(std::abs(component[i] - each[i].value()[n]) < 1e-12);
    }
  }
}
