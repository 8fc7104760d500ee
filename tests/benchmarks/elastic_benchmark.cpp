/// One step of an elastic beam, clamped at one end, twisted by one radian and bent by its weight (100 MPa, 15 ms), and
/// what stiffness costs. Goals of the project, one thread: 105 tetrahedra ≤ 0.07 ms, 5,000 ≤ 5 ms, 10,000 ≤ 15 ms,
/// 20,000 ≤ 15 ms at 100 MPa and ≤ 1.5 times that at 10 GPa.

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>

#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/physics/elastic/fixed_nodes.hpp"

namespace {

using namespace septet::elastic;

double thread_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Runs of 60 steps, each from where the body is now: it is wound up again before it has come to rest. Counts the
/// median of a step's processor time.
void time_steps(benchmark::State& state, ElasticBody body, const StepSettings& settings) {
  const ElasticBody start = body;
  std::vector<double> times_ms;
  int iterations = 0;
  step_elastic(body, settings);  // The factor at rest is made once in a body's life.
  for (auto _ : state) {
    const double begun_ms = thread_time_ms();
    iterations += step_elastic(body, settings).iterations;
    times_ms.push_back(thread_time_ms() - begun_ms);
    if (times_ms.size() % 60 != 0) continue;
    state.PauseTiming();
    body.position_m = start.position_m;
    body.velocity_mps = start.velocity_mps;
    state.ResumeTiming();
  }
  const auto steps = static_cast<double>(times_ms.size());
  std::ranges::nth_element(times_ms, times_ms.begin() + static_cast<std::ptrdiff_t>(times_ms.size() / 2));
  state.counters["median_ms"] = times_ms[times_ms.size() / 2];
  state.counters["tetrahedra"] = static_cast<double>(body.elements.size());
  state.counters["iterations"] = iterations / steps;
}

/// A beam of cubes of 0.1 m, clamped at one end and twisted.
ElasticBody twisted_beam(const Eigen::Vector3i& cells, double young_pa, double twist_rad) {
  auto body = *make_elastic_body(lattice_mesh(cells, 0.1 * cells.cast<double>()), {young_pa, 0.25, 1000.0});
  fix_nodes(body, {-1e-9, -1e-9, -1e-9}, {100, 100, 1e-9});
  const double length = 0.1 * cells.z();
  const Eigen::Vector3d axis(0.05 * cells.x(), 0.05 * cells.y(), 0);
  for (auto& x : body.position_m)
    x = axis + Eigen::AngleAxisd(twist_rad * x.z() / length, Eigen::Vector3d::UnitZ()) * (x - axis);
  return body;
}

void elastic_step(benchmark::State& state, Eigen::Vector3i cells) {
  StepSettings settings;
  settings.gravity_mps2 = {0, -9.81, 0};
  time_steps(state, twisted_beam(cells, 1e8, 1.0), settings);
}

/// What stiffness costs, of 20,000 tetrahedra: bent by their weight, or twisted and let go with as much damping as keeps
/// the twist's energy falling at any stiffness (docs/elastic.md, Limits).
void elastic_stiffness(benchmark::State& state, double young_pa, double twist_rad) {
  StepSettings settings;
  settings.gravity_mps2 = {0, -9.81, 0};
  if (twist_rad > 0.0) settings.damping_ratio = 0.5;
  time_steps(state, twisted_beam({10, 10, 40}, young_pa, twist_rad), settings);
}

/// The job of tests/benchmarks/peers/elastic_beam.py: the beam is let go straight and bends by its weight for 200
/// steps. Counts how far its end has come down, in the mean of the last hundred.
void elastic_bend(benchmark::State& state, Eigen::Vector3i cells) {
  auto body = *make_elastic_body(lattice_mesh(cells, 0.1 * cells.cast<double>()), {1e8, 0.25, 1000.0});
  fix_nodes(body, {-1e-9, -1e-9, -1e-9}, {100, 100, 1e-9});
  StepSettings settings;
  settings.gravity_mps2 = {0, -9.81, 0};
  const ElasticBody start = body;
  step_elastic(body, settings);
  constexpr int run = 200;
  double deflection_m = 0.0;
  int steps = 0;
  for (auto _ : state) {
    if (steps % run == 0) {
      state.PauseTiming();
      body.position_m = start.position_m;
      body.velocity_mps = start.velocity_mps;
      state.ResumeTiming();
    }
    step_elastic(body, settings);
    if (steps >= run / 2 && steps < run) {
      state.PauseTiming();
      int count = 0;
      double sum = 0.0;
      for (int i = 0; i < body.node_count(); ++i)
        if (body.rest_position_m[i].z() > 0.1 * cells.z() - 1e-9)
          sum += body.position_m[i].y() - body.rest_position_m[i].y(), ++count;
      deflection_m += sum / count / (run / 2);
      state.ResumeTiming();
    }
    ++steps;
  }
  state.counters["deflection_m"] = deflection_m;
}

}  // namespace

BENCHMARK_CAPTURE(elastic_bend, 105, Eigen::Vector3i(1, 1, 21))
    ->Name("elastic_bend/105")
    ->Iterations(600)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_bend, 990, Eigen::Vector3i(3, 3, 22))
    ->Name("elastic_bend/990")
    ->Iterations(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_bend, 5000, Eigen::Vector3i(6, 6, 28))
    ->Name("elastic_bend/5000")
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_step, 105, Eigen::Vector3i(1, 1, 21))
    ->Name("elastic_step/105")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_step, 990, Eigen::Vector3i(3, 3, 22))
    ->Name("elastic_step/990")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_step, 5000, Eigen::Vector3i(6, 6, 28))
    ->Name("elastic_step/5000")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_step, 10000, Eigen::Vector3i(8, 8, 31))
    ->Name("elastic_step/10000")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_step, 20000, Eigen::Vector3i(10, 10, 40))
    ->Name("elastic_step/20000")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, bent_100MPa, 1e8, 0.0)
    ->Name("elastic_stiffness/bent/100MPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, bent_1GPa, 1e9, 0.0)
    ->Name("elastic_stiffness/bent/1GPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, bent_10GPa, 1e10, 0.0)
    ->Name("elastic_stiffness/bent/10GPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, bent_100GPa, 1e11, 0.0)
    ->Name("elastic_stiffness/bent/100GPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, twisted_100MPa, 1e8, 1.0)
    ->Name("elastic_stiffness/twisted/100MPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, twisted_1GPa, 1e9, 1.0)
    ->Name("elastic_stiffness/twisted/1GPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, twisted_10GPa, 1e10, 1.0)
    ->Name("elastic_stiffness/twisted/10GPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(elastic_stiffness, twisted_100GPa, 1e11, 1.0)
    ->Name("elastic_stiffness/twisted/100GPa")
    ->Iterations(240)
    ->Unit(benchmark::kMillisecond);
