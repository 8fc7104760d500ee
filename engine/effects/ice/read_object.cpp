#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/objects.hpp"

namespace septet::ice {
namespace {

constexpr std::size_t most_triangles = 2'000'000;

std::string_view next_word(std::string_view& line) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return line = {};
  const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

template <class T>
bool read_number(std::string_view word, T& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

Expected<Surface> read_object(std::string_view text, std::string_view where) {
  std::vector<glm::vec3> points;
  Surface surface;
  std::vector<glm::vec3> polygon;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto refuse = [&](const std::string& what, const char* how) {
      return failure(what, fmt::format("{}:{}", where, number), how);
    };
    const std::string_view kind = next_word(line);
    if (kind == "v") {
      glm::vec3 point;
      for (int c = 0; c < 3; ++c) {
        const std::string_view word = next_word(line);
        if (!read_number(word, point[c]) || !std::isfinite(point[c]) || std::abs(point[c]) > 1e6f)
          return refuse(fmt::format("\"{}\" is no coordinate", word.substr(0, 40)), "write v X Y Z, within a million");
      }
      points.push_back(point);
    } else if (kind == "f") {
      polygon.clear();
      for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
        long index = 0;
        if (!read_number(word.substr(0, word.find('/')), index) || index == 0 ||
            std::abs(index) > static_cast<long>(points.size()))
          return refuse(fmt::format("\"{}\" is no vertex", word.substr(0, 40)), "name vertices above it, from 1");
        polygon.push_back(
            points[static_cast<std::size_t>(index > 0 ? index - 1 : static_cast<long>(points.size()) + index)]);
      }
      for (std::size_t i = 2; i < polygon.size(); ++i)
        for (const std::size_t corner : {std::size_t{0}, i - 1, i}) surface.push_back({polygon[corner], {}, {}});
      if (surface.size() > 3 * most_triangles)
        return refuse(fmt::format("more than {} triangles", most_triangles), "simplify the mesh");
    }
  }
  if (surface.empty()) return failure("there is no triangle in it", std::string(where), "give a mesh with f lines");
  fit(surface);
  smooth(surface);
  return surface;
}

}  // namespace septet::ice
