/// Impacts in plan. Goal of the project, one thread: a contact, from two overlapping outlines to the pulse that has been
/// begun, in at most 20 µs.

#include <benchmark/benchmark.h>

#include "tests/engine/physics/impact/two_bodies.hpp"

namespace {

using namespace septet;
using namespace septet::impact;

constexpr double step_s = 1.0 / 120.0;

/// A car that has just run into the side of one that crosses, half a step ago.
void contact(benchmark::State& state) {
  const Side crossing = car_at({2.25, 0.8}, 88.0, {0.5, 12.0});
  Side striking = car_at({0, 0}, 3.0, {13.5, 0});
  striking = moved(striking, nearest(striking.outline, crossing.outline).gap_m / 13.5 + 0.5 * step_s);
  if (!meet(striking, crossing, 0.5, step_s)) state.SkipWithError("they do not meet");
  for (auto _ : state) {
    Side first = striking, second = crossing;
    Engagement engagement;
    benchmark::DoNotOptimize(advance_engagement(0.5, step_s, engagement, first, second));
  }
}
BENCHMARK(contact)->Name("impact/contact");

/// A step of two that are engaged.
void engaged(benchmark::State& state) {
  const Side ahead = car_at({0, 0.5}, 0.0, {0, 0}), behind = moved(car_at({-4.5, 0}, 0.0, {15.0, 0}), 0.5 * step_s);
  Side first = behind, second = ahead;
  Engagement engagement;
  int steps = 0;
  for (auto _ : state) {
    if (steps++ % 8 == 0) {
      first = behind;
      second = ahead;
      engagement = {};
    }
    benchmark::DoNotOptimize(advance_engagement(0.5, step_s, engagement, first, second));
    first = moved(first, step_s);
    second = moved(second, step_s);
  }
}
BENCHMARK(engaged)->Name("impact/engaged_step");

}  // namespace
