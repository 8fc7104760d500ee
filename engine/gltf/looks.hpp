#pragma once
/// Materials and their pictures (glTF 2.0, 3.9 and 3.8).

#include "engine/gltf/container.hpp"
#include "engine/gltf/gltf.hpp"

namespace septet::gltf {

/// Fills `model`'s looks, one for each material of the file in its order and a plain one behind them, and its pictures.
Expected<void> read_looks(const Container& container, Model& model);

}  // namespace septet::gltf
