#include <algorithm>
#include <functional>
#include <set>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"
#include "logging/report/group_report.hpp"
#include "logging/report/measure_json.hpp"
#include "logging/report/measure_list.hpp"

namespace septet::logging {
namespace {

using document::Json;

/// As RFC 4180 has it. A cell that a spreadsheet would take for a formula is made a text.
std::string cell(const std::string& text) {
  std::string value =
      !text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos ? '\'' + text : text;
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

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

std::string to_csv(const GroupReport& report) {
  const auto labels = labels_of(report.subjects);
  const auto keys = list_measures(DriveMeasures{}, report.settings);
  const auto columns = names_of(report.subjects, [](const PooledSubject& s) { return s.subject.columns; });
  const auto items = names_of(report.subjects, [](const PooledSubject& s) { return s.answers; });
  std::string csv = "participant,group,driver,order,playing_time_s,stopped,reason";
  for (const auto& column : columns) csv += ',' + cell("column." + column);
  for (const auto& item : items) csv += ',' + cell("answer." + item);
  for (const auto& label : labels) {
    const std::string prefix = label.empty() ? "" : label + '.';
    for (const char* name : {"drives", "seeds", "ended_cleanly", "samples"}) csv += ',' + cell(prefix + name);
    for (const auto& measure : keys) csv += ',' + cell(prefix + measure.key);
  }
  csv += '\n';
  for (const PooledSubject& subject : report.subjects) {
    const auto& time = subject.playing_time;
    csv += fmt::format("{},{},{},{},{},{},{}", cell(subject.subject.participant), cell(subject.subject.group),
                       cell(subject.driver), cell(subject.subject.order),
                       number_cell(time ? std::optional(time->time_s) : std::nullopt),
                       time ? (time->stopped ? "1" : "0") : "", cell(subject.reason));
    for (const auto& column : columns) {
      const auto own = subject.subject.columns.find(column);
      csv += ',' + (own == subject.subject.columns.end() ? "" : cell(own->second));
    }
    for (const auto& item : items) {
      const auto answer = subject.answers.find(item);
      csv += ',' + (answer == subject.answers.end() ? "" : number_cell(answer->second));
    }
    for (const auto& label : labels) {
      const PooledDrive* drive = find_drive(subject, label);
      if (!drive) {
        csv += std::string(keys.size() + 4, ',');
        continue;
      }
      csv += fmt::format(",{},{},{},{}", drive->sessions.size(), joined(drive->seeds), drive->ended_cleanly ? 1 : 0,
                         drive->measures.samples);
      for (const auto& measure : list_measures(drive->measures, report.settings))
        csv += ',' + number_cell(measure.value);
    }
    csv += '\n';
  }
  return csv;
}

std::string to_json(const GroupReport& report) {
  Json json = {{"version", 1}, {"title", report.title}, {"note", report.note}};
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
    row["playing_time_s"] = subject.playing_time ? document::number(subject.playing_time->time_s) : Json(nullptr);
    row["stopped"] = subject.playing_time ? Json(subject.playing_time->stopped) : Json(nullptr);
    row["reason"] = subject.reason;
    for (const PooledDrive& drive : subject.drives)
      row["drives"].push_back({{"label", drive.label},
                               {"seeds", drive.seeds},
                               {"ended_cleanly", drive.ended_cleanly},
                               {"lateral_position_histogram", histogram_json(drive.measures.histogram)},
                               {"measures", measures_json(drive.measures, report.settings)}});
    json["subjects"].push_back(std::move(row));
  }
  return document::text_of(json);
}

}  // namespace septet::logging
