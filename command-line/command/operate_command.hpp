#pragma once
/// `septet operate`: the operator's page without a drive. Each drive that is chosen there is a `septet drive` of its own, as it would be
/// typed, which serves the page while it lasts; after that the page is here again.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

struct OperateOptions {
  std::uint16_t port = 0;               ///< Of the page on 127.0.0.1; 0: any free one.
  std::vector<std::string> page_hosts;  ///< By what names, beside this machine's own, it may be asked for.
  std::filesystem::path out;            ///< Where each drive gets a folder; empty: out/drives of the data folder.
  std::filesystem::path keys;  ///< Of a rig of several machines, whose screens run already: septet-server is started.
  std::vector<std::filesystem::path> data;  ///< Folders of one's own rigs, scenarios and experiments (own_files.hpp).
  std::string
      rig;  ///< Chosen where the page chooses no other, and what lies beside it can be chosen; empty: Septet's own choice.
  std::filesystem::path models;  ///< Folder of a person's own models, for each drive; empty: none.
};

/// Until a signal comes, which ends a drive that goes on in order. Prints the page's address to standard output.
Expected<int> run_operate(OperateOptions options);

}  // namespace septet::server
