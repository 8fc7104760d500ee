#include "logging/study/report/report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/document/chart.hpp"
#include "engine/document/markup.hpp"
#include "engine/document/text_file.hpp"
#include "logging/session/subject.hpp"
#include "logging/study/measures/crashes.hpp"
#include "logging/study/report/crash_section.hpp"
#include "logging/study/report/event_section.hpp"
#include "logging/study/report/lateral_histogram_chart.hpp"
#include "logging/study/report/measure_table.hpp"
#include "logging/study/report/report_style.hpp"
#include "logging/study/report/route_chart.hpp"

namespace septet::logging {
namespace {

using document::escaped;

std::string tile(std::string_view value, std::string_view unit, std::string_view name) {
  return fmt::format("<div class=\"tile\"><b>{} <small>{}</small></b><span>{}</span></div>\n", value, unit, name);
}

std::string figure(const std::string& svg, std::string_view caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, caption);
}

const SourceFile* find_file(const SessionInfo& info, std::string_view role) {
  const auto found = std::ranges::find(info.files, role, &SourceFile::role);
  return found == info.files.end() ? nullptr : &*found;
}

/// The drive's end, and caveats for users of its figures.
std::string ending(const ReportData& data) {
  std::string html;
  const auto warn = [&](const std::string& text) {
    html += fmt::format("<p class=\"warning\">{}</p>\n", escaped(text));
  };
  if (const auto& outcome = data.outcome) {
    html += fmt::format("<p>Ended after {:.1f} s of simulated time, {:.1f} s of wall time: {} (<code>{}</code>).</p>\n",
                        outcome->simulated_s, outcome->wall_s, escaped(text_of(outcome->end)), name_of(outcome->end));
    if (!outcome->error.empty()) warn(outcome->error);
    if (outcome->late_ticks > 0)
      warn(fmt::format(
          "{} of {} ticks began late: the machine was too slow for real time, and the simulation slowed down.",
          outcome->late_ticks, outcome->ticks));
    if (outcome->bad_numbers > 0)
      warn(
          fmt::format("{} numbers went bad and were reset; the events bad_number in the log say whose and when. "
                      "Figures around them mean nothing.",
                      outcome->bad_numbers));
    if (outcome->lost_records > 0) warn(fmt::format("The log lacks the last {} records.", outcome->lost_records));
  }
  if (!data.ended_cleanly)
    warn(
        "The recording has no clean end: the program was stopped while it drove. What is here is what was safely "
        "written.");
  if (data.impossible.any()) warn(told(data.impossible));
  if (data.missing_ticks > 0) warn(fmt::format("The log has gaps: {} ticks are missing.", data.missing_ticks));
  return html;
}

std::string moments(const std::vector<double>& times_s) {
  std::string text;
  for (const double time_s : times_s) text += fmt::format("{}{:.1f}", text.empty() ? "" : ", ", time_s);
  return text.empty() ? "–" : text + " s";
}

std::string screen_table(const ReportData& data) {
  if (!data.outcome || data.outcome->screens.empty()) return "";
  std::string html =
      "<h2>Screens</h2>\n<table><tr><th>Screen</th><th>Pictures</th><th>Off tick</th><th>Ticks lost / repaired / "
      "refused</th>"
      "<th>Picture to picture, median / 99 %</th><th>Connected</th><th>Left or died</th><th>Left behind</th></tr>\n";
  for (const ScreenOutcome& screen : data.outcome->screens) {
    std::string row =
        fmt::format("<tr><td class=\"name\">{}</td><td class=\"value\">{}</td>", escaped(screen.name), screen.frames);
    row += screen.has_reported ? fmt::format(
                                     "<td class=\"value\">{}</td><td class=\"value\">{} / {} / {}</td><td "
                                     "class=\"value\">{:.1f} / {:.1f} ms</td>",
                                     screen.frames_off_tick, screen.datagrams_lost, screen.datagrams_repaired,
                                     screen.refused_ticks, screen.frame_ms_p50, screen.frame_ms_p99)
                               : std::string("<td colspan=\"3\">was not there at the end</td>");
    for (const auto* times : {&screen.connected_s, &screen.left_s, &screen.left_behind_s})
      row += fmt::format("<td>{}</td>", moments(*times));
    html += row + "</tr>\n";
  }
  return html +
         "</table>\n<p class=\"soft\">From picture to picture everything is in it: drawing, device, display and, in "
         "lockstep, the wait for the others.</p>\n";
}

std::string head(const ReportData& data, const DriveMeasures& measures) {
  const SessionInfo& info = data.info;
  const SourceFile* scenario = find_file(info, "scenario");
  const SourceFile* rig = find_file(info, "rig");
  const auto stem = [](const SourceFile& file) { return std::filesystem::path(file.name).stem().string(); };
  std::string html = fmt::format("<h1>{}</h1>\n<p class=\"soft\">", escaped(scenario ? stem(*scenario) : "A drive"));
  if (rig) html += fmt::format("Rig {} · ", escaped(stem(*rig)));
  if (!info.participant.empty()) html += fmt::format("driver {} · ", escaped(info.participant));
  for (const auto& [name, value] : meta_of(subject_of(info)))
    html += fmt::format("{} {} · ", escaped(name.starts_with("column.") ? name.substr(7) : name), escaped(value));
  if (!info.started_utc.empty()) html += fmt::format("started {} · ", escaped(info.started_utc));
  for (const auto& [name, value] : info.parameters) html += fmt::format("{} = {} · ", escaped(name), escaped(value));
  for (const auto& [name, seed] : info.seeds) html += fmt::format("seed {} {} · ", escaped(name), seed);
  html += fmt::format("Septet {}{}{}</p>\n", escaped(info.septet_version), info.git_revision.empty() ? "" : " at ",
                      escaped(info.git_revision.substr(0, 12)));
  html += ending(data);
  const auto& position = measures.lateral_position;
  html += "<div class=\"tiles\">\n";
  html += tile(fmt::format("{:.1f}", measures.duration_s), "s", "simulated time");
  html += tile(fmt::format("{:.2f}", measures.distance_m / 1000.0), "km", "driven");
  html += tile(fmt::format("{:.0f}", measures.speed_mean_mps * 3.6), "km/h", "mean speed");
  const bool is_few = position.samples > 0 && position.samples < few_samples;
  html += tile(position.samples ? fmt::format("{:.2f}", position.sd_m) : "–", "m",
               is_few ? fmt::format("SD of lateral position, of only {} samples", position.samples)
                      : std::string("SD of lateral position"));
  html += tile(measures.has_lanes() ? fmt::format("{}", measures.lane_changes.size()) : "–", "", "lane changes");
  html += tile(measures.head_is_known ? fmt::format("{}", measures.glances.size()) : "–", "",
               measures.head_is_known ? "mirror glances" : "mirror glances: no head tracker told them");
  return html + "</div>\n";
}

/// Route, speeds and events.
std::string route_chart(const ReportData& data, const std::vector<ToldEvent>& events) {
  std::vector<RouteMark> marks;
  marks.reserve(events.size());
  for (const ToldEvent& event : events)
    marks.push_back(
        {event.time_s, std::string(event.row->sign), fmt::format("{:.1f} s: {}", event.time_s, event.says)});
  const std::string svg = route_svg(data.samples, marks, "Route from above");
  if (svg.empty()) return "";
  std::string signs;
  for (const EventRow& row : event_rows())
    if (!row.sign.empty()) signs += fmt::format(", {} {}", row.sign, row.title);
  return figure(
      svg, fmt::format(
               "The colour is the speed. A dot is where something was logged{}; hold the pointer over it to read what.",
               signs));
}

std::string speed_chart(const ReportData& data, const DriveMeasures& measures, const std::vector<ToldEvent>& events) {
  document::LineChart chart;
  chart.title = "Speed";
  chart.x_label = "simulated time, s";
  chart.y_label = "km/h";
  chart.y = {0.0, std::max(20.0, measures.speed_largest_mps * 3.6 * 1.05)};
  document::Series speed;
  for (const Sample& sample : data.samples) speed.points.push_back({sample.simulated_time_s, sample.speed_mps * 3.6});
  chart.series = {std::move(speed)};
  for (const Event& event : data.events)
    if (event.kind == "collision")
      chart.marks.push_back(
          {event.simulated_time_s, "✕", "collision at " + fmt::format("{:.1f} s", event.simulated_time_s)});
  const document::Range time_s{data.samples.front().simulated_time_s, data.samples.back().simulated_time_s};
  return figure(
      document::to_svg(chart) + event_strip(events, time_s),
      "Speed of the driver's car along its own axis, ten samples a second. ✕ marks a collision. Below it, each "
      "event of the log at its time; the table at the end says what it was.");
}

std::string lateral_position_chart(const ReportData& data, const DriveMeasures& measures) {
  document::LineChart chart;
  chart.title = "Lateral position";
  chart.x_label = "simulated time, s";
  chart.y_label = "m, left of the lane's centre is up";
  std::vector<document::Point> line;
  double half_lane_m = 1.75, largest_m = 2.0;
  for (const Sample& sample : data.samples) {
    const bool in_lane = sample.lane != 0 && sample.lane_width_m > 0.0;
    if (in_lane) half_lane_m = sample.lane_width_m / 2.0;
    // The jump from one lane's edge to the other's is no movement: lift the pen.
    const bool jumped = !line.empty() && std::abs(line.back().y - sample.lateral_position_m) > half_lane_m;
    if (jumped) line.push_back({sample.simulated_time_s, std::nan("")});
    line.push_back({sample.simulated_time_s, in_lane ? sample.lateral_position_m : std::nan("")});
    chart.band_low.push_back({sample.simulated_time_s, -half_lane_m});
    chart.band_high.push_back({sample.simulated_time_s, half_lane_m});
    largest_m = std::max(largest_m, half_lane_m * 1.1);
  }
  chart.series = {{"", std::move(line)}};
  chart.y = {-largest_m, largest_m};
  for (const LaneChange& change : measures.lane_changes)
    chart.marks.push_back(
        {change.simulated_time_s, change.lanes_to_left > 0 ? "▲" : "▼",
         fmt::format("{:.1f} s: lane {} to lane {}", change.simulated_time_s, change.from_lane, change.to_lane)});
  return figure(document::to_svg(chart),
                "Offset of the middle of the car's front axle from the centre of "
                "the lane it is in; the shaded band is "
                "the lane between its lines. ▲ marks a lane change to the left and ▼ one to the "
                "right: there the line jumps, because the "
                "offset is then that from the next lane's centre.");
}

std::string histogram_chart(const DriveMeasures& measures) {
  using Histogram = LateralPositionHistogram;
  const Histogram& histogram = measures.histogram;
  return figure(lateral_histogram_svg(histogram, "Lateral position within the lane"),
                fmt::format("21 equal intervals across the lane, closed at their right-hand edge, "
                            "the centre one dark; lane changes included. Of {} samples "
                            "{:.1f} % lie in the centre interval, {} beyond the left-hand line, {} "
                            "beyond the right-hand line; {} more were off every lane. "
                            "Figure 5 of Lebram, Engström and Gustavsson (SIGRAD 2006) is of the "
                            "same kind and yet another measurement: 413 973 samples at "
                            "10 Hz of 24 people in almost 12 hours, close to 25 % of them in the "
                            "centre interval (the line), its edges, its reference point and its other bars not stated; "
                            "here it is one drive, and nothing is fitted to that figure.",
                            histogram.total(), 100.0 * histogram.fraction(Histogram::bins / 2), histogram.overflow,
                            histogram.underflow, histogram.off_lane));
}

std::string answer_table(const std::vector<QuestionnaireRecord>& answers) {
  if (answers.empty()) return "";
  std::string html =
      "<h2>Questionnaire</h2>\n<table><tr><th>Item</th><th>Answer</th><th>Observed "
      "until</th></tr>\n";
  for (const QuestionnaireRecord& record : answers) {
    const std::string answer = record.censored ? "censored" + (record.reason.empty() ? "" : ": " + record.reason)
                                               : record.answer.value_or("–");
    html += fmt::format("<tr><td>{}</td><td class=\"value\">{}</td><td class=\"value\">{:.0f} s</td></tr>\n",
                        escaped(record.question.empty() ? record.item : record.question), escaped(answer),
                        record.observed_s);
  }
  return html + "</table>\n";
}

}  // namespace

Expected<ReportData> read_report_data(const SessionReader& reader) {
  auto records = read_drive_records(reader);
  if (!records) return tl::unexpected(records.error());
  auto answers = reader.questionnaire();
  if (!answers) return tl::unexpected(answers.error());
  const auto missing = reader.missing_ticks();
  if (!missing) return tl::unexpected(missing.error());
  ReportData data;
  static_cast<DriveRecords&>(data) = std::move(*records);
  data.info = reader.info();
  data.names = participant_names(reader).value_or(ParticipantNames{});
  data.ended_cleanly = reader.ended_cleanly();
  data.missing_ticks = *missing;
  data.answers = std::move(*answers);
  leave_out_impossible(data.answers, data.impossible);
  if (const auto row = data.info.other.find("outcome"); row != data.info.other.end()) {
    auto outcome = read_outcome(row->second, reader.path().string());
    if (!outcome) return tl::unexpected(outcome.error());
    data.outcome = std::move(*outcome);
  }
  return data;
}

std::string to_html(const ReportData& data) {
  const DriveMeasures measures = compute_drive_measures(data, data.settings);
  const std::vector<ToldEvent> events = tell_events(data.events, data.names);
  std::string body = head(data, measures);
  if (data.samples.empty())
    body += data.impossible.samples > 0
                ? "<p class=\"warning\">No sample is left that a figure could be made of.</p>\n"
                : "<p class=\"warning\">The session holds no samples: nothing was driven.</p>\n";
  else
    body += route_chart(data, events) + speed_chart(data, measures, events) + lateral_position_chart(data, measures) +
            histogram_chart(measures) + measure_table(measures, data.settings);
  body += crash_section(find_crashes(data.events), data.info.ticks_per_second, data.names);
  body += picture_section(data.pictures) + answer_table(data.answers) + event_table(events) + screen_table(data);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n"
      "<title>Septet drive "
      "report</title>\n<style>{}</style></head>\n<body><main>\n{}</main></body></html>\n",
      report_style, body);
}

Expected<void> write_report(const SessionReader& reader, const std::filesystem::path& path,
                            const std::optional<DriveOutcome>& outcome) {
  auto data = read_report_data(reader);
  if (!data) return tl::unexpected(data.error());
  if (!data->outcome) data->outcome = outcome;
  data->pictures = find_drive_pictures(data->info, data->events, path.parent_path(), path.parent_path());
  return document::write_text_file(path, to_html(*data));
}

}  // namespace septet::logging
