/// Unit normals of 15,300 moving faces, all of them at one instant, by every method of the paper.

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include "engine/geometry/temporal_normals.hpp"
#include "tests/engine/geometry/morphs.hpp"

using namespace septet;

namespace {

void face_normals(benchmark::State& run, NormalMethod method) {
  const TemporalNormals normals(
      method, morphs::sphere_faces(morphs::blob, morphs::other_blob));
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

const bool registered = [] {
  for (int method = 0; method < normal_method_count; ++method) {
    const auto which = static_cast<NormalMethod>(method);
    const std::string name = which == NormalMethod::t_variant
                                 ? "face_normals/15300"
                                 : fmt::format("face_normals/15300/{}", name_of(which));
    benchmark::RegisterBenchmark(name.c_str(), face_normals, which)->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
