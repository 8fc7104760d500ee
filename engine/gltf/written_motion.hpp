#pragma once
/// Keys of a part as channels of an animation (glTF 2.0, 3.11).
///
/// The format knows no two values at one time. What only jumps is written in steps; where something else moves, too,
/// the value before a jump stands one step of a float earlier.

#include <cstddef>
#include <vector>

#include "engine/gltf/container.hpp"
#include "engine/gltf/written_buffer.hpp"
#include "engine/math/pose_keys.hpp"

namespace septet::gltf {

/// Adds channels and samplers to `animation`, for place, turn and size where the keys change them. `keys`: axes as here.
void add_written_keys(const std::vector<PoseKey>& keys, std::size_t node, WrittenBuffer& buffer, Json& animation);

}  // namespace septet::gltf
