#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "command-line/command/chosen_command.hpp"
#include "command-line/command/list_command.hpp"
#include "command-line/command/own_files.hpp"
#include "engine/core/regular_file.hpp"
#include "program/resources.hpp"
#include "program/temporary_folder.hpp"

namespace septet::server {
namespace {

namespace fs = std::filesystem;

/// A school's folder: a rig, a scenario of a folder with its lesson, one that lies alone, an experiment, and other
/// files.
struct SchoolFolder {
  program::TemporaryFolder folder = program::TemporaryFolder::make("septet-own").value();
  fs::path data = program::data_folder().value();

  SchoolFolder() {
    fs::create_directories(path() / "scenarios/town");
    fs::create_directories(path() / "alone");
    fs::copy_file(data / "rigs/desktop.toml", path() / "lab.toml");
    fs::copy_file(data / "scenarios/first-lesson/first-lesson.xosc", path() / "scenarios/town/town.xosc");
    fs::copy_file(data / "scenarios/first-lesson/first-lesson.lesson.toml", path() / "scenarios/town/town.lesson.toml");
    fs::copy_file(data / "scenarios/motorway-ambulance/motorway-ambulance.xosc", path() / "alone/whatever.xosc");
    fs::copy_file(data / "scenarios/experiments/ambulance-24.toml", path() / "study.toml");
    write("notes.toml", "text = \"nothing of Septet's\"\n");
    write("broken.toml", "[[screen\n");
    write("half.xosc", "<OpenSCENARIO>");
  }
  const fs::path& path() const { return folder.path(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path() / name) << text; }
};

const ListEntry* find_own(const std::vector<ListEntry>& list, const fs::path& file) {
  const auto found = std::ranges::find(list, file.string(), &ListEntry::name);
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("a list says a title once, whether its description begins with it or not") {
  CHECK(title_and_description({.description = "Title: and more", .title = "Title"}) == "Title: and more");
  CHECK(title_and_description({.description = "Titles: and more", .title = "Title"}) == "Title: Titles: and more");
  CHECK(title_and_description({.description = "Title", .title = "Title"}) == "Title");
  CHECK(title_and_description({.description = "", .title = "Title"}) == "Title");
  CHECK(title_and_description({.description = "A rig", .title = ""}) == "A rig");
  const auto lessons = list_of("lessons").value();
  for (const auto& lesson : lessons) {
    const std::string line = title_and_description(lesson);
    CAPTURE(line);
    CHECK(line.find(lesson.title) == line.rfind(lesson.title));
  }
}

TEST_CASE("rigs, scenarios, lessons and experiments of one's own are listed by the file that the command line takes") {
  const SchoolFolder school;
  const auto rigs = list_of("rigs", {school.path()}).value();
  REQUIRE(find_own(rigs, school.path() / "lab.toml") != nullptr);
  CHECK(find_own(rigs, school.path() / "lab.toml")->is_own);
  CHECK(rigs.size() == list_of("rigs").value().size() + 1);  // Without the notes, the experiment and the broken file.
  const auto lessons = list_of("lessons", {school.path()}).value();
  const auto* town = find_own(lessons, school.path() / "scenarios/town/town.xosc");
  REQUIRE(town != nullptr);
  CHECK(town->title == "A first lesson");
  const auto scenarios = list_of("scenarios", {school.path()}).value();
  const auto* alone = find_own(scenarios, school.path() / "alone/whatever.xosc");
  REQUIRE(alone != nullptr);
  CHECK(alone->is_game);
  CHECK_FALSE(alone->is_lesson);
  const auto* half = find_own(scenarios, school.path() / "half.xosc");
  REQUIRE(half != nullptr);  // It is listed, with its fault.
  CHECK(half->description.starts_with("cannot be read: "));
  const auto experiments = list_of("experiments", {school.path()}).value();
  CHECK(find_own(experiments, school.path() / "study.toml") != nullptr);
  for (const std::string kind : {"rigs", "scenarios", "experiments", "vehicles"})
    for (const OwnFile& own : own_files(kind, {school.path()})) CHECK_MESSAGE(fs::is_regular_file(own.name), own.name);
}

TEST_CASE("a folder is looked through once however often it is named, and what is no folder is said") {
  const SchoolFolder school;
  const auto folders = own_folders({school.path(), school.path() / ".", school.path() / "scenarios/.."}).value();
  CHECK(std::ranges::count(folders, school.path()) == 1);
  CHECK(folders.size() <= 2);  // The one that the test stands in is the other.
  const auto none = own_folders({school.path() / "lab.toml"});
  REQUIRE_FALSE(none.has_value());
  CHECK(none.error().where.find("lab.toml") != std::string::npos);
  CHECK(own_files("rigs", {school.path() / "no-such-folder"}).empty());
  fs::create_directory_symlink(school.path(), school.path() / "scenarios/loop");
  CHECK(own_files("scenarios", {school.path(), school.path() / "scenarios/loop"}).size() == 3);
}

TEST_CASE(
    "the rig that stands here drives where the page chooses no other, and an experiment's next drive is a command") {
  OperateOptions options{.port = 8080};
  options.rig = "lab/lab.toml";
  CHECK(typed(command_of({.scenario = "lab/town.xosc"}, options, "/d/one")) ==
        "septet drive --scenario=lab/town.xosc --rig=lab/lab.toml --out=/d/one --page=8080");
  CHECK(typed(command_of({.scenario = "s", .rig = "desktop"}, options, "/d/one")) ==
        "septet drive --scenario=s --rig=desktop --out=/d/one --page=8080");
  const std::vector<std::string> next{"--scenario", "s",      "--rig", "desktop",         "--log", "samples", "--group",
                                      "a = b",      "--part", "game",  "--parameter=x=1", "--out", "/d/P01"};
  CHECK(typed(command_of_experiment(next, {}, options)) ==
        "septet drive --scenario=s --rig=lab/lab.toml --log=samples '--group=a = b' --part=game --parameter=x=1 "
        "--out=/d/P01 --page=8080");
  options.keys = "keys/server";
  CHECK(typed(command_of_experiment(next, {.rig = "other"}, options)) ==
        "septet-server --keys=keys/server --scenario=s --rig=other --log-samples-only '--about=group=a = b' "
        "--about=part=game --parameter=x=1 --out=/d/P01 --page=8080");
}

}  // namespace septet::server
