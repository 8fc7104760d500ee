#include "engine/document/text_file.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/document/figure_text.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::document {

TEST_CASE("a text replaces a file whole and leaves nothing beside it and a folder is made where it is not there") {
  const TemporaryFolder folder;
  const auto inner = folder / "a/b";
  REQUIRE(write_text_files(inner, {{"one", "1\n"}, {"two", ""}}));
  REQUIRE(write_text_file(inner / "one", "another"));
  std::ostringstream text;
  text << std::ifstream(inner / "one").rdbuf();
  CHECK(text.str() == "another");
  CHECK(std::distance(std::filesystem::directory_iterator(inner), std::filesystem::directory_iterator()) == 2);
}

TEST_CASE("a folder that is not there or is a file is an error that names the file and nothing is left") {
  const TemporaryFolder folder;
  const auto missing = write_text_file(folder / "no such folder/x", "text");
  REQUIRE_FALSE(missing);
  CHECK(missing.error().where.find("no such folder/x") != std::string::npos);
  REQUIRE(write_text_files(folder / "file", {{"x", "text"}}));
  const auto below_file = write_text_files(folder / "file/x", {{"y", "text"}});
  CHECK_FALSE(below_file.has_value());
  CHECK_FALSE(std::filesystem::exists(folder / "file/x.part"));
}

TEST_CASE("figures are JSON whatever their names are and a number that is none is null") {
  const Figure figures[] = {{"a\"b", 0.1, "m/s²"}, {"none", std::nan(""), ""}};
  const auto json = nlohmann::json::parse(figures_json({{"vehicle", "x\"y\\\n"}}, figures));
  CHECK(json["vehicle"] == "x\"y\\\n");
  CHECK(json["figures"][0]["name"] == "a\"b");
  CHECK(json["figures"][0]["value"] == 0.1);
  CHECK(json["figures"][1]["value"].is_null());
}

}  // namespace septet::document
