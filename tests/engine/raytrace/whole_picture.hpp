#pragma once
/// A picture and its photons at once on this machine's cores; the film's programs deal buckets to processes instead.

#include <cstdint>
#include <mutex>
#include <vector>

#include "engine/core/parallel_for.hpp"
#include "engine/raytrace/ray_tracer.hpp"

namespace septet::raytrace {

/// Sends all photons of the instant begun last, on that many threads.
inline void send_photons(RayTracer& tracer, unsigned threads) {
  const auto buckets = tracer.photon_buckets();
  std::vector<std::vector<Photon>> photons(buckets.size());
  parallel_for(
      buckets.size(), [&](std::size_t n) { photons[n] = tracer.trace_photons(buckets[n]); }, threads);
  tracer.set_photons(photons);
}

/// Traces all buckets of the instant begun last.
inline TracedPicture whole_picture(const RayTracer& tracer, std::uint32_t width, std::uint32_t height) {
  TracedPicture picture(width, height);
  constexpr std::uint32_t bucket_side_px = 16;
  const auto buckets = buckets_of(width, height, bucket_side_px);
  std::mutex mutex;
  parallel_for(buckets.size(), [&](std::size_t n) {
    const Bucket bucket = tracer.trace(buckets[n]);
    const std::scoped_lock lock(mutex);
    picture.put(bucket);
  });
  return picture;
}

}  // namespace septet::raytrace
