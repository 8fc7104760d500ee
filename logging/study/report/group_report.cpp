#include "logging/study/report/group_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/core.h>

#include "engine/document/chart.hpp"
#include "engine/document/markup.hpp"
#include "engine/document/text_file.hpp"
#include "logging/study/measures/order_statistics.hpp"
#include "logging/study/report/answer_sections.hpp"
#include "logging/study/report/drive_pages.hpp"
#include "logging/study/report/group_words.hpp"
#include "logging/study/report/lateral_histogram_chart.hpp"
#include "logging/study/report/measure_list.hpp"
#include "logging/study/report/report_style.hpp"
#include "logging/study/statistics/compare.hpp"

namespace septet::logging {
namespace {

using document::escaped;

const PooledDrive* drive_of(const PooledSubject& subject, const std::string& label) {
  const auto found = std::ranges::find(subject.drives, label, &PooledDrive::label);
  return found == subject.drives.end() ? nullptr : &*found;
}

/// Values of one measure by group, for subjects with a value.
using ByGroup = std::vector<std::pair<std::string, std::vector<double>>>;

/// One measure of all drives with this label: its values by group.
struct MeasureColumn {
  ListedMeasure measure;  ///< From any subject, for title, unit and definition.
  ByGroup values;
  std::size_t undefined = 0;
};

std::vector<MeasureColumn> columns_of(const GroupReport& report, const std::string& label) {
  std::vector<MeasureColumn> columns;
  for (auto& measure : list_measures(DriveMeasures{}, report.settings)) {
    columns.push_back({std::move(measure), {}, 0});
    for (const auto& group : groups_of(report.subjects))
      columns.back().values.emplace_back(group, std::vector<double>{});
  }
  for (const PooledSubject& subject : report.subjects) {
    const PooledDrive* drive = drive_of(subject, label);
    if (!drive) continue;
    const auto measures = list_measures(drive->measures, report.settings);
    for (std::size_t i = 0; i < measures.size(); ++i) {
      if (!measures[i].value) {
        ++columns[i].undefined;
        continue;
      }
      for (auto& [group, values] : columns[i].values)
        if (group == subject.subject.group) values.push_back(*measures[i].value);
    }
  }
  return columns;
}

LateralPositionHistogram pooled_histogram(const GroupReport& report) {
  LateralPositionHistogram all;
  for (const PooledSubject& subject : report.subjects)
    for (const PooledDrive& drive : subject.drives) {
      const LateralPositionHistogram& own = drive.measures.histogram;
      for (std::size_t i = 0; i < all.counts.size(); ++i) all.counts[i] += own.counts[i];
      all.underflow += own.underflow;
      all.overflow += own.overflow;
      all.off_lane += own.off_lane;
    }
  return all;
}

/// Figure 5 of the paper, in its form.
std::string figure_5(const LateralPositionHistogram& histogram) {
  return framed(
      lateral_histogram_svg(histogram, "Relative lateral position of the car, all drives"),
      fmt::format(
          "In the form of figure 5 of Lebram, Engström and Gustavsson (SIGRAD 2006): 21 intervals across the lane, "
          "whichever lane, lane changes included, each bar over the number of all {} samples at 10 Hz. Beyond the "
          "left-hand line {}, beyond the right-hand line {}; {} more were off every lane and are in no bar. The paper "
          "prints no figures of its other bars, nor where its edges lie.",
          histogram.total(), histogram.overflow, histogram.underflow, histogram.off_lane));
}

/// Sums over everybody.
struct Totals {
  std::size_t samples = 0, lane_changes = 0, glances = 0, impossible = 0;
  double driven_s = 0.0, in_lanes_s = 0.0, with_head_s = 0.0;
};

Totals totals_of(const GroupReport& report) {
  Totals totals;
  for (const PooledSubject& subject : report.subjects)
    for (const PooledDrive& drive : subject.drives) {
      totals.samples += drive.measures.samples;
      totals.driven_s += drive.measures.duration_s;
      if (drive.measures.has_lanes()) totals.in_lanes_s += drive.measures.duration_s;
      if (drive.measures.head_is_known) totals.with_head_s += drive.measures.duration_s;
      totals.impossible += drive.measures.impossible.any();
      totals.lane_changes += drive.measures.lane_changes.size();
      totals.glances += drive.measures.glances.size();
    }
  return totals;
}

std::string beside_the_paper(const GroupReport& report, const LateralPositionHistogram& histogram) {
  const Totals totals = totals_of(report);
  std::size_t stopped = 0, with_time = 0;
  for (const PooledSubject& subject : report.subjects)
    for (const PooledDrive& drive : subject.drives) {
      with_time += drive.playing_time.has_value();
      stopped += drive.playing_time && drive.playing_time->stopped;
    }
  std::string html =
      "<h2>Beside the paper</h2>\n<table><tr><th>What</th><th>Here</th><th>Lebram, Engström and Gustavsson "
      "2006</th></tr>\n";
  const auto row = [&](const std::string& name, const std::string& here, const std::string& paper) {
    html += fmt::format("<tr><td class=\"name\">{}</td><td class=\"value\">{}</td><td>{}</td></tr>\n", escaped(name),
                        escaped(here), escaped(paper));
  };
  const auto every = [&](double driven_s, std::size_t count) {
    return count > 0 ? fmt::format("{:.1f} s", driven_s / static_cast<double>(count)) : std::string("–");
  };
  row("Drivers", fmt::format("{}", report.subjects.size()), "24 driving-school students");
  row("Driven", fmt::format("{:.2f} h", totals.driven_s / 3600.0), "almost 12 h");
  row("Samples at 10 Hz", fmt::format("{}", totals.samples), "413 973");
  row("In the centre interval of 21",
      fmt::format("{:.1f} %", 100.0 * histogram.fraction(LateralPositionHistogram::bins / 2)),
      "almost 25 %, more than double its neighbours");
  const double beside = histogram.fraction(9) + histogram.fraction(11);
  row("Centre over its neighbours' mean",
      beside > 0.0 ? fmt::format("{:.2f}", 2.0 * histogram.fraction(10) / beside) : "–", "above 2");
  row("Time between lane changes", every(totals.in_lanes_s, totals.lane_changes), "15 s");
  row("Time between uses of mirrors", every(totals.with_head_s, totals.glances), "10 s");
  row("Stopped of their own will", with_time > 0 ? fmt::format("{} of {}", stopped, with_time) : "–",
      "not told; four of 24 named sickness among their reasons");
  return html + "</table>\n";
}

/// Every subject a dot, a row for each group.
std::string strip_chart(const MeasureColumn& column) {
  document::LineChart chart;
  const auto& measure = column.measure;
  chart.title = measure.title;
  chart.x_label = measure.unit.empty() ? "" : measure.unit;
  chart.y_label = "a dot a driver; a bar at each group's median";
  const auto groups = static_cast<double>(column.values.size());
  chart.y = {0.0, groups + 0.5};
  document::Series medians{"", {}, document::Stroke::line};  // One series, its bars apart.
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    const double row = groups - static_cast<double>(i);
    document::Series dots{
        column.values.size() > 1 ? fmt::format("{:g}: {}", row, name_of_group(column.values[i].first)) : std::string(),
        {},
        document::Stroke::dots};
    auto values = column.values[i].second;
    std::ranges::sort(values);
    // Evenly up and down around the row, so that equal values do not lie on each other.
    for (std::size_t k = 0; k < values.size(); ++k) {
      dots.points.push_back({values[k], row + 0.08 * static_cast<double>(static_cast<int>(k % 5) - 2)});
      low = std::min(low, values[k]);
      high = std::max(high, values[k]);
    }
    chart.series.push_back(std::move(dots));
    if (const auto middle = median(values))
      medians.points.insert(medians.points.end(),
                            {{*middle, row - 0.3}, {*middle, row + 0.3}, {*middle, std::nan("")}});
  }
  if (!(high > low)) return "";
  const double margin = 0.03 * (high - low);  // Keeps dots off the frame.
  chart.x = {low - margin, high + margin};
  chart.y_ticks.emplace();
  if (column.values.size() > 1)
    for (double row = 1.0; row <= groups; ++row) chart.y_ticks->push_back(row);
  chart.series.push_back(std::move(medians));
  return framed(document::to_svg(chart), measure.definition);
}

std::string distributions(const std::vector<MeasureColumn>& columns) {
  std::string html = "<table class=\"wide\"><tr><th>Measure</th>";
  if (columns.empty()) return "";
  for (const auto& [group, values] : columns.front().values)
    html += fmt::format("<th>{}</th>", escaped(name_of_group(group)));
  html += "<th>Undefined</th></tr>\n";
  for (const MeasureColumn& column : columns) {
    if (std::ranges::all_of(column.values, [](const auto& entry) { return entry.second.empty(); })) continue;
    html += fmt::format("<tr title=\"{}\"><td class=\"name\">{}{}</td>", escaped(column.measure.definition),
                        escaped(column.measure.title),
                        column.measure.unit.empty() ? "" : ", " + escaped(column.measure.unit));
    for (const auto& [group, values] : column.values) html += fmt::format("<td>{}</td>", spread_text(values));
    html += fmt::format("<td>{}</td></tr>\n", column.undefined);
  }
  return html + "</table>\n<p class=\"soft\">Mean ± SD (n − 1); median [quartiles] (n).</p>\n";
}

std::string comparisons(const std::vector<MeasureColumn>& columns) {
  std::string rows;
  std::size_t count = 0;
  for (const MeasureColumn& column : columns)
    for (std::size_t i = 0; i < column.values.size(); ++i)
      for (std::size_t j = i + 1; j < column.values.size(); ++j) {
        const auto& [first_name, first] = column.values[i];
        const auto& [second_name, second] = column.values[j];
        const auto effect = hedges_g(first, second);
        const auto welch = welch_test(first, second);
        const auto ranks = mann_whitney_test(first, second);
        if (!effect || !welch || !ranks) continue;
        ++count;
        rows += fmt::format(
            "<tr><td class=\"name\">{}</td><td>{} − {}</td><td class=\"value\">{:.4g} [{:.4g}, {:.4g}]{}</td><td "
            "class=\"value\">{:.2f} "
            "[{:.2f}, {:.2f}]</td><td>t({:.1f}) = {:.2f}, p = {:.3g}</td><td>U = {:g}, p = {:.3g}</td></tr>\n",
            escaped(column.measure.title), escaped(name_of_group(first_name)), escaped(name_of_group(second_name)),
            welch->difference, welch->low, welch->high,
            column.measure.unit.empty() ? "" : ' ' + escaped(column.measure.unit), effect->g, effect->low, effect->high,
            welch->degrees, welch->t, welch->p, ranks->u, ranks->p);
      }
  if (rows.empty()) return "";
  return "<h3>Differences between groups</h3>\n<table class=\"wide\"><tr><th>Measure</th><th>Groups</th><th>Difference "
         "of the means [95 "
         "%]</th><th>Hedges' g [95 %]</th><th>Welch's t-test</th><th>Mann–Whitney</th></tr>\n" +
         rows +
         fmt::format(
             "</table>\n<p class=\"soft\">Both tests are two-sided and not corrected for there being {} of them: about "
             "{:.0f} would be "
             "below 0.05 by chance alone.</p>\n",
             count, 0.05 * static_cast<double>(count));
}

/// Every drive that has a page of its own; of many, folded.
std::string drive_links(const GroupReport& report) {
  if (report.drive_pages.empty()) return "";
  constexpr std::size_t many = 40;
  std::string html = fmt::format(
      "<h2>Drives</h2>\n<details{}><summary>{} drives, a page each</summary>\n<table><tr><th>Driver</th><th>Group</th>"
      "<th>Pages</th></tr>\n",
      report.drive_pages.size() <= many ? " open" : "", report.drive_pages.size());
  for (const PooledSubject& subject : report.subjects) {
    std::string links;
    for (const PooledDrive& drive : subject.drives)
      for (std::size_t i = 0; i < drive.sessions.size(); ++i) {
        const auto page = report.drive_pages.find(drive.sessions[i]);
        if (page == report.drive_pages.end()) continue;
        std::string name = drive.label.empty() ? "drive" : drive.label;
        if (drive.sessions.size() > 1) name += fmt::format(" {}", i + 1);
        links +=
            fmt::format("{}<a href=\"{}\">{}</a>", links.empty() ? "" : " · ", escaped(page->second), escaped(name));
      }
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped(subject.subject.participant),
                        escaped(subject.subject.group), links);
  }
  return html + "</table></details>\n";
}

}  // namespace

std::string to_html(const GroupReport& report) {
  const Totals totals = totals_of(report);
  std::string body =
      fmt::format("<h1>{}</h1>\n<p class=\"soft\">{} drivers, {:.2f} h, {} samples.</p>\n", escaped(report.title),
                  report.subjects.size(), totals.driven_s / 3600.0, totals.samples);
  if (!report.note.empty()) body += fmt::format("<p class=\"warning\">{}</p>\n", escaped(report.note));
  const auto models = std::ranges::count_if(report.subjects, [](const PooledSubject& s) { return !s.driver.empty(); });
  if (models > 0)
    body += fmt::format(
        "<p class=\"warning\">{} of {} were simulated drivers: models, fitted neither to people nor to the paper. "
        "Nothing here says how "
        "people drive.</p>\n",
        models, report.subjects.size());
  const auto unclean = std::ranges::count_if(report.subjects, [](const PooledSubject& s) {
    return std::ranges::any_of(s.drives, [](const PooledDrive& drive) { return !drive.ended_cleanly; });
  });
  if (unclean > 0)
    body +=
        fmt::format("<p class=\"warning\">{} drivers have a drive whose recording has no clean end.</p>\n", unclean);
  if (totals.impossible > 0)
    body += fmt::format(
        "<p class=\"warning\">{} drives hold numbers that nothing physical has; they are left out of every figure, and "
        "subjects.json says of which.</p>\n",
        totals.impossible);
  body += drive_links(report);
  const auto histogram = pooled_histogram(report);
  if (totals.samples > 0) body += figure_5(histogram) + beside_the_paper(report, histogram);
  body += survival_sections(report) + answers_section(report);
  for (const auto& label : labels_of(report.subjects)) {
    const auto columns = columns_of(report, label);
    body += fmt::format("<h2>Measures{}</h2>\n", label.empty() ? "" : ": " + escaped(label));
    for (const char* key : {"lateral_position_sd_m", "speed_mean_mps", "time_headway_median_s", "between_glances_s"})
      for (const MeasureColumn& column : columns)
        if (column.measure.key == key) body += strip_chart(column);
    body += distributions(columns) + comparisons(columns);
  }
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n"
      "<title>{}</title>\n<style>{}svg circle {{ fill: var(--line); fill-opacity: 0.75; }} "
      "svg circle.s1 {{ fill: var(--mark); stroke: none; }} svg .s2 {{ stroke: var(--ink); }} svg "
      "circle.s2 {{ fill: var(--ink); stroke: none; }} svg .s3, svg .s4, svg .s5 {{ stroke: var(--ink); }} "
      "table.wide {{ font-size: 13px; }} table.wide td {{ "
      "padding: 4px 10px 4px 0; }}</style></head>\n<body><main>\n{}</main></body></html>\n",
      escaped(report.title), report_style, body);
}

Expected<void> write_group_report(GroupReport report, const std::filesystem::path& folder) {
  auto pages = write_drive_pages(report.subjects, report.settings, folder);
  if (!pages) return tl::unexpected(pages.error());
  report.drive_pages = std::move(*pages);
  return document::write_text_files(
      folder, {{"report.html", to_html(report)}, {"subjects.csv", to_csv(report)}, {"subjects.json", to_json(report)}});
}

}  // namespace septet::logging
