#include "command-line/command/last_line.hpp"

#include <fstream>

#include "engine/core/printable.hpp"

namespace septet::server {

std::string last_line_of(const std::filesystem::path& log) {
  std::string last;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);)
    if (line.find_first_not_of(" \r\t") != std::string::npos) last = line;
  return printable(last);
}

}  // namespace septet::server
