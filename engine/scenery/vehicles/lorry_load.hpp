#pragma once
/// What a lorry carries behind its cab.

#include <cstdint>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

enum class Load : std::uint8_t { none, box, tank, tipper, timber, fire };

/// The room for it: from `rear` to `front`, over the floor, as high and half as wide as the lorry.
struct LoadBay {
  Load load = Load::box;
  float rear = 0.0f, front = 0.0f, half = 0.0f, height = 0.0f, floor = 1.08f;
};

void add_load(geometry::MeshBuilder& builder, const LoadBay& bay, DetailLevel level);

}  // namespace septet::scenery
