#include "engine/document/try_folder.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::document {
namespace fs = std::filesystem;

TEST_CASE("a folder is tried before long work, and nothing is left of the trial, nor lost of what lies there") {
  const TemporaryFolder folder;
  CHECK(try_folder(folder / "a/b").has_value());
  CHECK_FALSE(fs::exists(folder / "a"));
  fs::create_directory(folder / "there");
  std::ofstream(folder / "there/x") << "text";
  CHECK(try_folder(folder / "there").has_value());
  CHECK(fs::file_size(folder / "there/x") == 4);
  CHECK(std::distance(fs::directory_iterator(folder / "there"), fs::directory_iterator()) == 1);
  for (const char* wrong : {"there/x", "there/x/y"}) {
    CAPTURE(wrong);
    const auto refused = try_folder(folder / wrong);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().where == (folder / wrong).string());
  }
}

}  // namespace septet::document
