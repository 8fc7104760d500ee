#include "logging/study/report/answer_sections.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/document/chart.hpp"
#include "engine/document/markup.hpp"
#include "logging/study/report/group_words.hpp"

namespace septet::logging {
namespace {

using document::escaped;

std::string in_words(const std::string& label) { return label.empty() ? "no part" : label; }

/// For one part and condition.
std::string survival_section(const GroupReport& report, const std::string& label, const std::string& title) {
  std::vector<std::pair<std::string, std::vector<ObservedTime>>> groups;
  double longest_s = 0.0;
  for (const auto& group : groups_of(report.subjects)) {
    std::vector<ObservedTime> times;
    for (const PooledSubject& subject : report.subjects)
      for (const PooledDrive& drive : subject.drives) {
        if (subject.subject.group != group || drive.label != label || !drive.playing_time) continue;
        times.push_back(*drive.playing_time);
        longest_s = std::max(longest_s, times.back().time_s);
      }
    if (!times.empty()) groups.emplace_back(group, std::move(times));
  }
  if (groups.empty()) return "";
  document::LineChart chart;
  chart.title = "Who is still driving";
  chart.x_label = "playing time, min";
  chart.y_label = "share";
  chart.y = {0.0, 1.05};
  std::string rows;
  for (const auto& [group, times] : groups) {
    const auto curve = survival_curve(times);
    document::Series series{name_of_group(group), {{0.0, 1.0}}, document::Stroke::line};
    if (chart.series.size() % 2 == 1) series.stroke = document::Stroke::dashed;
    for (const SurvivalStep& step : curve) {
      series.points.push_back({step.time_s / 60.0, series.points.back().y});
      series.points.push_back({step.time_s / 60.0, step.share});
    }
    series.points.push_back({longest_s / 60.0, series.points.back().y});
    chart.series.push_back(std::move(series));
    const auto stopped = std::ranges::count_if(times, [](const ObservedTime& time) { return time.stopped; });
    double mean_s = 0.0;
    for (const ObservedTime& time : times) mean_s += time.time_s / static_cast<double>(times.size());
    const auto half_s = median_survival_s(curve);
    rows += fmt::format(
        "<tr><td class=\"name\">{}</td><td class=\"value\">{}</td><td class=\"value\">{}</td><td "
        "class=\"value\">{:.1f} min</td>"
        "<td class=\"value\">{}</td><td class=\"value\">{}</td></tr>\n",
        escaped(name_of_group(group)), times.size(), stopped, mean_s / 60.0,
        half_s ? fmt::format("{:.1f} min", *half_s / 60.0) : "not reached",
        curve.empty()
            ? "1"
            : fmt::format("{:.2f} ({:.2f} to {:.2f})", curve.back().share, curve.back().low, curve.back().high));
  }
  std::string html =
      "<h2>" + escaped(title) + "</h2>\n" +
      framed(document::to_svg(chart),
             "Kaplan and Meier's estimate: who had not stopped when what was offered was over is censored there, "
             "and who was never seen to stop is not counted as having stopped.") +
      "<table><tr><th>Group</th><th>Drivers</th><th>Stopped</th><th>Driven, mean</th><th>Median</th><th>Going on at "
      "the "
      "end (95 %, Greenwood)</th></tr>\n" +
      rows + "</table>\n";
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = i + 1; j < groups.size(); ++j)
      if (const auto test = log_rank_test(groups[i].second, groups[j].second))
        html += fmt::format("<p>{} against {}: log-rank χ²(1) = {:.2f}, p = {:.3g}.</p>\n",
                            escaped(name_of_group(groups[i].first)), escaped(name_of_group(groups[j].first)),
                            test->chi_square, test->p);
  return html;
}

}  // namespace

std::string survival_sections(const GroupReport& report) {
  const auto labels = labels_of(report.subjects);
  std::string html;
  for (const auto& label : labels)
    html += survival_section(report, label, labels.size() > 1 ? "Playing time: " + in_words(label) : "Playing time");
  return html;
}

std::string answers_section(const GroupReport& report) {
  const auto labels = labels_of(report.subjects);
  std::string rows;
  for (const auto& label : labels)
    for (const auto& item : items_of(report.subjects, label)) {
      std::vector<double> values;
      for (const PooledSubject& subject : report.subjects)
        for (const PooledDrive& drive : subject.drives)
          if (const auto answer = drive.answers.find(item); drive.label == label && answer != drive.answers.end())
            values.push_back(answer->second);
      rows += fmt::format("<tr><td class=\"name\">{}</td>{}<td>{}</td></tr>\n", escaped(item),
                          labels.size() > 1 ? "<td>" + escaped(in_words(label)) + "</td>" : "", spread_text(values));
    }
  if (rows.empty()) return "";
  return fmt::format("<h2>Answers</h2>\n<table><tr><th>Item</th>{}<th>Mean ± SD; median [quartiles] (n)</th></tr>\n",
                     labels.size() > 1 ? "<th>After</th>" : "") +
         rows +
         "</table>\n<p class=\"soft\">A single statement is ordinal: its mean is here because the paper gives "
         "means.</p>\n";
}

}  // namespace septet::logging
