#pragma once
/// Many subjects as a page, a table and JSON: distributions, differences between groups, for how long they played, and figure 5 of
/// Lebram, Engström and Gustavsson 2006 in its form.

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/report/pool.hpp"

namespace septet::logging {

struct GroupReport {
  std::string title = "A group of drives";
  std::string note;  ///< What whoever reads the figures has to know.
  std::vector<PooledSubject> subjects;
  MeasureSettings settings;
  std::map<std::filesystem::path, std::string> drive_pages;  ///< By session: the address of its page, from this one.
};

/// A page that needs nothing beside it; it links to `drive_pages`.
std::string to_html(const GroupReport& report);
/// One row a subject; columns are "LABEL.MEASURE_UNIT" and "LABEL.answer.ITEM", the experimenter's own "column.NAME"; "answer.ITEM" without a label has a
/// value where a subject's drives do not differ in it. A value that
/// is undefined is an empty cell.
std::string to_csv(const GroupReport& report);
/// The same with unit, definition, samples and missing samples of every measure, and the pooled histogram.
std::string to_json(const GroupReport& report);

/// report.html, subjects.csv and subjects.json in this folder, and drives/NUMBER.html of those that have no report beside them.
Expected<void> write_group_report(GroupReport report, const std::filesystem::path& folder);

}  // namespace septet::logging
