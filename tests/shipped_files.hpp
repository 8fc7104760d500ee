#pragma once
/// Files as text, mostly of the source tree.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/checkout.hpp"

namespace septet {

/// The bytes of a file; empty if it cannot be read.
inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A file of the source tree, such as "rigs/desktop.toml"; throws if it does not exist.
inline std::string shipped_text(const std::string& name) {
  std::string text = text_of(std::filesystem::path(source_folder()) / name);
  if (text.empty()) throw std::runtime_error(name + " is missing or empty");
  return text;
}

}  // namespace septet
