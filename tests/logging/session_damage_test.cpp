#include <csignal>
#include <fstream>

#include <doctest/doctest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/core/random.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// Records until the disk is full; returns how many snapshots were committed. The first one is safe before the rest
/// come: a fast machine fills the disk before it commits.
std::size_t record_until_full(SessionWriter& writer, std::vector<Error>& errors) {
  Tick tick = 0;
  writer.record(taken(drive_snapshot(tick++, 40)));
  while (!writer.committed_tick()) usleep(1000);
  while (errors.empty() && tick < 200000) {
    writer.record(taken(drive_snapshot(tick++, 40)));
    if (auto error = writer.take_error()) errors.push_back(*error);
  }
  for (int more = 0; more < 100; ++more) {
    writer.record(taken(drive_snapshot(tick++, 40)));
    if (auto error = writer.take_error()) errors.push_back(*error);
  }
  return writer.committed_tick() ? *writer.committed_tick() + 1 : 0;
}

void check_file_after_full_disk(const std::filesystem::path& path, std::size_t committed) {
  const SessionReader reader = must_open(path);
  CHECK_FALSE(reader.ended_cleanly());
  CHECK(committed > 0);
  CHECK(all_ticks(reader).size() == committed);
  CHECK(reader.check_integrity().has_value());
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// Reads everything there is; true if all of it was readable. Must not crash on any bytes.
bool read_everything(const std::filesystem::path& path) {
  const auto reader = SessionReader::open(path);
  if (!reader) {
    CHECK_FALSE(reader.error().what.empty());
    CHECK_FALSE(reader.error().remedy.empty());
    return false;
  }
  bool all =
      reader->inputs() && reader->samples() && reader->events() && reader->scene_edits() && reader->questionnaire();
  auto cursor = reader->snapshots();
  if (!cursor) return false;
  for (;;) {
    const auto snapshot = cursor->next();
    if (!snapshot) return false;
    if (!*snapshot) return all;
  }
}

}  // namespace

TEST_CASE("a file at its largest size ends the recording with one message and keeps what it has") {
  const TemporaryFolder folder;
  std::vector<Error> errors;
  std::size_t committed = 0;
  {
    SessionWriter writer =
        must_create(folder / "session.sqlite",
                    {.queue_bytes = 1 << 20, .commit_interval = std::chrono::milliseconds(5), .max_bytes = 400'000});
    committed = record_until_full(writer, errors);
    CHECK(writer.lost_records() >= 100);
    CHECK(writer.finish().has_value());  // The error was taken already.
  }
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].what.find("full") != std::string::npos);
  CHECK(errors[0].where == (folder / "session.sqlite").string());
  check_file_after_full_disk(folder / "session.sqlite", committed);
}

TEST_CASE("a full file system ends the recording with one message and keeps what it has") {
  const TemporaryFolder folder;
  const auto disk = folder / "disk";
  std::filesystem::create_directory(disk);
  if (mount("none", disk.c_str(), "tmpfs", 0, "size=1m") != 0) {
    MESSAGE("skipped: no permission to mount a small file system here");
    return;
  }
  std::vector<Error> errors;
  std::size_t committed = 0;
  {
    SessionWriter writer =
        must_create(disk / "session.sqlite", {.queue_bytes = 1 << 20, .commit_interval = std::chrono::milliseconds(5)});
    committed = record_until_full(writer, errors);
  }
  CHECK(errors.size() == 1);
  if (!errors.empty()) CHECK(errors[0].what.find("full") != std::string::npos);
  check_file_after_full_disk(disk / "session.sqlite", committed);
  CHECK(umount2(disk.c_str(), MNT_DETACH) == 0);
}

TEST_CASE("a file size limit of the system ends the recording and keeps what it has") {
  const TemporaryFolder folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{600'000, 600'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    auto writer = SessionWriter::create(folder / "session.sqlite", example_info(),
                                        {.queue_bytes = 1 << 20, .commit_interval = std::chrono::milliseconds(5)});
    std::vector<Error> errors;
    const std::size_t committed = record_until_full(*writer, errors);
    std::ofstream(folder / "committed") << committed << ' ' << errors.size();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  std::size_t committed = 0, errors = 0;
  std::ifstream(folder / "committed") >> committed >> errors;
  CHECK(errors == 1);
  check_file_after_full_disk(folder / "session.sqlite", committed);
}

TEST_CASE("foreign files are refused with one error") {
  const TemporaryFolder folder;
  write_file(folder / "empty", "");
  write_file(folder / "text", std::string(5000, 'x'));
  for (const char* name : {"empty", "text"}) {
    const auto reader = SessionReader::open(folder / name);
    REQUIRE_FALSE(reader.has_value());
    CHECK(reader.error().remedy == "give a session file that Septet wrote");
  }
  CHECK(SessionReader::open(folder / "empty").error().what.find("empty") != std::string::npos);
  const auto of_folder = SessionReader::open(folder.path());
  REQUIRE_FALSE(of_folder.has_value());
  CHECK(of_folder.error().what == "this is a folder");
  CHECK(of_folder.error().remedy.find("session.sqlite") != std::string::npos);
  CHECK_FALSE(SessionReader::open(folder / "missing").has_value());
  CHECK_FALSE(std::filesystem::exists(folder / "missing"));
}

TEST_CASE("a session of another format version is refused by number") {
  const TemporaryFolder folder;
  { CHECK(must_create(folder / "session.sqlite").finish()); }
  std::string content = read_file(folder / "session.sqlite");
  content[63] = 9;  // user_version, big-endian at byte 60 of the header.
  write_file(folder / "newer.sqlite", content);
  const auto reader = SessionReader::open(folder / "newer.sqlite");
  REQUIRE_FALSE(reader.has_value());
  CHECK(reader.error().what == "the session has format 9, and this Septet reads formats 1 to 3");
}

TEST_CASE("a truncated session is refused or read up to the damage and never crashes") {
  const TemporaryFolder folder;
  {
    SessionWriter writer = must_create(folder / "session.sqlite");
    for (Tick tick = 0; tick < 200; ++tick) writer.record(taken(drive_snapshot(tick)));
    REQUIRE(writer.finish());
  }
  const std::string content = read_file(folder / "session.sqlite");
  for (const double part : {0.1, 0.37, 0.6, 0.9}) {
    write_file(folder / "cut.sqlite",
               content.substr(0, static_cast<std::size_t>(static_cast<double>(content.size()) * part)));
    CHECK_FALSE(read_everything(folder / "cut.sqlite"));
  }
}

TEST_CASE("random damage never crashes the reader and a flipped snapshot is named") {
  const TemporaryFolder folder;
  {
    SessionWriter writer = must_create(folder / "session.sqlite");
    for (Tick tick = 0; tick < 200; ++tick) writer.record(taken(drive_snapshot(tick)));
    for (Tick tick = 0; tick < 20; ++tick) writer.record(take_sample(drive_snapshot(tick), std::nullopt));
    REQUIRE(writer.finish());
  }
  const std::string content = read_file(folder / "session.sqlite");
  REQUIRE(read_everything(folder / "session.sqlite"));
  Random random(1);
  int refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::string damaged = content;
    for (int i = 0; i < 8; ++i) damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
    write_file(folder / "damaged.sqlite", damaged);
    refused += !read_everything(folder / "damaged.sqlite");
  }
  CHECK(refused > 10);
}

}  // namespace septet::logging
