#pragma once
/// summary.json: one drive in the figures that a script or a nightly run compares. Its keys: SUMMARY.md.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/document/json.hpp"
#include "logging/session/outcome.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/session/subject.hpp"
#include "logging/study/report/drive_measures.hpp"

namespace septet::logging {

inline constexpr int summary_version = 1;

struct DriveSummary {
  std::string scenario, rig, vehicle, participant;
  Subject subject;                                ///< Beside the participant.
  std::map<std::string, std::string> parameters;  ///< Scenario parameters given from outside.
  std::uint64_t seed = 0;
  DriveOutcome outcome;
  /// Figures of the log; empty if it cannot be read.
  struct FromLog {
    std::uint64_t missing_ticks = 0;
    DriveMeasures measures;
    std::map<std::string, std::uint64_t> events;  ///< By kind.
    std::vector<QuestionnaireRecord> answers;     ///< Rows of questionnaires, and of a drop-out of the driver.
    std::vector<CrashRecord> crashes;             ///< By the time of their touch.
  };
  std::optional<FromLog> log;
};

Expected<DriveSummary::FromLog> summarise_log(const SessionReader& reader);

/// The JSON text; numbers that are not finite become null.
std::string to_json(const DriveSummary& summary);

Expected<void> write_summary(const std::filesystem::path& path, const DriveSummary& summary);

/// A summary's `answers`, which may be given after the drive.
document::Json answers_json(const std::vector<QuestionnaireRecord>& answers);

}  // namespace septet::logging
