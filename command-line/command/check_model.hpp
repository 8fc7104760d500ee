#pragma once
/// A user's model (glTF 2.0) checked as a drive reads it, and what was found in it.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/road/opendrive_reader.hpp"

namespace septet::server {

struct CheckedModel {
  std::vector<road::Finding> findings;
  std::vector<std::string> found;  ///< Sentences: its size, its parts that move or shine, its materials.
};

/// `file` as on the command line. A file that is named after a vehicle of the catalogue is held against its size.
/// Warnings: contents that are passed over, and a size that no metres give.
CheckedModel check_model(const std::filesystem::path& file);

}  // namespace septet::server
