/// Unit normals of 15,300 moving faces, all of them at one instant, by every method of the paper.

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include "engine/geometry/temporal_normals.hpp"
#include "tests/engine/geometry/morphs.hpp"

using namespace septet;

namespace {

void face_normals(benchmark::State& run, NormalMethod method) {
  const TemporalNormals normals(method, morphs::sphere_faces(morphs::blob, morphs::other_blob));
  FaceNormals at;
  float t = 0.0f;
  for (auto _ : run) {
    t = t < 1.0f ? t + 0.01f : 0.0f;
    normals.at(t, at);
    benchmark::DoNotOptimize(at.x.data());
    benchmark::ClobberMemory();
  }
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(normals.size()));
}

/// A screen's work for a pair of keyframes: 4 ticks at 120 a second are two frames.
void two_frames(benchmark::State& run, NormalMethod method) {
  const auto faces = morphs::sphere_faces(morphs::blob, morphs::other_blob);
  FaceNormals at;
  for (auto _ : run) {
    const TemporalNormals normals(method, faces);
    for (const float t : {0.25f, 0.75f}) {
      normals.at(t, at);
      benchmark::DoNotOptimize(at.x.data());
      benchmark::ClobberMemory();
    }
  }
}
BENCHMARK_CAPTURE(two_frames, t_variant, NormalMethod::t_variant)
    ->Name("face_normals_two_frames/15300")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(two_frames, linear, NormalMethod::linear)
    ->Name("face_normals_two_frames/15300/linear")
    ->Unit(benchmark::kMicrosecond);

const bool registered = [] {
  for (int method = 0; method < normal_method_count; ++method) {
    const auto which = static_cast<NormalMethod>(method);
    const std::string name =
        which == NormalMethod::t_variant ? "face_normals/15300" : fmt::format("face_normals/15300/{}", name_of(which));
    benchmark::RegisterBenchmark(name.c_str(), face_normals, which)->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
