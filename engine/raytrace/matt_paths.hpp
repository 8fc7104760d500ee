#pragma once
/// Eight paths at once, edge by edge, in worlds lit by lamps alone: between surfaces that are flat, matt and static all
/// eight take the same steps with vectors of eight numbers. A path that meets anything else goes on by itself from
/// there (path.hpp). The random numbers are the same, so that each path finds the light that it would have found by
/// itself, but for rounding.

#include "engine/raytrace/path_tracer.hpp"

namespace septet::raytrace {

/// Same as trace_paths, for a world with matt faces and no photons.
void trace_matt_paths(const World& world, const PathSettings& settings, std::uint32_t begun, std::uint32_t wanted,
                      Packet<PathStart>& starts);

}  // namespace septet::raytrace
