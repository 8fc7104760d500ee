#include "car-io/driving_keys.hpp"

#include <set>

#include <doctest/doctest.h>

#include "tests/shipped_files.hpp"

namespace septet::car_io {

TEST_CASE("every key does one thing and both keys of a line do the same") {
  std::set<Key> seen;
  std::set<std::string_view> names;
  for (const DrivingKey& key : driving_keys()) {
    CAPTURE(key.does);
    KeyStates expected;
    if (key.held) expected.*key.held = true;
    for (const Key one : key.keys) {
      CHECK(key_states([&](Key asked) { return asked == one; }) == expected);
      names.insert(name_of(one));
    }
    CHECK(seen.insert(key.keys[0]).second);
    if (key.keys[1] != key.keys[0]) CHECK(seen.insert(key.keys[1]).second);
  }
  CHECK(seen.size() == key_count);
  CHECK(names.size() == key_count);
  CHECK(key_states([](Key) { return false; }) == KeyStates{});
}

TEST_CASE("the manual and the text for terminals name every key and what it does") {
  const std::string manual = shipped_text("docs/driving.md"), text = driving_keys_text();
  for (const DrivingKey& key : driving_keys()) {
    const std::string line = "| " + names_of_keys(key) + " | " + key.does + " |";
    CAPTURE(line);
    CHECK(manual.find(line) != std::string::npos);
    CHECK(text.find(key.does) != std::string::npos);
    CHECK(text.find(names_of_keys(key)) != std::string::npos);
  }
  CHECK(manual.find(gamepad_text) != std::string::npos);
  CHECK(text.find(gamepad_text) != std::string::npos);
}

TEST_CASE("who reads the driver's keys leaves a short press of the window's own keys to the window") {
  key_states([](Key asked) {
    for (const DrivingKey& key : driving_keys())
      if (!key.held) CHECK(asked != key.keys[0]);
    return false;
  });
}

}  // namespace septet::car_io
