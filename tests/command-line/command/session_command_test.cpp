// Removals from sessions, and obstacles to them.

#include "command-line/command/session_command.hpp"

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

#include "logging/session/session_reader.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {
namespace fs = std::filesystem;

fs::path write_session(const fs::path& folder, const std::string& participant) {
  fs::create_directories(folder);
  auto info = logging::example_info();
  info.participant = participant;
  auto writer = logging::SessionWriter::create(folder / "session.sqlite", info);
  REQUIRE(writer.has_value());
  REQUIRE(writer->finish().has_value());
  return folder / "session.sqlite";
}

std::string participant_of(const fs::path& session) {
  const auto reader = logging::SessionReader::open(session);
  return reader ? reader->info().participant : "cannot be read";
}

}  // namespace

TEST_CASE(
    "a damaged session, a pipe or a folder in its place keeps nobody else from being forgotten and is exit status 1") {
  enum class Damage : std::uint8_t { truncated, pipe, folder, empty, foreign };
  for (const Damage damage : {Damage::truncated, Damage::pipe, Damage::folder, Damage::empty, Damage::foreign})
    for (const bool delete_data : {false, true}) {
      CAPTURE(static_cast<int>(damage));
      CAPTURE(delete_data);
      const TemporaryFolder folder;
      const auto theirs = write_session(folder / "data/a", "P07"), other = write_session(folder / "data/c", "P08");
      const fs::path bad = folder / "data/b/session.sqlite";
      fs::create_directories(bad.parent_path());
      if (damage == Damage::truncated) {
        write_session(bad.parent_path(), "P09");
        fs::resize_file(bad, 5000);
      }
      if (damage == Damage::pipe) REQUIRE(::mkfifo(bad.c_str(), 0600) == 0);
      if (damage == Damage::folder) fs::create_directories(bad);
      if (damage == Damage::empty) std::ofstream(bad).flush();
      if (damage == Damage::foreign) std::ofstream(bad) << "Dear reader, this is no session at all, and never was one";
      const auto done = run_session_forget({"P07", {folder / "data"}, delete_data});
      REQUIRE_MESSAGE(done.has_value(), why_not(done));
      CHECK(*done == 1);
      if (delete_data)
        CHECK_FALSE(fs::exists(theirs));
      else
        CHECK(participant_of(theirs) == "");
      CHECK(participant_of(other) == "P08");
      CHECK(fs::exists(bad));
    }
}

TEST_CASE("a link to a session is no session of its own: the driver is forgotten where the data are") {
  for (const bool delete_data : {false, true}) {
    CAPTURE(delete_data);
    const TemporaryFolder folder;
    const auto held = write_session(folder / "disk/a", "P07");
    fs::create_directories(folder / "data/a");
    fs::create_symlink(held, folder / "data/a/session.sqlite");
    CHECK(run_session_forget({"P07", {folder / "data", folder / "disk"}, delete_data}) == 0);
    if (delete_data)
      CHECK_FALSE(fs::exists(held));
    else
      CHECK(participant_of(held) == "");
  }
}

TEST_CASE("links to deleted drives go with them: to a session, to its folder and to a place") {
  const TemporaryFolder folder;
  write_session(folder / "disk/a", "P07");
  write_session(folder / "disk/b", "P07");
  const auto other = write_session(folder / "disk/c", "P08");
  std::ofstream(folder / "disk/b/notes.txt") << "of the experimenter";
  fs::create_directories(folder / "data/a");
  fs::create_symlink("../../disk/a/session.sqlite", folder / "data/a/session.sqlite");
  std::ofstream(folder / "data/a/summary.json") << "{\"participant\": \"P07\"}";
  for (const char* name : {"a", "b", "c"})
    fs::create_directory_symlink(folder / "disk" / name, folder / "data" / (std::string("drive-") + name));
  CHECK(run_session_forget({"P07", {folder / "data", folder / "disk"}, true}) == 0);
  CHECK_FALSE(fs::exists(folder / "disk/a"));
  for (const char* gone : {"data/a", "data/drive-a"})
    CHECK_MESSAGE(fs::symlink_status(folder / gone).type() == fs::file_type::not_found, gone);
  // What is not of the drive stays, and so does the link to it.
  CHECK(fs::exists(folder / "data/drive-b/notes.txt"));
  CHECK_FALSE(fs::exists(folder / "disk/b/session.sqlite"));
  CHECK(participant_of(other) == "P08");
  CHECK(fs::is_symlink(folder / "data/drive-c"));

  write_session(folder / "disk/d", "P07");
  fs::create_directory_symlink(folder / "disk/d", folder / "place");
  CHECK(run_session_forget({"P07", {folder / "place/"}, true}) == 0);
  CHECK_FALSE(fs::exists(folder / "disk/d"));
  CHECK_FALSE(fs::is_symlink(folder / "place"));
}

TEST_CASE("a session behind a link is not touched unless its own place is given, and exit status 1 says so") {
  for (const bool delete_data : {false, true})
    for (const bool is_folder : {false, true}) {
      CAPTURE(delete_data);
      CAPTURE(is_folder);
      const TemporaryFolder folder;
      const auto held = write_session(folder / "disk/a", "P07"), own = write_session(folder / "data/own", "P07");
      if (is_folder) {
        fs::create_directory_symlink(folder / "disk/a", folder / "data/a");
      } else {
        fs::create_directories(folder / "data/a");
        fs::create_symlink(held, folder / "data/a/session.sqlite");
      }
      CHECK(run_session_forget({"P07", {folder / "data"}, delete_data}) == 1);
      CHECK(participant_of(held) == "P07");
      CHECK(fs::exists(folder / "data/a/session.sqlite"));
      CHECK((delete_data ? !fs::exists(own) : participant_of(own).empty()));
      CHECK(run_session_forget({"P07", {folder / "data"}, delete_data}) == 1);  // Nothing but that is left.
    }
}

TEST_CASE("pictures to which a deleted drive had only a link stay, and exit status 1 says so") {
  const TemporaryFolder folder;
  write_session(folder / "data/a", "P07");
  fs::create_directories(folder / "pictures");
  std::ofstream(folder / "pictures/1.png") << "a picture";
  fs::create_directory_symlink(folder / "pictures", folder / "data/a/screens");
  CHECK(run_session_forget({"P07", {folder / "data"}, true}) == 1);
  CHECK(fs::symlink_status(folder / "data/a").type() == fs::file_type::not_found);
  CHECK(fs::exists(folder / "pictures/1.png"));
}

TEST_CASE("a drive that is still going on is neither deleted nor changed and the driver's other drives are") {
  for (const bool delete_data : {false, true}) {
    CAPTURE(delete_data);
    const TemporaryFolder folder;
    const auto over = write_session(folder / "data/a", "P07");
    auto info = logging::example_info();
    info.participant = "P07";
    fs::create_directories(folder / "data/b");
    const fs::path going_on = folder / "data/b/session.sqlite";
    auto writer = logging::SessionWriter::create(going_on, info);
    REQUIRE(writer.has_value());
    CHECK(run_session_forget({"P07", {folder / "data"}, delete_data}) == 1);
    CHECK(participant_of(going_on) == "P07");
    CHECK((delete_data ? !fs::exists(over) : participant_of(over).empty()));
    CHECK(writer->finish().has_value());
    CHECK(run_session_forget({"P07", {folder / "data"}, delete_data}) == 0);
  }
}

TEST_CASE("who is in none of the sessions that can be read is not forgotten and that some cannot is said") {
  const TemporaryFolder folder;
  write_session(folder / "a", "P08");
  std::ofstream(folder / "session.sqlite") << "no session";
  const auto done = run_session_forget({"P07", {folder.path()}, false});
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().what.find("none of 1 sessions that can be read is of P07") != std::string::npos);
}

TEST_CASE("one of their own sessions that cannot be changed does not keep the others") {
  const TemporaryFolder folder;
  const auto first = write_session(folder / "1", "P07"), held = write_session(folder / "2", "P07"),
             last = write_session(folder / "3", "P07");
  fs::create_directories(held.string() + ".part");  // Where its copy is to be written.
  std::ofstream(fs::path(held.string() + ".part") / "x") << "x";
  const auto done = run_session_forget({"P07", {folder.path()}, false});
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  CHECK(*done == 1);
  CHECK(participant_of(first) == "");
  CHECK(participant_of(held) == "P07");
  CHECK(participant_of(last) == "");
  fs::remove_all(held.string() + ".part");
  CHECK(run_session_forget({"P07", {folder.path()}, false}) == 0);
  CHECK(participant_of(held) == "");
}

}  // namespace septet::server
