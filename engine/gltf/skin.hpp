#pragma once
/// Skinned meshes in the pose in which the file's nodes stand (glTF 2.0, 3.7.3).

#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "engine/core/expected.hpp"
#include "engine/gltf/accessors.hpp"
#include "engine/gltf/container.hpp"
#include "engine/gltf/nodes.hpp"

namespace septet::gltf {

/// By joint: its place times its inverse bind matrix.
struct Skin {
  std::vector<glm::mat4> model_from_bound;
};

/// Error: no such skin, more than 1,024 joints, a joint outside of the scene, fewer matrices than joints.
Expected<Skin> read_skin(const Container& container, std::int64_t skin, const PlacedNodes& nodes,
                         const std::string& where);

/// Moves each position by the weighted mean of its joints (JOINTS_n and WEIGHTS_n, up to four sets), weights scaled to
/// a sum of 1; without any a vertex follows its first joint. Returns true if the skin mirrors the mesh. Error: no or
/// unequal rows, a joint that the skin does not have.
Expected<bool> place_by_skin(const Container& container, const Json& attributes, const Skin& skin, Rows& positions,
                             const std::string& where);

}  // namespace septet::gltf
