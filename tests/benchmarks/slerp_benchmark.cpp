/// Turning an orientation in 4096 steps, double. Items are steps of one orientation. One channel: `slerp_quadratic`, and
/// slowing down, against `slerp_trigonometric` (the same angles by sine and cosine), `slerp_chebyshev` (equal angles alone)
/// and `slerp_glm`. `slerp_channels` turns 64 at once.

#include <array>

#include <benchmark/benchmark.h>

#include <glm/gtc/quaternion.hpp>

#include "engine/math/incremental_turn.hpp"
#include "tests/engine/math/orientation_turn.hpp"
#include "tests/engine/math/other_turns.hpp"

using namespace septet;

namespace {

constexpr std::size_t steps = 4096;
constexpr double sigma = 0.5;
const Quat from = orientation_from_angles(0.3, 0.2, -0.4), to = orientation_from_angles(2.0, -0.5, 0.9);
using Path = std::vector<UnitVector<double, 4>>;

/// `walk` writes one orientation for each step into the path.
template <class Walk>
void time_walk(benchmark::State& run, Walk walk) {
  Path path(steps);
  for (auto _ : run) {
    walk(path);
    benchmark::DoNotOptimize(path.data());
    benchmark::ClobberMemory();
  }
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(steps));
}

void slerp_quadratic_steps(benchmark::State& run, double by_sigma) {
  time_walk(run, [by_sigma](Path& path) {
    auto turn = *turn_between(from, to, steps, by_sigma);
    for (auto& q : path) {
      turn.advance();
      q = turn.value();
    }
  });
}

void slerp_trigonometric(benchmark::State& run) {
  time_walk(run, [](Path& path) {
    const double dot = glm::dot(from, to);
    const Quat across = glm::normalize(to - from * dot);
    const double theta = std::acos(dot), k = static_cast<double>(steps);
    const double a = sigma * theta / (k * k), b = (1.0 - sigma) * theta / k;
    double angle = 0.0, change = a + b;
    for (auto& q : path) {
      angle += change;
      change += 2.0 * a;
      const double c = std::cos(angle), s = std::sin(angle);
      q = {from.w * c + across.w * s, from.x * c + across.x * s, from.y * c + across.y * s, from.z * c + across.z * s};
    }
  });
}

void slerp_glm(benchmark::State& run) {
  time_walk(run, [](Path& path) {
    double n = 0.0;
    for (auto& q : path) {
      const double t = ++n / static_cast<double>(steps);
      const Quat value = glm::slerp(from, to, t * (sigma * t + (1.0 - sigma)));
      q = {value.w, value.x, value.y, value.z};
    }
  });
}

void slerp_chebyshev(benchmark::State& run) {
  time_walk(run, [](Path& path) {
    ChebyshevTurn<4> turn({from.w, from.x, from.y, from.z}, {to.w, to.x, to.y, to.z}, steps);
    for (auto& q : path) {
      turn.advance();
      q = turn.value();
    }
  });
}

void slerp_channels(benchmark::State& run) {
  using Channels = TurnChannels<64>;
  std::array<Channels::Channel, 64> channels;
  channels.fill({{from.w, from.x, from.y, from.z}, {to.w, to.x, to.y, to.z}, sigma});
  std::array<Channels::Row, 4> components{};
  for (auto _ : run) {
    Channels all(channels, steps);
    for (std::size_t step = 0; step < steps; ++step) {
      all.advance();
      for (std::size_t n = 0; n < 4; ++n) all.write(n, components[n]);
      benchmark::DoNotOptimize(components);
    }
  }
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(steps * channels.size()));
}

BENCHMARK_CAPTURE(slerp_quadratic_steps, speeding_up, sigma)->Name("slerp_quadratic")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(slerp_quadratic_steps, slowing_down, -sigma)
    ->Name("slerp_quadratic/slowing_down")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(slerp_chebyshev)->Unit(benchmark::kMicrosecond);
BENCHMARK(slerp_channels)->Unit(benchmark::kMicrosecond);
BENCHMARK(slerp_trigonometric)->Unit(benchmark::kMicrosecond);
BENCHMARK(slerp_glm)->Unit(benchmark::kMicrosecond);

}  // namespace
