// The ray tracer on one core: samples a second. The Cornell box is that of tests/benchmarks/peers/ray_tracing.py (256²,
// 64 samples a pixel, six edges); the motorway is the scenario's, 10 km with 200 vehicles, of which the memory is told
// too.
#include <fstream>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>

#include "engine/instant/scene_summary.hpp"
#include "tests/engine/raytrace/cornell_box.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet::raytrace {
namespace {

RayTracer tracer_of(const scene::ResolvedScene& scene) {
  auto tracer = RayTracer::create(scene);
  if (!tracer) throw std::runtime_error(describe(tracer.error()));
  return std::move(*tracer);
}

/// Traces the whole picture as often as asked for.
void trace(benchmark::State& state, const RayTracer& tracer, std::uint32_t samples) {
  const instant::PixelRectangle picture = tracer.instant().views.front().viewport;
  double traced = 0.0;
  for (auto unused : state) {
    benchmark::DoNotOptimize(tracer.trace(picture));
    traced += double(picture.width) * picture.height * samples;
  }
  state.counters["samples"] = benchmark::Counter(traced, benchmark::Counter::kIsRate);
}

void cornell(benchmark::State& state) {
  const scene::ResolvedScene box = cornell_box();
  RayTracer tracer = tracer_of(box);
  const TraceSettings settings = cornell_settings(64);
  tracer.begin(before_cornell_box(256), settings);
  trace(state, tracer, settings.samples);
}

/// The most memory that this program has held since the peak was forgotten last.
double peak_gib() {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kib = 0.0;
  while (status >> word)
    if (word == "VmHWM:") status >> kib;
  return kib / (1024.0 * 1024.0);
}
void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

void motorway(benchmark::State& state, bool night) {
  forget_peak();
  const Motorway world;
  instant::FrameInput input = world.frame({"", 800.0, 0.0, night, false});
  world.add_traffic(input, 200, night);
  RayTracer tracer = tracer_of(world.scene());
  const TraceSettings settings{.samples = 4};
  tracer.begin(instant::describe(std::move(input), instant::summarise(world.scene())), settings);
  trace(state, tracer, settings.samples);
  state.counters["peak_gib"] = peak_gib();
}

#define SEPTET_TRACE(function, ...) \
  function(__VA_ARGS__)->Unit(benchmark::kMillisecond)->Repetitions(3)->ReportAggregatesOnly()
SEPTET_TRACE(BENCHMARK, cornell)->Name("trace/cornell")->Iterations(1);
SEPTET_TRACE(BENCHMARK_CAPTURE, motorway, noon, false)->Name("trace/motorway")->Iterations(1);
SEPTET_TRACE(BENCHMARK_CAPTURE, motorway, night, true)->Name("trace/motorway_night")->Iterations(1);
#undef SEPTET_TRACE

}  // namespace
}  // namespace septet::raytrace
