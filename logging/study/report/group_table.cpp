#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/document/csv_cell.hpp"
#include "engine/document/json.hpp"
#include "logging/study/report/group_report.hpp"
#include "logging/study/report/measure_json.hpp"
#include "logging/study/report/measure_list.hpp"

namespace septet::logging {
namespace {

using document::csv_cell;
using document::Json;

std::string number_cell(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

template <class Name>
std::set<std::string> names_of(std::span<const PooledSubject> subjects, Name names) {
  std::set<std::string> all;
  for (const PooledSubject& subject : subjects)
    for (const auto& entry : names(subject)) all.insert(entry.first);
  return all;
}

const PooledDrive* find_drive(const PooledSubject& subject, const std::string& label) {
  const auto found = std::ranges::find(subject.drives, label, &PooledDrive::label);
  return found == subject.drives.end() ? nullptr : &*found;
}

std::string joined(const std::vector<std::uint64_t>& numbers) {
  std::string text;
  for (const auto number : numbers) text += fmt::format("{}{}", text.empty() ? "" : " ", number);
  return text;
}

Json histogram_json(const LateralPositionHistogram& histogram) {
  return {{"counts", histogram.counts},
          {"right_of_lane", histogram.underflow},
          {"left_of_lane", histogram.overflow},
          {"off_every_lane", histogram.off_lane}};
}

}  // namespace

namespace {

/// Prefix of a drive's answers and times; empty with a single label: then they are the person's.
std::string answers_prefix(const std::vector<std::string>& labels, const std::string& label) {
  if (labels.size() < 2) return "";
  return (label.empty() ? "no part" : label) + '.';
}

/// True if any subject has a playing time in a drive with this label.
bool has_playing_time(const GroupReport& report, const std::string& label) {
  return std::ranges::any_of(report.subjects, [&](const PooledSubject& subject) {
    const PooledDrive* drive = find_drive(subject, label);
    return drive && drive->playing_time;
  });
}

std::string time_cells(const std::optional<ObservedTime>& time, const std::string& reason) {
  return fmt::format("{},{},{}", number_cell(time ? std::optional(time->time_s) : std::nullopt),
                     time ? (time->stopped ? "1" : "0") : "", csv_cell(reason));
}

std::string answer_cells(const std::vector<std::string>& items, const std::map<std::string, double>& answers) {
  std::string cells;
  for (const auto& item : items) {
    const auto answer = answers.find(item);
    cells += ',' + (answer == answers.end() ? "" : number_cell(answer->second));
  }
  return cells;
}

Json time_json(const std::optional<ObservedTime>& time, const std::string& reason) {
  return {{"playing_time_s", time ? document::number(time->time_s) : Json(nullptr)},
          {"stopped", time ? Json(time->stopped) : Json(nullptr)},
          {"reason", reason}};
}

}  // namespace

std::string to_csv(const GroupReport& report) {
  const auto labels = labels_of(report.subjects);
  const auto keys = list_measures(DriveMeasures{}, report.settings);
  const auto columns = names_of(report.subjects, [](const PooledSubject& s) { return s.subject.columns; });
  std::set<std::string> all_items;
  for (const auto& label : labels)
    for (const auto& item : items_of(report.subjects, label)) all_items.insert(item);
  const std::vector<std::string> items(all_items.begin(), all_items.end());
  std::string csv = "participant,group,driver,order,playing_time_s,stopped,reason";
  for (const auto& column : columns) csv += ',' + csv_cell("column." + column);
  for (const auto& item : items) csv += ',' + csv_cell("answer." + item);
  for (const auto& label : labels) {
    const std::string prefix = label.empty() ? "" : label + '.';
    if (const auto own = answers_prefix(labels, label); !own.empty()) {
      csv += ',' + csv_cell(own + "order");
      if (has_playing_time(report, label))
        for (const char* name : {"playing_time_s", "stopped", "reason"}) csv += ',' + csv_cell(own + name);
      for (const auto& item : items_of(report.subjects, label))
        csv += ',' + csv_cell(fmt::format("{}answer.{}", own, item));
    }
    for (const char* name : {"drives", "seeds", "ended_cleanly", "samples", "impossible_samples"})
      csv += ',' + csv_cell(prefix + name);
    for (const auto& measure : keys) csv += ',' + csv_cell(prefix + measure.key);
  }
  csv += '\n';
  for (const PooledSubject& subject : report.subjects) {
    csv += fmt::format("{},{},{},{},{}", csv_cell(subject.subject.participant), csv_cell(subject.subject.group),
                       csv_cell(subject.driver), csv_cell(subject.subject.order),
                       time_cells(subject.playing_time, subject.reason));
    for (const auto& column : columns) {
      const auto own = subject.subject.columns.find(column);
      csv += ',' + (own == subject.subject.columns.end() ? "" : csv_cell(own->second));
    }
    csv += answer_cells(items, subject.answers);
    for (const auto& label : labels) {
      const PooledDrive* drive = find_drive(subject, label);
      if (!answers_prefix(labels, label).empty()) {
        const PooledDrive nothing;
        const PooledDrive& own = drive ? *drive : nothing;
        csv += ',' + csv_cell(own.order);
        if (has_playing_time(report, label)) csv += ',' + time_cells(own.playing_time, own.reason);
        csv += answer_cells(items_of(report.subjects, label), own.answers);
      }
      if (!drive) {
        csv += std::string(keys.size() + 5, ',');
        continue;
      }
      csv += fmt::format(",{},{},{},{},{}", drive->sessions.size(), joined(drive->seeds), drive->ended_cleanly ? 1 : 0,
                         drive->measures.samples, drive->measures.impossible.samples);
      for (const auto& measure : list_measures(drive->measures, report.settings))
        csv += ',' + number_cell(measure.value);
    }
    csv += '\n';
  }
  return csv;
}

std::string to_json(const GroupReport& report) {
  Json json = {{"version", 2}, {"title", report.title}, {"note", report.note}};
  // Definitions with their options once, counts of samples with each value.
  json["measures"] = Json::object();
  for (const auto& measure : list_measures(DriveMeasures{}, report.settings))
    json["measures"][measure.key] = {{"title", measure.title}, {"unit", measure.unit}};
  json["subjects"] = Json::array();
  for (const PooledSubject& subject : report.subjects) {
    Json row = {{"participant", subject.subject.participant},
                {"group", subject.subject.group},
                {"driver", subject.driver},
                {"columns", Json(subject.subject.columns)},
                {"answers", Json(subject.answers)}};
    row.update(time_json(subject.playing_time, subject.reason));
    for (const PooledDrive& drive : subject.drives) {
      const ImpossibleNumbers& impossible = drive.measures.impossible;
      Json own = {{"label", drive.label},
                  {"order", drive.order},
                  {"seeds", drive.seeds},
                  {"ended_cleanly", drive.ended_cleanly},
                  {"answers", Json(drive.answers)},
                  {"impossible", impossible.any() ? Json(told(impossible)) : Json(nullptr)},
                  {"lateral_position_histogram", histogram_json(drive.measures.histogram)},
                  {"measures", measures_json(drive.measures, report.settings)}};
      own.update(time_json(drive.playing_time, drive.reason));
      row["drives"].push_back(std::move(own));
    }
    json["subjects"].push_back(std::move(row));
  }
  return document::text_of(json);
}

}  // namespace septet::logging
