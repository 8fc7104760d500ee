#pragma once
/// The compact forms of long runs of numbers (COMMANDS.md, "Runs").

#include <cstdint>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/scene/node.hpp"

namespace septet::scene {

/// `stride`: distance back to the value from which the difference is taken.
void put_reals(ByteWriter& out, std::span<const float> values, std::size_t stride);
void get_reals(ByteReader& in, std::span<float> values, std::size_t stride);

void put_integers(ByteWriter& out, std::span<const std::uint32_t> values);
void get_integers(ByteReader& in, std::span<std::uint32_t> values);

void put_corners(ByteWriter& out, std::span<const PolygonCorners> polygons);
void get_corners(ByteReader& in, std::span<PolygonCorners> polygons);

}  // namespace septet::scene
