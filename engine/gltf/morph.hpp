#pragma once
/// Morph targets, as strong as a file's weights say (glTF 2.0, 3.7.2.2).

#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/gltf/accessors.hpp"
#include "engine/gltf/container.hpp"

namespace septet::gltf {

/// The node's weights, or else its mesh's; empty where neither has any.
std::vector<float> weights_of(const Json& node, const Json& mesh);

/// Adds the targets of a primitive to its positions, and to its normals where it has some. Error: a target of other rows
/// than the primitive.
Expected<void> add_targets(const Container& container, const Json& primitive, const std::vector<float>& weights,
                           Rows& positions, Rows& normals, const std::string& where);

}  // namespace septet::gltf
