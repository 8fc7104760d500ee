#pragma once
/// Properties that an author gave to nodes, as modelling programs write them (glTF 2.0, 3.5 and `extras`).

#include <string>
#include <vector>

#include "engine/gltf/container.hpp"
#include "engine/gltf/gltf.hpp"

namespace septet::gltf {

/// Adds the members of a node's `extras`: truths, finite numbers, texts of up to 1,000 bytes, and lists of three
/// numbers. A name that is known keeps its first value. What is of no such kind, or beyond 64 members, gets a sentence
/// in `left_out`, once a name.
void add_extras(const Json& node, std::vector<Extra>& extras, std::vector<std::string>& left_out);

}  // namespace septet::gltf
