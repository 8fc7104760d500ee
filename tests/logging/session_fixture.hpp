#pragma once
// Shared by the tests of the session file: a small drive, and a writer for it.

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "logging/session/session_reader.hpp"
#include "logging/session/session_writer.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::logging {

/// A car on a circle and a few others, so that every tick differs.
inline Snapshot drive_snapshot(Tick tick, int participants = 5) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = static_cast<double>(tick) / 120.0;
  snapshot.state_hash = 0x9e3779b97f4a7c15u * (tick + 1);
  for (int i = 0; i < participants; ++i) {
    const double angle = snapshot.simulated_time_s * 0.3 + i;
    Participant participant;
    participant.id = static_cast<ParticipantId>(i + 1);
    participant.world_from_vehicle.position_m = {100 * std::cos(angle), 100 * std::sin(angle), 0.1 * i};
    participant.world_from_vehicle.orientation = orientation_from_angles(angle + 1.57, 0, 0);
    participant.velocity_mps = {-30 * std::sin(angle), 30 * std::cos(angle), 0};
    snapshot.participants.push_back(participant);
  }
  snapshot.driver_car.participant = 1;
  snapshot.driver_car.speed_mps = 30.0;
  snapshot.driver_car.lane = -2;
  snapshot.driver_car.lane_width_m = 3.5;
  snapshot.driver_car.lateral_position_m = 0.3 * std::sin(snapshot.simulated_time_s);
  return snapshot;
}

inline std::shared_ptr<const TakenSnapshot> taken(const Snapshot& snapshot) {
  return std::make_shared<const TakenSnapshot>(snapshot);
}

inline SessionInfo example_info() {
  SessionInfo info;
  info.septet_version = "0.1.0";
  info.started_utc = "2026-11-21T09:30:00Z";
  info.participant = "P07";
  info.ticks_per_second = 120.0;
  info.seeds = {{"driver", 18446744073709551615u}, {"traffic", 7}};
  info.parameters = {{"ego_speed", "20"}};
  info.other = {{"weather", "clear"}};
  info.files = {{"rig", "seven-screens.toml", "[[screen]]\n"}, {"scenario", "motorway.xosc", "<OpenSCENARIO/>"}};
  return info;
}

/// The writer, or the end of the test with the reason.
inline SessionWriter must_create(const std::filesystem::path& path, const WriterOptions& options = {}) {
  auto writer = SessionWriter::create(path, example_info(), options);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  return std::move(*writer);
}

inline SessionReader must_open(const std::filesystem::path& path) {
  auto reader = SessionReader::open(path);
  REQUIRE_MESSAGE(reader.has_value(), why_not(reader));
  return std::move(*reader);
}

/// Ticks of all snapshots of a session, each decoded.
inline std::vector<Tick> all_ticks(const SessionReader& reader) {
  std::vector<Tick> ticks;
  auto cursor = reader.snapshots();
  REQUIRE_MESSAGE(cursor.has_value(), why_not(cursor));
  for (;;) {
    const auto snapshot = cursor->next();
    REQUIRE_MESSAGE(snapshot.has_value(), why_not(snapshot));
    if (!*snapshot) return ticks;
    ticks.push_back((*snapshot)->tick);
  }
}

}  // namespace septet::logging
