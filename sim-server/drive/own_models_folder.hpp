#pragma once
/// A user's folder of models: NAME.glb or NAME.gltf replaces the model of that name (docs/own-models.md).

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/scenery/own_models.hpp"

namespace septet::server {

struct OwnModelsFolder {
  scenery::OwnModels models;
  std::vector<std::string> messages;  ///< For the user: models of a different size, parts that were ignored.
};

/// Skips other files. Error: there is no such folder, nothing is called like a file, two files have the same name, or a
/// file cannot be read or contains no glTF that Septet draws.
Expected<OwnModelsFolder> read_own_models(const std::filesystem::path& folder);

}  // namespace septet::server
