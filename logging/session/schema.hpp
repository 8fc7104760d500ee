#pragma once
/// The tables of FORMAT.md as SQL, in one place for writer and reader.

#include <array>
#include <cstdint>
#include <string_view>

namespace septet::logging {

inline constexpr std::int32_t application_id = 0x53535444;
inline constexpr std::int32_t format_version = 3;
inline constexpr std::int32_t oldest_format_version = 1;  ///< FORMAT.md says what earlier ones differ in.

/// A row of `snapshots` is near 1 KB: with SQLite's usual pages of 4 KB a fifth of each would stay empty.
inline constexpr std::uint32_t page_bytes = 16384;

struct Table {
  std::string_view name;
  std::string_view sql;  ///< Stored verbatim by SQLite, and compared with the file's.
};

inline constexpr std::array tables{
    Table{"meta", "CREATE TABLE meta(key TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID"},
    Table{"files", "CREATE TABLE files(role TEXT NOT NULL, name TEXT NOT NULL, content BLOB NOT NULL)"},
    Table{"snapshots",
          "CREATE TABLE snapshots(tick INTEGER PRIMARY KEY, simulated_time_s REAL NOT NULL, "
          "baseline_tick INTEGER, "
          "state_hash INTEGER NOT NULL, data BLOB NOT NULL)"},
    Table{"driver_inputs",
          "CREATE TABLE driver_inputs(tick INTEGER PRIMARY KEY, report BLOB, steering_wheel_rad "
          "REAL, accelerator REAL, "
          "brake REAL, clutch REAL, selector INTEGER, gear INTEGER, indicator INTEGER, "
          "hazard_lights INTEGER, "
          "horn INTEGER, low_beam INTEGER, high_beam INTEGER, parking_brake INTEGER, "
          "gaze_heading_rad REAL, "
          "sequence INTEGER)"},
    Table{"scene_edits",
          "CREATE TABLE scene_edits(id INTEGER PRIMARY KEY, tick INTEGER NOT NULL, data BLOB NOT "
          "NULL)"},
    Table{"samples",
          "CREATE TABLE samples(tick INTEGER PRIMARY KEY, simulated_time_s REAL NOT NULL, x_m "
          "REAL, y_m REAL, z_m REAL, "
          "heading_rad REAL, speed_mps REAL, longitudinal_acceleration_mps2 REAL, "
          "lateral_acceleration_mps2 REAL, "
          "yaw_rate_radps REAL, road INTEGER, lane INTEGER, road_s_m REAL, lateral_position_m "
          "REAL, lane_width_m REAL, "
          "leader INTEGER, distance_gap_m REAL, distance_headway_m REAL, leader_speed_mps REAL, "
          "steering_wheel_rad REAL, accelerator REAL, brake REAL, clutch REAL, gear INTEGER, lamps "
          "INTEGER, "
          "gaze_heading_rad REAL)"},
    Table{"events",
          "CREATE TABLE events(id INTEGER PRIMARY KEY, tick INTEGER NOT NULL, simulated_time_s "
          "REAL NOT NULL, "
          "kind TEXT NOT NULL, participant INTEGER, detail TEXT NOT NULL)"},
    Table{"questionnaire",
          "CREATE TABLE questionnaire(id INTEGER PRIMARY KEY, item TEXT NOT NULL, question TEXT "
          "NOT NULL, answer TEXT, "
          "value REAL, observed_s REAL NOT NULL, censored INTEGER NOT NULL, reason TEXT NOT NULL)"},
};

/// Absent from sessions of earlier builds.
inline constexpr Table saved_states{"saved_states",
                                    "CREATE TABLE saved_states(tick INTEGER PRIMARY KEY, data BLOB NOT NULL)"};
/// Absent from sessions of earlier builds.
inline constexpr Table actuators{"actuators",
                                 "CREATE TABLE actuators(tick INTEGER PRIMARY KEY, fan REAL, vibration REAL, "
                                 "vibration_hz REAL, steering REAL, is_cut INTEGER)"};

/// Ticks at which the head was not at rest; absent from sessions of earlier builds.
inline constexpr Table head_positions{
    "head_positions",
    "CREATE TABLE head_positions(tick INTEGER PRIMARY KEY, forward_m REAL NOT NULL, left_m REAL NOT NULL, "
    "up_m REAL NOT NULL, turn_rad REAL NOT NULL)"};

/// Of rows of `scene_edits`, by their ids, but for the world at the drive's beginning; absent from sessions of earlier builds.
inline constexpr Table edit_fingerprints{"edit_fingerprints",
                                         "CREATE TABLE edit_fingerprints(id INTEGER PRIMARY KEY, nodes BLOB NOT NULL)"};

/// Tables that sessions of earlier builds lack.
inline constexpr std::array later_tables{saved_states, actuators, head_positions, edit_fingerprints};

/// Finds the keyframe before a time without reading the table.
inline constexpr std::string_view keyframe_index =
    "CREATE INDEX keyframes ON snapshots(simulated_time_s) WHERE baseline_tick IS NULL";

}  // namespace septet::logging
