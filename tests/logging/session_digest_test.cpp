#include "logging/session/session_digest.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

SessionDigest digest_of(const SessionInfo& info, const std::vector<SceneEdit>& edits) {
  SessionDigest digest;
  digest.add(info);
  for (const SceneEdit& edit : edits) digest.add(edit);
  return digest;
}

const std::vector<SceneEdit> edits{{.tick = 0, .command = Bytes(3, std::byte{9})},
                                   {.tick = 7, .command = Bytes(5, std::byte{1})}};

}  // namespace

TEST_CASE("a digest tells which part of a session is not as it was driven") {
  struct Change {
    std::string part;
    std::function<void(SessionDigest&)> make;
  };
  const SessionDigest driven = digest_of(example_info(), edits);
  CHECK_FALSE(altered_part(driven, to_json(driven), "a.sqlite").value().has_value());
  for (const Change& change :
       std::vector<Change>{{"files, seeds or parameters", [](SessionDigest& digest) { digest.add(example_info()); }},
                           {"scene",
                            [](SessionDigest& digest) {
                              digest.add(SceneEdit{8, {}});
                            }},
                           {"ticks", [](SessionDigest& digest) { digest.add_tick(1, 1.0 / 120, 5); }},
                           {"saved states",
                            [](SessionDigest& digest) {
                              digest.add(StateRecord{1, Bytes(1)});
                            }},
                           {"operator changed",
                            [](SessionDigest& digest) {
                              digest.add(Event{3, 0.025, std::string(operator_command_kind), std::nullopt, "fog"});
                            }},
                           {"samples", [](SessionDigest& digest) { digest.add(Sample{}); }}}) {
    CAPTURE(change.part);
    SessionDigest found = driven;
    change.make(found);
    const auto altered = altered_part(found, to_json(driven), "a.sqlite");
    REQUIRE(altered.has_value());
    REQUIRE(altered->has_value());
    CHECK((*altered)->find(change.part) != std::string::npos);
  }
  SessionDigest other_event = driven;  // What is no operator's command is in no digest.
  other_event.add(Event{3, 0.025, "collision", 4, "speed_mps=3"});
  CHECK_FALSE(altered_part(other_event, to_json(driven), "a.sqlite").value().has_value());
}

TEST_CASE("a digest without one of its parts, or in another form, is refused") {
  const SessionDigest digest = digest_of(example_info(), edits);
  const auto whole = nlohmann::json::parse(to_json(digest));
  std::vector<std::string> rows{"", "nonsense", "[]", "{}", "3"};
  for (const auto& part : whole.items()) {
    auto without = whole, of_number = whole;
    without.erase(part.key());
    of_number[part.key()] = 3;
    rows.insert(rows.end(), {without.dump(), of_number.dump()});
  }
  CHECK(rows.size() == 5 + 2 * 6);
  for (const std::string& row : rows) {
    CAPTURE(row);
    const auto altered = altered_part(digest, row, "a.sqlite");
    REQUIRE_FALSE(altered.has_value());
    CHECK(altered.error().where == "a.sqlite");
  }
}

TEST_CASE("a session's scene is the one that was driven in, or refused, or unknown where it has no digest") {
  const TemporaryFolder folder;
  const auto scene_of = [&](const std::string& name, const std::string& digest) {
    SessionInfo info = example_info();
    if (!digest.empty()) info.other[digest_row] = digest;
    auto writer = SessionWriter::create(folder / name, info);
    REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
    for (const SceneEdit& edit : edits) writer->record(edit);
    REQUIRE(writer->finish().has_value());
    return is_scene_as_driven(must_open(folder / name));
  };
  CHECK(scene_of("same", to_json(digest_of(example_info(), edits))).value() == true);
  CHECK_FALSE(scene_of("none", "").value().has_value());
  CHECK_FALSE(scene_of("other", to_json(digest_of(example_info(), {edits[0]}))).has_value());
  CHECK_FALSE(scene_of("damaged", "{\"scene\": 3}").has_value());
}

}  // namespace septet::logging
