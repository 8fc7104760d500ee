#pragma once
/// `septet operate`: the operator's page without a drive. Each drive that is chosen there is a `septet drive` of its
/// own, as it would be typed, which serves the page while it lasts; after that the page is here again.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

struct OperateOptions {
  std::uint16_t port = 0;               ///< Port of the page on 127.0.0.1; 0: any free one.
  std::vector<std::string> page_hosts;  ///< Allowed host names of the page, beside this machine's own.
  std::filesystem::path out;            ///< Parent of each drive's folder; empty: out/drives of the data folder.
  std::filesystem::path keys;  ///< For a rig of several machines, whose screens run already: septet-server is started.
  std::vector<std::filesystem::path> data;  ///< User folders with rigs, scenarios and experiments (own_files.hpp).
  std::string rig;  ///< Default rig of the page, whose neighbours can be chosen too; empty: Septet's own choice.
  std::filesystem::path models;  ///< Folder of a person's own models, for each drive; empty: none.
};

/// Runs until a signal comes, which ends a running drive in order. Prints the page's address to standard output.
Expected<int> run_operate(OperateOptions options);

}  // namespace septet::server
