#pragma once
/// Size and axes of a user's own model, as told to the author, and a doubt where no metres give such a size.

#include <optional>
#include <string>

#include "engine/gltf/gltf.hpp"

namespace septet::scenery {

/// One sentence: triangles, and the extent along each axis by its name here and in glTF (3.4).
std::string told_size(const gltf::Model& model);

struct SizeDoubt {
  std::string what;
  const char* remedy = "";
};
/// Nothing on a road is longer than a hundred metres or smaller than a hand's breadth: centimetres, millimetres, or
/// metres taken for centimetres. Empty for a size that metres give.
std::optional<SizeDoubt> doubted_size(const gltf::Model& model);

}  // namespace septet::scenery
