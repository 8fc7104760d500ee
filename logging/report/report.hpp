#pragma once
/// report.html: one drive as a page that needs nothing beside it: charts, measures and how each of
/// them is defined.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/outcome.hpp"
#include "logging/report/drive_measures.hpp"
#include "logging/session_reader.hpp"

namespace septet::logging {

struct ReportData : DriveRecords {
  SessionInfo info;
  bool ended_cleanly = true;
  std::optional<DriveOutcome> outcome;  ///< Nothing where the file does not say.
  std::uint64_t missing_ticks = 0;
  std::vector<QuestionnaireRecord> answers;
  MeasureSettings settings;
};

Expected<ReportData> read_report_data(const SessionReader& reader);

/// The whole page.
std::string to_html(const ReportData& data);

/// `outcome`: where the file does not hold it, because it could not be closed.
Expected<void> write_report(const SessionReader& reader, const std::filesystem::path& path,
                            const std::optional<DriveOutcome>& outcome = std::nullopt);

}  // namespace septet::logging
