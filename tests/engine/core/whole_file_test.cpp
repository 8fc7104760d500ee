#include "engine/core/whole_file.hpp"

#include <fstream>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "engine/core/bytes.hpp"
#include "tests/temporary_folder.hpp"

namespace septet {
namespace fs = std::filesystem;
namespace {

std::string content_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("while a file is written what stood there stays, and a failure leaves no part of the new one") {
  const TemporaryFolder folder;
  const fs::path file = folder / "kept";
  REQUIRE(write_whole_file(file, "text", Bytes(3, std::byte{'a'})).has_value());
  const auto failed = write_whole_file(file, [&](const fs::path& part) -> Expected<void> {
    std::ofstream(part) << "half";
    CHECK(content_of(file) == "aaa");
    return failure("the pen broke", file.string(), "take another");
  });
  REQUIRE_FALSE(failed.has_value());
  CHECK(failed.error().what == "the pen broke");
  CHECK(content_of(file) == "aaa");
  CHECK_FALSE(fs::exists(folder / "kept.part"));
  REQUIRE(write_whole_file(file, "text", Bytes(2, std::byte{'b'})).has_value());
  CHECK(content_of(file) == "bb");
}

TEST_CASE("a part that cannot take the file's name is removed and the error names the file") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "taken" / "by a folder");
  const auto failed = write_whole_file(folder / "taken", [](const fs::path& part) -> Expected<void> {
    std::ofstream(part) << "whole";
    return {};
  });
  REQUIRE_FALSE(failed.has_value());
  CHECK(failed.error().where == (folder / "taken").string());
  CHECK_FALSE(fs::exists(folder / "taken.part"));
}

}  // namespace septet
