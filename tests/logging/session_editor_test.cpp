#include "logging/session/session_editor.hpp"

#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "logging/session/session_reader.hpp"
#include "logging/session/session_writer.hpp"
#include "logging/session/subject.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

constexpr const char* code = "P07-secret-code";

void write_session(const std::filesystem::path& path) {
  SessionInfo info = example_info();
  info.participant = code;
  Subject subject;
  for (const char* text :
       {"group=novice", "condition=rain", "order=2", "note=limps-and-laughs", "column.age=secret-age"})
    REQUIRE(add_to_subject(subject, text).has_value());
  info.other.merge(meta_of(subject));
  auto writer = SessionWriter::create(path, info);
  REQUIRE(writer.has_value());
  writer->record(QuestionnaireRecord{"drive_completed", "", std::nullopt, std::nullopt, 12.0, true, "felt-very-sick"});
  writer->record(Event{120, 1.0, "mark", std::nullopt, "by=Ann note=looks-pale note=twice"});
  writer->record(Event{180, 1.5, "word", std::nullopt, "by=Ann text=look-left-Zoe text=Zoe"});
  writer->record(Event{240, 2.0, "operator", std::nullopt, "by=Ann wish=end reason=had-to-lie-down"});
  REQUIRE(writer->finish().has_value());
}

std::string bytes_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("what is told of who drove lies in the session and reads back") {
  const TemporaryFolder folder;
  write_session(folder / "s.sqlite");
  const auto reader = SessionReader::open(folder / "s.sqlite");
  REQUIRE(reader.has_value());
  const Subject subject = subject_of(reader->info());
  CHECK(subject.participant == code);
  CHECK(subject.group == "novice");
  CHECK(subject.order == "2");
  CHECK(subject.columns.at("age") == "secret-age");
  Subject other;
  for (const char* wrong : {"order=x", "order=0", "order=-1", "order=1.5", "order=01", "order=1 ", "colour=red",
                            "column.=3", "column.x", "note=two\nlines", "note=\x1b[2J"})
    CHECK_FALSE_MESSAGE(add_to_subject(other, wrong).has_value(), wrong);
}

TEST_CASE("answers after the drive are added and those of the same questionnaire replaced") {
  const TemporaryFolder folder;
  write_session(folder / "s.sqlite");
  const QuestionnaireRecord first{"paper.fun", "It was fun", "4", 4.0, 12.0, false, ""};
  REQUIRE(add_answers(folder / "s.sqlite", {first}, "paper.").has_value());
  QuestionnaireRecord second = first;
  second.value = 5.0;
  REQUIRE(add_answers(folder / "s.sqlite", {second}, "paper.").has_value());
  const auto answers = SessionReader::open(folder / "s.sqlite")->questionnaire();
  REQUIRE(answers->size() == 2);
  CHECK((*answers)[0].item == "drive_completed");
  CHECK((*answers)[1].value == 5.0);
}

TEST_CASE(
    "of a person who is forgotten no byte of code, note, column, reason or what the operator wrote is left, and the "
    "data are") {
  const TemporaryFolder folder;
  write_session(folder / "s.sqlite");
  const auto draft = write_anonymous_copy(folder / "s.sqlite");
  REQUIRE_MESSAGE(draft.has_value(), draft.error().what);
  CHECK(bytes_of_file(folder / "s.sqlite").find(code) != std::string::npos);  // Untouched until it is renamed.
  const std::string bytes = bytes_of_file(*draft);
  for (const char* gone : {code, "limps", "secret-age", "very-sick", "pale", "twice", "Zoe", "lie-down"})
    CHECK_MESSAGE(bytes.find(gone) == std::string::npos, gone);
  const auto reader = SessionReader::open(*draft);
  REQUIRE(reader.has_value());
  CHECK(subject_of(reader->info()).group == "novice");
  CHECK(subject_of(reader->info()).participant.empty());
  REQUIRE(reader->questionnaire()->size() == 1);
  CHECK(reader->questionnaire()->front().censored);
  const auto events = reader->events();
  REQUIRE(events->size() == 3);
  CHECK((*events)[0].detail == "by=Ann");
  CHECK((*events)[1].detail == "by=Ann");
  CHECK((*events)[2].detail == "by=Ann wish=end");
  CHECK(reader->ended_cleanly());
}

TEST_CASE("a session that is still being written is not changed") {
  const TemporaryFolder folder;
  SessionInfo info = example_info();
  auto writer = SessionWriter::create(folder / "s.sqlite", info);
  REQUIRE(writer.has_value());
  CHECK_FALSE(add_answers(folder / "s.sqlite", {}).has_value());
  CHECK_FALSE(write_anonymous_copy(folder / "s.sqlite").has_value());
}

}  // namespace septet::logging
