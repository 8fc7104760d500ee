/// Turning an orientation in 4096 steps, one channel, double. Items are steps. `slerp_quadratic` against
/// `slerp_trigonometric` (the same angles by sine and cosine) and `slerp_glm`.

#include <benchmark/benchmark.h>

#include <glm/gtc/quaternion.hpp>

#include "engine/math/incremental_turn.hpp"
#include "tests/engine/math/orientation_turn.hpp"

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

void slerp_quadratic_steps(benchmark::State& run) {
  time_walk(run, [](Path& path) {
    auto turn = *turn_between(from, to, steps, sigma);
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

BENCHMARK(slerp_quadratic_steps)->Name("slerp_quadratic")->Unit(benchmark::kMicrosecond);
BENCHMARK(slerp_trigonometric)->Unit(benchmark::kMicrosecond);
BENCHMARK(slerp_glm)->Unit(benchmark::kMicrosecond);

}  // namespace
