#include "sim-server/command/check_command.hpp"
#include "tests/checkout.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace septet::server {
namespace {
namespace fs = std::filesystem;

const fs::path tree = source_folder();

struct Answer {
  int status;
  std::string text;
};
Answer check(std::vector<std::string> files, bool json = false, bool strict = false) {
  std::ostringstream out;
  const int status = run_check({std::move(files), json, strict}, out);
  return {status, out.str()};
}

/// A file that is gone again after the test.
struct Written {
  fs::path path;
  Written(const std::string& name, const std::string& text)
      : path(fs::temp_directory_path() / (std::to_string(getpid()) + "-" + name)) {
    std::ofstream(path) << text;
  }
  ~Written() { fs::remove(path); }
};

}  // namespace

TEST_CASE("every shipped file that check knows passes it as what it is") {
  const std::pair<const char*, const char*> shipped[] = {
      {"vehicles/volvo-s80.toml", "vehicle"},
      {"rigs/desktop.toml", "rig"},
      {"scenarios/motorway-ambulance/motorway-ambulance.xosc", "scenario"},
      {"scenarios/motorway-ambulance/motorway.xodr", "road"}};
  for (const auto& row : shipped) {
    const char* const file = row.first;
    const char* const kind = row.second;
    CAPTURE(file);
    const Answer answer = check({(tree / file).string()}, true);
    CHECK(answer.status == 0);
    const auto json = nlohmann::json::parse(answer.text);
    CHECK(json["files"][0]["kind"] == kind);
    CHECK(json["files"][0]["findings"].empty());
  }
}

TEST_CASE("a film script is checked as one") {
  const Written good("good.toml", "[[shot]]\nfrom_s = 1\nto_s = 5\n"),
      bad("bad.toml", "[[shot]]\nfrom_s = 1\nto_s = 1\n");
  CHECK(check({good.path.string()}).text == "1 files, 0 errors, 0 warnings\n");
  const Answer answer = check({bad.path.string()}, true);
  CHECK(answer.status == 1);
  const auto json = nlohmann::json::parse(answer.text);
  CHECK(json["files"][0]["kind"] == "film script");
  CHECK(json["files"][0]["findings"][0]["line"] == 3);
}

TEST_CASE("check answers in JSON what it says in lines") {
  const std::string scenario =
      "<OpenSCENARIO>\n<FileHeader revMajor='1' revMinor='1'/>\n<RoadNetwork>\n<LogicFile "
      "filepath='none\xFF.xodr'/></RoadNetwork>"
      "<Entities/><Storyboard><Init><Actions/></Init></Storyboard></OpenSCENARIO>";
  const Written file("s.xosc", scenario), odd("letter.txt", "Dear reader");
  const Answer answer = check({file.path.string(), odd.path.string()}, true);
  CHECK(answer.status == 1);
  const auto json = nlohmann::json::parse(answer.text);
  CHECK(json["format"] == "septet check");
  CHECK(json["version"] == 1);
  CHECK(json["errors"] == 2);
  CHECK(json["warnings"] == 1);
  CHECK(json["files"].size() == 2);
  const auto& first = json["files"][0];
  CHECK(first["kind"] == "scenario");
  CHECK(first["errors"] == 1);
  const auto& missing = first["findings"].back();
  CHECK(missing["severity"] == "error");
  CHECK(missing["line"] == 4);
  CHECK(missing["where"] == file.path.string() + ":4, <LogicFile>");
  CHECK(json["files"][1]["kind"] == "unknown");
  CHECK(json["files"][1]["findings"][0]["line"].is_null());
  const Answer lines = check({file.path.string(), odd.path.string()});
  CHECK(lines.text.find("2 files, 2 errors, 1 warnings") != std::string::npos);
}

TEST_CASE("warnings count in the exit status only where that is asked for") {
  const Written file("w.xosc",
                     "<OpenSCENARIO><FileHeader revMajor='1' revMinor='1'/><RoadNetwork/><Entities/>"
                     "<Storyboard><Init><Actions/></Init></Storyboard></OpenSCENARIO>");
  CHECK(check({file.path.string()}).status == 0);
  CHECK(check({file.path.string()}, false, true).status == 1);
}

TEST_CASE("what is no session is not taken for one") {
  const Written file("x.sqlite", "Dear reader");
  const Answer answer = check({file.path.string()});
  CHECK(answer.status == 1);
  CHECK(answer.text.find("not an SQLite file") != std::string::npos);
}

}  // namespace septet::server
