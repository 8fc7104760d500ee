#include "logging/session/edit_fingerprints.hpp"

#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/command_codec.hpp"
#include "logging/session/scene_runs.hpp"
#include "logging/session/session_digest.hpp"
#include "logging/session/sqlite_database.hpp"
#include "tests/logging/scene_edit.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

constexpr scene::NodeId tree = 7, ball = 1048576, sign = 1048577;

/// A world of a tree, and two ticks at which two things are made and moved.
std::vector<SceneEdit> edits_of_a_drive() {
  std::vector<SceneEdit> edits;
  const auto make = [&](Tick tick, scene::NodeId node, const char* name) {
    edits.push_back(edit_of(tick, scene::NodeCreate{node, scene::NodeType::object}));
    edits.push_back(edit_of(tick, scene::NodeNameSet{node, name}));
    edits.push_back(edit_of(tick, scene::TransformSet{node, {{1.0, 2.0, 3.0}}}));
  };
  make(0, tree, "tree/1.0/2.0");
  make(480, ball, "stimuli/ball");
  make(480, sign, "stimuli/sign");
  for (const scene::NodeId node : {tree, ball, sign})
    edits.push_back(edit_of(600, scene::TransformSet{node, {{4.0, 5.0, 6.0}}}));
  return edits;
}

/// Replaces a tick's row by these edits, packed as the writer packs them, and the digest of the whole by theirs: all that the file says
/// of itself agrees, but for the fingerprints.
void repack(const std::filesystem::path& session, Tick tick, const std::vector<SceneEdit>& edits) {
  SceneRunPacker packer;
  SessionDigest digest;
  for (const SceneEdit& edit : edits) {
    digest.add(edit);
    if (edit.tick == tick) packer.add(edit);
  }
  const auto database = Database::open(session, OpenMode::change);
  REQUIRE(database.has_value());
  auto row = database->prepare("UPDATE scene_edits SET data = ? WHERE tick = ?");
  REQUIRE(row.has_value());
  const SceneRun run = packer.take();
  row->bind(1, std::span<const std::byte>(run.data));
  row->bind(2, static_cast<std::int64_t>(tick));
  REQUIRE(row->run().has_value());
  auto meta = database->prepare("UPDATE meta SET value = ? WHERE key = ?");
  REQUIRE(meta.has_value());
  meta->bind(1, to_json(digest));
  meta->bind(2, std::string_view(digest_row));
  REQUIRE(meta->run().has_value());
}

struct Logged {
  const TemporaryFolder folder;
  const std::filesystem::path session = folder / "session.sqlite";
  std::vector<SceneEdit> edits = edits_of_a_drive();

  Logged() {
    SessionDigest digest;
    SessionWriter writer = must_create(session);
    for (const SceneEdit& edit : edits) digest.add(edit), writer.record(edit);
    REQUIRE(writer.finish({{digest_row, to_json(digest)}}));
  }
  /// Why the scene is not the driven one; empty where it is.
  std::string fault() const {
    const auto driven = is_scene_as_driven(must_open(session));
    return driven ? "" : describe(driven.error());
  }
};

}  // namespace

TEST_CASE("an edit of which one byte was altered is found with its tick and node, though row and digest agree") {
  struct Case {
    std::size_t edit;
    const char* names;
  };
  for (const Case& one : {Case{5, "\"stimuli/ball\" from tick 480"}, Case{8, "\"stimuli/sign\" from tick 480"},
                          Case{9, "\"tree/1.0/2.0\" from tick 600"}, Case{11, "\"stimuli/sign\" from tick 600"}}) {
    CAPTURE(one.names);
    Logged logged;
    CHECK(logged.fault().empty());
    Bytes& command = logged.edits[one.edit].command;
    command[command.size() - 3] ^= std::byte{1};  // Of the height.
    REQUIRE(scene::decode(command).has_value());
    repack(logged.session, logged.edits[one.edit].tick, logged.edits);
    const std::string fault = logged.fault();
    CHECK_MESSAGE(fault.find(one.names) != std::string::npos, fault);
    CHECK(fault.find("session.sqlite") != std::string::npos);
  }
}

TEST_CASE("an edit that was given to another node, left out, added or put at another tick is found") {
  const auto fault_of = [](auto alter) {
    Logged logged;
    alter(logged.edits);
    repack(logged.session, 600, logged.edits);
    return logged.fault();
  };
  const auto names = [](const std::string& fault, const char* part) {
    CHECK_MESSAGE(fault.find(part) != std::string::npos, fault);
  };
  CHECK(fault_of([](auto&) {}).empty());
  names(fault_of([](auto& edits) {
          edits[10] = edit_of(600, scene::TransformSet{ball + 9, {{4.0, 5.0, 6.0}}});
        }),
        "\"stimuli/ball\" from tick 600");
  names(fault_of([](auto& edits) { edits.pop_back(); }), "\"stimuli/sign\" from tick 600");
  names(fault_of([](auto& edits) {
          edits.push_back(edit_of(600, scene::HideSet{tree, true}));
        }),
        "\"tree/1.0/2.0\" from tick 600");
  names(fault_of([](auto& edits) {
          edits.push_back(edit_of(600, scene::HideSet{sign + 5, true}));
        }),
        "node #1048582 from tick 600");
  Logged moved;
  const auto database = Database::open(moved.session, OpenMode::change);
  REQUIRE(database->execute("UPDATE scene_edits SET tick = 599 WHERE tick = 600"));
  names(moved.fault(), "\"tree/1.0/2.0\" from tick 599");
}

TEST_CASE("fingerprints that are missing or cut are no proof, and a session of an earlier build has none") {
  const auto fault_after = [](const char* sql) {
    const Logged logged;
    const auto database = Database::open(logged.session, OpenMode::change);
    REQUIRE(database->execute(sql));
    return logged.fault();
  };
  CHECK(fault_after("DELETE FROM edit_fingerprints WHERE id = 3").find("from tick 600") != std::string::npos);
  CHECK(fault_after("UPDATE edit_fingerprints SET nodes = x'01' WHERE id = 2").find("from tick 480") !=
        std::string::npos);
  CHECK(fault_after("DROP TABLE edit_fingerprints").empty());
}

}  // namespace septet::logging
