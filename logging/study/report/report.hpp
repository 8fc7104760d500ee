#pragma once
/// report.html: one drive as a page: its route, time lines with events, measures with their definitions, and pictures.
/// The pictures alone lie beside the page; the rest is self-contained.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/session/outcome.hpp"
#include "logging/session/participants.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/report/drive_measures.hpp"
#include "logging/study/report/drive_pictures.hpp"

namespace septet::logging {

struct ReportData : DriveRecords {
  SessionInfo info;
  ParticipantNames names;
  bool ended_cleanly = true;
  std::optional<DriveOutcome> outcome;  ///< Empty if the file has none.
  std::uint64_t missing_ticks = 0;
  std::vector<QuestionnaireRecord> answers;
  MeasureSettings settings;
  std::vector<DrivePicture> pictures;  ///< Found by the caller, who knows the places of session and page.
};

Expected<ReportData> read_report_data(const SessionReader& reader);

/// The whole page.
std::string to_html(const ReportData& data);

/// Writes a page beside the session. `outcome`: for a file that lacks it, because it could not be closed.
Expected<void> write_report(const SessionReader& reader, const std::filesystem::path& path,
                            const std::optional<DriveOutcome>& outcome = std::nullopt);

}  // namespace septet::logging
