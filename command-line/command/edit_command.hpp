#pragma once
/// `septet edit`: changes the world of a running drive (docs/editing.md).

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

struct EditOptions {
  std::filesystem::path keys;                ///< Folder with the key, server.public and the address.
  std::string key, server;                   ///< As find_edit_place takes them.
  std::vector<std::filesystem::path> files;  ///< Lines; empty: standard input.
  bool json = false;  ///< For programs: answers in JSON, and lines are taken before earlier ones are answered.
};

/// Returns 0 if all that was asked for was done.
Expected<int> run_edit(const EditOptions& options);

}  // namespace septet::server
