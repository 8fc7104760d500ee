#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/gltf/accessors.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

/// One accessor over `bytes`, whose JSON ends with `more`; rows lie `stride` bytes apart, or packed at 0.
Container over(const std::string& bytes, const std::string& more, int stride = 0) {
  const std::string apart = stride > 0 ? fmt::format(R"(,"byteStride":{})", stride) : "";
  auto container = open_container(fmt::format(R"({{"asset":{{"version":"2.0"}},"accessors":[{{"bufferView":0,{}}}],)"
                                              R"("bufferViews":[{{"buffer":0,"byteLength":{}{}}}],)"
                                              R"("buffers":[{{"byteLength":{},"uri":"data:;base64,{}"}}]}})",
                                              more, bytes.size(), apart, bytes.size(), base64(bytes)),
                                  "own.glb");
  REQUIRE_MESSAGE(container.has_value(), why_not(container));
  return std::move(*container);
}

std::vector<float> numbers(const std::string& bytes, const std::string& more, int stride = 0) {
  const auto rows = read_rows(over(bytes, more, stride), 0, 1, 16, 100);
  REQUIRE_MESSAGE(rows.has_value(), why_not(rows));
  return rows->numbers;
}

/// Its least and greatest number as they are, then as shares of 1 (glTF 2.0, 3.6.2.2).
template <class T>
void check_integers(int component, float least_share) {
  constexpr T least = std::numeric_limits<T>::min(), most = std::numeric_limits<T>::max();
  const std::string bytes = bytes_of<T>({least, most});
  const std::string type = fmt::format(R"("componentType":{},"count":2,"type":"SCALAR")", component);
  CHECK(numbers(bytes, type) == std::vector<float>{static_cast<float>(least), static_cast<float>(most)});
  CHECK(numbers(bytes, type + R"(,"normalized":true)") == std::vector<float>{least_share, 1.0f});
  CHECK(numbers(bytes, type + R"(,"normalized":"true")")[1] == static_cast<float>(most));
}

}  // namespace

TEST_CASE("every integer type of an accessor is read, as it is and normalised") {
  check_integers<std::int8_t>(5120, -1.0f);
  check_integers<std::uint8_t>(5121, 0.0f);
  check_integers<std::int16_t>(5122, -1.0f);
  check_integers<std::uint16_t>(5123, 0.0f);
  CHECK(numbers(bytes_of<std::uint32_t>({7, 70'000}), R"("componentType":5125,"count":2,"type":"SCALAR")") ==
        std::vector<float>{7.0f, 70'000.0f});
}

TEST_CASE("rows that lie apart are read from their offset on, and the last needs no pad behind it") {
  const std::string bytes = bytes_of<std::int16_t>({9, 1, 2, 9, 9, 3, 4});
  const std::string type = R"("byteOffset":2,"componentType":5122,"type":"VEC2","count":)";
  CHECK(numbers(bytes, type + "2", 8) == std::vector<float>{1, 2, 3, 4});
  CHECK_FALSE(read_rows(over(bytes, type + "3", 8), 0, 2, 2, 100).has_value());
  CHECK_FALSE(read_rows(over(bytes, type + "2", 2), 0, 2, 2, 100).has_value());
}

TEST_CASE("indices are of one, two or four bytes, and of no other kind") {
  const auto indices = [](const std::string& bytes, int component) {
    return read_indices(over(bytes, fmt::format(R"("componentType":{},"count":2,"type":"SCALAR")", component)), 0, 9,
                        9);
  };
  const std::vector<std::uint32_t> wanted{8, 3};
  CHECK(indices(bytes_of<std::uint8_t>({8, 3}), 5121).value() == wanted);
  CHECK(indices(bytes_of<std::uint16_t>({8, 3}), 5123).value() == wanted);
  CHECK(indices(bytes_of<std::uint32_t>({8, 3}), 5125).value() == wanted);
  for (const int other : {5120, 5122, 5124, 5126, 0}) {
    const auto read = indices(std::string(8, '\0'), other);
    REQUIRE_FALSE(read.has_value());
    CHECK(read.error().where == "own.glb, accessor 0");
  }
}

}  // namespace septet::gltf
