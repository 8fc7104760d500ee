#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include <doctest/doctest.h>

#include "tests/logging/session_fixture.hpp"

namespace septet::logging {

TEST_CASE("a session reads back as it was recorded") {
  const TemporaryFolder folder;
  const auto path = folder / "session.sqlite";
  InputRecord with_report{.tick = 0, .report = Bytes{std::byte{1}, std::byte{0}, std::byte{255}}, .input = {}};
  with_report.input.steering_wheel_rad = 0.1 + 1e-17;
  with_report.input.selector = GearSelector::manual;
  with_report.input.gear = -1;
  with_report.input.indicator = IndicatorStalk::right;
  with_report.input.horn = true;
  with_report.input.low_beam = false;
  with_report.input.gaze_heading_rad = -0.6;
  with_report.input.sequence = 255;
  with_report.input.head = {{0.1 + 1e-17, -0.2, 0.05}, 0.9};
  const InputRecord from_keyboard{.tick = 1, .report = std::nullopt, .input = {}};
  const SceneEdit edit{.tick = 1, .command = Bytes(3, std::byte{9})};
  Sample sample = take_sample(drive_snapshot(0), Leader{4, 21.5, 26.3, 24.0});
  sample.gear = -1;
  sample.lamps.set(Lamp::brake, true);
  const Sample no_leader = take_sample(drive_snapshot(12), std::nullopt);
  const Event event{
      .tick = 3, .simulated_time_s = 0.025, .kind = "collision", .participant = 4, .detail = "speed_mps=3"};
  const Event nobody{
      .tick = 4, .simulated_time_s = 1.0 / 30, .kind = "scenario", .participant = std::nullopt, .detail = ""};
  const QuestionnaireRecord answer{.item = "fun",
                                   .question = "It was fun to drive",
                                   .answer = "agree",
                                   .value = 4.0,
                                   .observed_s = 600.0,
                                   .censored = false,
                                   .reason = ""};
  const QuestionnaireRecord drop_out{.item = "drive_completed",
                                     .question = "",
                                     .answer = std::nullopt,
                                     .value = std::nullopt,
                                     .observed_s = 412.5,
                                     .censored = true,
                                     .reason = "felt sick"};
  const ActuatorRecord shaken{
      .tick = 12, .fan = 0.25, .vibration = 0.5, .vibration_hz = 41.5, .steering = -1.0, .is_cut = true};
  {
    SessionWriter writer = must_create(path);
    for (Tick tick = 0; tick < 300; ++tick) writer.record(taken(drive_snapshot(tick)));
    writer.record(with_report);
    writer.record(from_keyboard);
    writer.record(edit);
    writer.record(sample);
    writer.record(no_leader);
    writer.record(event);
    writer.record(nobody);
    writer.record(answer);
    writer.record(drop_out);
    writer.record(shaken);
    REQUIRE(writer.finish());
    CHECK(writer.committed_tick() == Tick{299});
    CHECK(writer.lost_records() == 0);
  }
  const SessionReader reader = must_open(path);
  CHECK(reader.ended_cleanly());
  CHECK(reader.check_integrity().has_value());
  SessionInfo info = reader.info();
  CHECK(info.other.erase("ended") == 1);
  CHECK(info.other.erase("ended_simulated_time_s") == 1);
  CHECK(info == example_info());
  CHECK(reader.inputs().value() == std::vector{with_report, from_keyboard});
  CHECK(reader.inputs({.first = 1, .last = 1}).value() == std::vector{from_keyboard});
  CHECK(reader.scene_edits().value() == std::vector{edit});
  CHECK(reader.samples().value() == std::vector{sample, no_leader});
  CHECK(reader.events().value() == std::vector{event, nobody});
  CHECK(reader.questionnaire().value() == std::vector{answer, drop_out});
  CHECK(reader.actuators().value() == std::vector{shaken});
  CHECK(reader.actuators({.first = 13, .last = 99}).value().empty());
}

TEST_CASE("every snapshot reads back in the bits that the screens were sent") {
  const TemporaryFolder folder;
  SessionWriter writer = must_create(folder / "session.sqlite");
  for (Tick tick = 5; tick < 400; ++tick) writer.record(taken(drive_snapshot(tick)));
  REQUIRE(writer.finish());
  const SessionReader reader = must_open(folder / "session.sqlite");
  auto cursor = reader.snapshots().value();
  for (Tick tick = 5; tick < 400; ++tick) {
    const auto snapshot = cursor.next_wire().value();
    REQUIRE(snapshot.has_value());
    const WireSnapshot sent = to_wire(drive_snapshot(tick));
    CHECK(snapshot->rest.tick == tick);
    CHECK(snapshot->rest.state_hash == sent.rest.state_hash);
    CHECK(snapshot->rest.driver_car.lateral_position_m == sent.rest.driver_car.lateral_position_m);
    CHECK(snapshot->participants == sent.participants);
  }
  CHECK_FALSE(cursor.next().value().has_value());
}

TEST_CASE("a seek stands on the last snapshot at or before the time") {
  const TemporaryFolder folder;
  SessionWriter writer = must_create(folder / "session.sqlite");
  for (Tick tick = 10; tick < 500; ++tick) writer.record(taken(drive_snapshot(tick)));
  REQUIRE(writer.finish());
  const SessionReader reader = must_open(folder / "session.sqlite");
  const auto tick_at = [&](double time_s) { return reader.snapshots_from(time_s).value().next().value().value().tick; };
  CHECK(tick_at(0.0) == 10);
  CHECK(tick_at(250 / 120.0) == 250);
  CHECK(tick_at(250.5 / 120.0) == 250);
  CHECK(tick_at(130 / 120.0) == 130);  // A keyframe.
  CHECK(tick_at(1e9) == 499);
  CHECK(reader.time_span_s().value().value() == std::pair(10 / 120.0, 499 / 120.0));
}

TEST_CASE("a session without a clean end opens and says so") {
  const TemporaryFolder folder;
  {
    SessionWriter writer = must_create(folder / "session.sqlite");
    writer.record(taken(drive_snapshot(0)));
  }
  const SessionReader reader = must_open(folder / "session.sqlite");
  CHECK_FALSE(reader.ended_cleanly());
  CHECK(all_ticks(reader) == std::vector<Tick>{0});
}

TEST_CASE("a session can be read while it is being written") {
  const TemporaryFolder folder;
  SessionWriter writer = must_create(folder / "session.sqlite", {.commit_interval = std::chrono::milliseconds(1)});
  writer.record(taken(drive_snapshot(0)));
  while (!writer.committed_tick()) usleep(1000);
  const SessionReader reader = must_open(folder / "session.sqlite");
  CHECK(all_ticks(reader) == std::vector<Tick>{0});
  writer.record(taken(drive_snapshot(1)));
  while (writer.committed_tick() != Tick{1}) usleep(1000);
  CHECK(all_ticks(reader) == std::vector<Tick>{0, 1});
}

TEST_CASE("an existing file is never overwritten") {
  const TemporaryFolder folder;
  std::ofstream(folder / "session.sqlite") << "a year of measurements";
  const auto writer = SessionWriter::create(folder / "session.sqlite", example_info());
  REQUIRE_FALSE(writer.has_value());
  CHECK(writer.error().what.find("exists") != std::string::npos);
  CHECK(std::filesystem::file_size(folder / "session.sqlite") == 22);
}

TEST_CASE("a folder that is not there is one clear error") {
  const auto writer = SessionWriter::create("/nonexistent/session.sqlite", example_info());
  REQUIRE_FALSE(writer.has_value());
  CHECK(writer.error().what == "the file cannot be opened");
  CHECK_FALSE(SessionReader::open("/nonexistent/session.sqlite").has_value());
}

TEST_CASE("a full queue makes whoever records wait and says for how long and loses nothing") {
  const TemporaryFolder folder;
  SessionWriter writer = must_create(folder / "session.sqlite", {.queue_bytes = 1});
  CHECK(writer.waited_s() == 0.0);
  for (int i = 0; i < 5000; ++i) writer.record(SceneEdit{.tick = 0, .command = Bytes(100)});
  for (Tick tick = 0; tick < 200; ++tick) writer.record(taken(drive_snapshot(tick, 1)));
  REQUIRE(writer.finish());
  CHECK(writer.waited_s() > 0.0);
  CHECK(writer.lost_records() == 0);
  const SessionReader reader = must_open(folder / "session.sqlite");
  CHECK(reader.scene_edits().value().size() == 5000);
  CHECK(all_ticks(reader).size() == 200);
}

TEST_CASE("a file that is deleted is noticed though nothing more is recorded") {
  const TemporaryFolder folder;
  SessionWriter writer = must_create(folder / "session.sqlite", {.commit_interval = std::chrono::milliseconds(1)});
  writer.record(taken(drive_snapshot(0)));
  while (!writer.committed_tick()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::filesystem::remove(folder / "session.sqlite");
  std::optional<Error> error;
  for (int i = 0; i < 300'000 && !error; ++i, error = writer.take_error())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  REQUIRE(error.has_value());
  CHECK(error->what.find("deleted") != std::string::npos);
  CHECK(writer.finish().has_value());  // It has been reported.
}

TEST_CASE("ticks without a snapshot are counted from tick 0") {
  const TemporaryFolder folder;
  SessionWriter writer = must_create(folder / "session.sqlite");
  for (const Tick tick : {2, 3, 7}) writer.record(taken(drive_snapshot(tick)));
  REQUIRE(writer.finish({{"ended_why", "escape"}}));
  const SessionReader reader = must_open(folder / "session.sqlite");
  CHECK(reader.missing_ticks().value() == 5);
  CHECK(reader.info().other.at("ended_why") == "escape");
}

TEST_CASE("a file that is deleted or replaced while it is written ends the recording at the next commit") {
  for (const bool is_replaced : {false, true}) {
    CAPTURE(is_replaced);
    const TemporaryFolder folder;
    const auto path = folder / "session.sqlite";
    SessionWriter writer = must_create(path, {.commit_interval = std::chrono::milliseconds(1)});
    writer.record(taken(drive_snapshot(0)));
    while (!writer.committed_tick()) usleep(1000);
    std::filesystem::remove(path);
    if (is_replaced) std::ofstream(path) << "another";
    std::optional<Error> error;
    for (Tick tick = 1; tick < 10000 && !error; ++tick) {
      writer.record(taken(drive_snapshot(tick)));
      usleep(1000);
      error = writer.take_error();
    }
    REQUIRE(error.has_value());
    CHECK(error->what.find("deleted") != std::string::npos);
    CHECK(error->where == path.string());
  }
}

}  // namespace septet::logging
