#include <cstddef>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "logging/session/scene_runs.hpp"
#include "logging/session/schema.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

SceneEdit edit_of(Tick tick, std::size_t bytes, int value = 7) { return {tick, Bytes(bytes, std::byte(value))}; }

SceneRun run_of(const std::vector<SceneEdit>& edits) {
  SceneRunPacker packer;
  for (const SceneEdit& edit : edits) packer.add(edit);
  return packer.take();
}

/// The fault's sentence; empty without one.
std::string fault_of(const SceneRun& run) {
  std::vector<SceneEdit> out;
  const auto done = SceneUnpacker(format_version).unpack(run, out);
  return done ? "" : done.error().what;
}

}  // namespace

TEST_CASE("commands of several ticks and of any size read back in their order") {
  const TemporaryFolder folder;
  std::vector<SceneEdit> edits;
  for (int i = 0; i < 3000; ++i) edits.push_back(edit_of(0, static_cast<std::size_t>(1 + i % 300), i % 251));
  edits.push_back(edit_of(0, std::size_t{1} << 20));
  edits.push_back(edit_of(5, 3));
  edits.push_back(edit_of(5, 4));
  edits.push_back(edit_of(6, 1));
  SessionWriter writer = must_create(folder / "session.sqlite");
  for (const SceneEdit& edit : edits) writer.record(edit);
  REQUIRE(writer.finish());
  const SessionReader reader = must_open(folder / "session.sqlite");
  CHECK(reader.scene_edits().value() == edits);
  CHECK(reader.scene_edits({.first = 5, .last = 5}).value() == std::vector(edits.end() - 3, edits.end() - 1));
}

TEST_CASE("a world's like commands take a small part of their bytes in the file") {
  std::vector<SceneEdit> edits;
  for (int i = 0; i < 1000; ++i) edits.push_back(edit_of(0, 60, i % 7));
  CHECK(run_of(edits).data.size() < 60'000 / 4);
}

TEST_CASE("a run ends with its tick and with the command that makes it large") {
  SceneRunPacker packer;
  CHECK(packer.has_room_for(edit_of(4, 2'000'000)));
  packer.add(edit_of(4, 100'000));
  CHECK(packer.has_room_for(edit_of(4, 1)));
  CHECK_FALSE(packer.has_room_for(edit_of(5, 1)));
  packer.add(edit_of(4, 200'000));
  CHECK_FALSE(packer.has_room_for(edit_of(4, 1)));
  CHECK(packer.take().tick == 4);
  CHECK(packer.is_empty());
  CHECK(packer.has_room_for(edit_of(5, 1)));
}

TEST_CASE("a row of an earlier format is one command as it is") {
  std::vector<SceneEdit> out;
  const SceneEdit edit = edit_of(3, 12);
  CHECK(SceneUnpacker(2).unpack({edit.tick, edit.command}, out));
  CHECK(out == std::vector{edit});
}

TEST_CASE("a damaged row of the scene is one sentence wherever the damage is") {
  const SceneRun whole = run_of({edit_of(0, 90), edit_of(0, 70, 3)});
  REQUIRE(fault_of(whole).empty());
  for (std::size_t size = 0; size < whole.data.size(); ++size) {
    CAPTURE(size);
    CHECK(fault_of({0, Bytes(whole.data.begin(), whole.data.begin() + static_cast<std::ptrdiff_t>(size))}) ==
          "its commands do not unpack");
  }
  SceneRun altered = whole;
  altered.data.back() ^= std::byte{1};  // The checksum of RFC 1950.
  CHECK(fault_of(altered) == "its commands do not unpack");
  SceneRun larger = whole;
  larger.data[0] ^= std::byte{1};
  CHECK(fault_of(larger) == "its commands do not unpack");
}

TEST_CASE("a scene that unpacks to more memory than it may is refused") {
  const SceneRun run = run_of(std::vector(60, edit_of(0, 4096)));  // 246 KB of a few thousand bytes.
  REQUIRE(run.data.size() < 8000);
  SceneUnpacker unpacker(format_version);
  std::string fault;
  for (int row = 0; row < 4000 && fault.empty(); ++row) {
    std::vector<SceneEdit> out;  // Forgotten each time: the unpacker counts what it gave.
    const auto done = unpacker.unpack(run, out);
    if (!done) fault = done.error().what;
  }
  CHECK(fault == "its scene takes more than 512 MiB");
}

}  // namespace septet::logging
