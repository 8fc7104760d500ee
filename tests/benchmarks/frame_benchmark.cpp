// One virtual screen of the reference scene on lavapipe: CPU time of drawing a frame and reading it back.
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "engine/render/renderer.hpp"
#include "tests/engine/render/reference_scene.hpp"

namespace septet::render {
namespace {

void virtual_screen_frame(benchmark::State& state, std::uint32_t width, std::uint32_t height, Antialiasing antialiasing) {
  auto renderer = Renderer::create({width, height, DevicePreference::software, false, antialiasing, nullptr});
  if (!renderer) throw std::runtime_error(describe(renderer.error()));
  const ReferenceScene reference = reference_scene({{}, false, 1200});
  if (auto uploaded = renderer->upload(reference.scene); !uploaded) throw std::runtime_error(describe(uploaded.error()));
  FrameInput input;
  input.environment = reference_day();
  for (int i = 0; i < 24; ++i)
    input.participants.push_back(reference_car(reference, {-20.0 + 9.0 * i, -7.5 + 3.75 * (i % 5), 0.02}));
  double x_m = 0.0;
  for (auto unused : state) {
    input.views = {forward_view({x_m, -1.875, 0}, width, height)};
    if (!renderer->draw(input) || !renderer->read_back()) throw std::runtime_error("the frame was not drawn");
    x_m = x_m > 100.0 ? 0.0 : x_m + 0.5;
  }
  state.counters["triangles"] = renderer->statistics().triangles;
  state.counters["draws"] = renderer->statistics().draws;
}

BENCHMARK_CAPTURE(virtual_screen_frame, 640x420, 640, 420, Antialiasing::automatic)
    ->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->Iterations(40)->Repetitions(3)
    ->ReportAggregatesOnly();
BENCHMARK_CAPTURE(virtual_screen_frame, 640x420_four_samples, 640, 420, Antialiasing::multisampled)
    ->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime()->Iterations(40)->Repetitions(3)
    ->ReportAggregatesOnly();

}  // namespace
}  // namespace septet::render
