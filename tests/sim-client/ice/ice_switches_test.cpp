#include <cstddef>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "sim-client/ice/ice_switches.hpp"

namespace septet::ice_viewer {

TEST_CASE("each part of ice has a key that switches it, says so, and pressed again switches it back") {
  const IceOptions begin;
  std::size_t parts = 0;
  for (std::size_t i = 0; i < key_count; ++i) {
    const Key key = static_cast<Key>(i);
    if (key == Key::comma || key == Key::full_stop) continue;
    CAPTURE(std::string(name_of(key)));
    IceOptions options = begin;
    const bool changed = press(options, key);
    CHECK(changed == (switches(options) != switches(begin)));
    if (!changed) continue;
    ++parts;
    press(options, key);
    CHECK(switches(options) == switches(begin));
    CHECK(options.look.bump == begin.look.bump);
    CHECK(options.look.roughness == begin.look.roughness);
    CHECK(options.look.wetness == begin.look.wetness);
  }
  CHECK(parts == 11);
}

TEST_CASE("cracks are halved and doubled from none to a hundred thousand") {
  IceOptions options;
  while (press(options, Key::full_stop)) REQUIRE(options.cracks <= 100000);
  CHECK(options.cracks == 100000);
  while (press(options, Key::comma)) {
  }
  CHECK(options.cracks == 0);
  CHECK(press(options, Key::full_stop));
  CHECK(options.cracks == 1);
}

}  // namespace septet::ice_viewer
