#include "engine/raytrace/path_tracer.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/raytrace/matt_paths.hpp"
#include "engine/raytrace/path.hpp"

namespace septet::raytrace {
namespace {

template <std::size_t... N>
Packet<Path> paths_of(const World& world, const PathSettings& settings, Packet<PathStart>& starts,
                      std::index_sequence<N...>) {
  return {Path(world, settings, starts[N])...};
}

}  // namespace

void trace_paths(const World& world, const PathSettings& settings, std::uint32_t begun, std::uint32_t wanted,
                 Packet<PathStart>& starts) {
  if (settings.longest == 0) return;
  if (world.matt_faces() && !world.photons()) return trace_matt_paths(world, settings, begun, wanted, starts);
  const Geometry& geometry = world.geometry();
  RayPacket rays;
  HitPacket hits;
  for (std::size_t n = 0; n < packet_size; ++n) rays.set(n, starts[n].ray);
  const std::uint32_t met = geometry.intersect(begun, rays, Together::side_by_side, hits);
  Packet<Path> paths = paths_of(world, settings, starts, std::make_index_sequence<packet_size>());
  std::uint32_t go_on = 0, look = 0;
  for (std::size_t n = 0; n < packet_size; ++n) {
    if (!holds(begun, n)) continue;
    Path& path = paths[n];
    Hit hit = hits[n];
    if (!path.arrive(holds(met, n), hit, &starts[n].first)) continue;
    go_on |= 1u << n;
    if (!path.looks()) continue;
    look |= 1u << n;
    rays.set(n, path.shadow());
  }
  if (look) {
    const Float8 shares = geometry.unshadowed(look, rays);
    for (std::size_t n = 0; n < packet_size; ++n)
      if (holds(look, n)) paths[n].take_light(shares[n]);
  }
  for (std::size_t n = 0; n < packet_size; ++n) {
    if (holds(go_on & wanted, n)) paths[n].go_on();
    starts[n].radiance = paths[n].light();
  }
}

}  // namespace septet::raytrace
