// Ice on lavapipe as the paper measured it (section 4, figures 6 and 7): the irregular cube of 4800 triangles with 2
// cracks and 19 planes of air at 1024 × 768, over a fifth of the picture and over all of it, with parts left out.
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "engine/render/renderer.hpp"
#include "sim-client/ice/ice_viewer.hpp"

namespace septet::ice_viewer {
namespace {

enum Parts : unsigned {
  nothing = 0,
  body = 1,
  two_sided = 2,
  cracks = 4,
  air = 8,
  inside = cracks | air,
  quality = 16
};

void ice_frame(benchmark::State& state, double share_of_picture, unsigned parts) {
  IceOptions options;
  options.width_px = 1024;
  options.height_px = 768;
  options.share_of_picture = share_of_picture;
  options.look.two_sided = parts & two_sided;
  options.look.mode = parts & quality ? ice::Mode::quality : ice::Mode::paper;
  if (!(parts & cracks)) options.cracks = 0;
  if (!(parts & air)) options.air_planes = 0;
  const ice::Surface surface = ice::cube();
  auto renderer = render::Renderer::create({options.width_px, options.height_px, render::DevicePreference::software,
                                            false, render::Antialiasing::none, nullptr});
  if (!renderer || !renderer->upload(scene_around(options.surroundings)))
    throw std::runtime_error("the benchmark of ice has no device");
  double turn_rad = 0.0;
  const auto draw = [&] {
    instant::FrameInput input = frame_of(surface, options, turn_rad);
    if (!(parts & body)) input.ice.clear();
    if (!renderer->draw(input) || !renderer->read_back()) throw std::runtime_error("the frame failed");
    turn_rad += 0.05;
  };
  draw();
  draw();
  for (auto unused : state) draw();
}

#define SEPTET_ICE_FRAME(name, share, parts)       \
  BENCHMARK_CAPTURE(ice_frame, name, share, parts) \
      ->Unit(benchmark::kMillisecond)              \
      ->MeasureProcessCPUTime()                    \
      ->UseRealTime()                              \
      ->Iterations(12)                             \
      ->Repetitions(3)                             \
      ->ReportAggregatesOnly()
constexpr double fifth = 0.33, full = 4.0;  // The cube covers less than its ball.
SEPTET_ICE_FRAME(fifth, fifth, body | two_sided | inside);
SEPTET_ICE_FRAME(fifth_one_sided, fifth, body | inside);
SEPTET_ICE_FRAME(fifth_clear, fifth, body | two_sided);
SEPTET_ICE_FRAME(fifth_no_cracks, fifth, body | two_sided | air);
SEPTET_ICE_FRAME(fifth_no_air, fifth, body | two_sided | cracks);
SEPTET_ICE_FRAME(fifth_quality, fifth, body | two_sided | inside | quality);
SEPTET_ICE_FRAME(fifth_no_ice, fifth, nothing);
SEPTET_ICE_FRAME(full, full, body | two_sided | inside);
SEPTET_ICE_FRAME(full_one_sided, full, body | inside);
SEPTET_ICE_FRAME(full_clear, full, body | two_sided);
SEPTET_ICE_FRAME(full_no_cracks, full, body | two_sided | air);
SEPTET_ICE_FRAME(full_no_air, full, body | two_sided | cracks);
SEPTET_ICE_FRAME(full_quality, full, body | two_sided | inside | quality);
#undef SEPTET_ICE_FRAME

}  // namespace
}  // namespace septet::ice_viewer
