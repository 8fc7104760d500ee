#pragma once
/// Many subjects as a page, a table and JSON: distributions, differences between groups, playing times, and figure 5 of
/// Lebram, Engström and Gustavsson 2006 in its form.

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/study/report/pool.hpp"

namespace septet::logging {

struct GroupReport {
  std::string title = "A group of drives";
  std::string note;  ///< Caveats for the reader of the figures.
  std::vector<PooledSubject> subjects;
  MeasureSettings settings;
  std::map<std::filesystem::path, std::string> drive_pages;  ///< By session: the address of its page, from this one.
};

/// A self-contained page; it links to `drive_pages`.
std::string to_html(const GroupReport& report);
/// One row per subject; columns are "LABEL.MEASURE_UNIT" and "LABEL.answer.ITEM", the experimenter's own "column.NAME";
/// "answer.ITEM" without a label has a value if all drives of a subject agree. An undefined value is an empty cell.
std::string to_csv(const GroupReport& report);
/// The same with unit, definition, samples and missing samples of every measure, and the pooled histogram.
std::string to_json(const GroupReport& report);

/// Writes report.html, subjects.csv and subjects.json into this folder, and drives/NUMBER.html for sessions without a
/// report beside them.
Expected<void> write_group_report(GroupReport report, const std::filesystem::path& folder);

}  // namespace septet::logging
