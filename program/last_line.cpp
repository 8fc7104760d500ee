#include "program/last_line.hpp"

#include <algorithm>
#include <fstream>

#include "engine/core/printable.hpp"

namespace septet::program {
namespace {

/// A log may be long, and its last line stands at its end.
constexpr std::streamoff looked_at_bytes = 1 << 16;

}  // namespace

std::string last_line(const std::filesystem::path& log) {
  std::ifstream stream(log, std::ios::binary);
  stream.seekg(0, std::ios::end);
  stream.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(stream.tellg()) - looked_at_bytes));
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) last = line;
  return printable(last);
}

}  // namespace septet::program
