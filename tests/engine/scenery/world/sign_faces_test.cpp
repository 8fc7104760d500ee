#include "engine/scenery/world/sign_faces.hpp"

#include <algorithm>

#include <doctest/doctest.h>

#include "engine/image/font.hpp"

namespace septet::scenery {
namespace {

/// Columns, from a third of the board on, in which every pixel of a line's rows is the ground's blue.
int blank_columns_before_the_number(const image::Image& board) {
  const auto is_white = [&](std::uint32_t x, std::uint32_t y) {
    const image::Color c = board.at(x, y);
    return c.red > 100;
  };
  int longest = 0, run = 0;
  bool text_before = false;
  for (std::uint32_t x = 60; x < board.width - 16; ++x) {
    bool any = false;
    for (std::uint32_t y = 30; y < board.height - 30; ++y) any = any || is_white(x, y);
    if (any) {
      longest = text_before ? std::max(longest, run) : longest;
      text_before = true;
      run = 0;
    } else {
      ++run;
    }
  }
  return longest;
}

}  // namespace

TEST_CASE("a place and its distance keep apart on a sign however long the name is") {
  if (!image::Font::find(image::FontStyle::bold)) return;
  for (const char* place : {"Norrbro", "Lindköping", "Skellefteå", "Gammelstaden norra"}) {
    CAPTURE(place);
    CHECK(blank_columns_before_the_number(direction_sign("E7", {{place, 218}})) >= 6);
  }
}

}  // namespace septet::scenery
