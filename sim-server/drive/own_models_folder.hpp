#pragma once
/// The folder of a person's own models: NAME.glb or NAME.gltf replaces what has that name (docs/own-models.md).

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/scenery/own_models.hpp"

namespace septet::server {

struct OwnModelsFolder {
  scenery::OwnModels models;
  std::vector<std::string> messages;  ///< What somebody should know of them: a size that differs, what was left out.
};

/// Other files in the folder are passed over. Error: there is no such folder, a name that nothing has, two files of one name, a file that cannot
/// be read, or is no glTF that is drawn.
Expected<OwnModelsFolder> read_own_models(const std::filesystem::path& folder);

}  // namespace septet::server
