/// One step of an elastic beam, clamped at one end, twisted by one radian and bent by its weight
/// (effects-physics: 100 MPa, 15 ms). Goals of the project, one thread: 105 tetrahedra ≤ 0.07 ms,
/// 5,000 ≤ 5 ms, 10,000 ≤ 15 ms.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>

#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/physics/elastic/fixed_nodes.hpp"

namespace {

using namespace septet::elastic;

void elastic_step(benchmark::State& state, Eigen::Vector3i cells) {
  auto body = *make_elastic_body(lattice_mesh(cells, 0.1 * cells.cast<double>()), {1e8, 0.25, 1000.0});
  fix_nodes(body, {-1e-9, -1e-9, -1e-9}, {100, 100, 1e-9});
  const double length = 0.1 * cells.z();
  const Eigen::Vector3d axis(0.05 * cells.x(), 0.05 * cells.y(), 0);
  for (auto& x : body.position_m) x = axis + Eigen::AngleAxisd(x.z() / length, Eigen::Vector3d::UnitZ()) * (x - axis);
  StepSettings settings;
  settings.gravity_mps2 = {0, -9.81, 0};
  const ElasticBody start = body;
  int iterations = 0, steps = 0;
  step_elastic(body, settings);  // The factor at rest is made once in a body's life.
  for (auto _ : state) {
    iterations += step_elastic(body, settings).iterations;
    ++steps;
    if (steps % 60 == 0) {  // Wound up again, before the twist has died down.
      state.PauseTiming();
      body.position_m = start.position_m;
      body.velocity_mps = start.velocity_mps;
      state.ResumeTiming();
    }
  }
  state.counters["tetrahedra"] = static_cast<double>(body.elements.size());
  state.counters["iterations"] = static_cast<double>(iterations) / steps;
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
