#pragma once
/// Loads of a lorry, behind its cab.

#include <cstdint>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

enum class Load : std::uint8_t { none, box, tank, tipper, timber, fire };

/// Space for the load: from `rear` to `front`, over the floor, as high and half as wide as the lorry.
struct LoadBay {
  Load load = Load::box;
  float rear = 0.0f, front = 0.0f, half = 0.0f, height = 0.0f, floor = 1.08f;
};

void add_load(geometry::MeshBuilder& builder, const LoadBay& bay, DetailLevel level);

}  // namespace septet::scenery
