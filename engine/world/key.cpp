#include "engine/world/key.hpp"

#include <array>

namespace septet {

std::string_view name_of(Key key) {
  static constexpr std::array<std::string_view, key_count> names{
      "Arrow up", "Arrow down", "Arrow left", "Arrow right", "Space", "Comma", "Full stop", "A",     "B",
      "D",        "E",          "F",          "G",           "H",     "L",     "M",         "P",     "Q",
      "R",        "S",          "V",          "W",           "X",     "F1",    "Enter",     "Escape"};
  return names[static_cast<std::size_t>(key)];
}

}  // namespace septet
