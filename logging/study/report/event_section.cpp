#include "logging/study/report/event_section.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/core.h>

#include "engine/document/markup.hpp"

namespace septet::logging {
namespace {

using document::escaped;

constexpr double strip_width = 960.0, strip_left = 58.0, strip_right = 946.0;  ///< Same as a line chart's.
constexpr double strip_head = 26.0, strip_row_height = 32.0, strip_foot = 40.0;
constexpr std::size_t most_told_at_a_tick = 6;  ///< Events in the tip of one tick.

std::string sentence(const ToldEvent& event) { return fmt::format("{:.1f} s: {}", event.time_s, event.says); }

/// Events of one row that fall on the same unit of the picture share a tick.
std::string ticks_of(const std::vector<const ToldEvent*>& events, const document::Axis& x, double top) {
  std::map<long, std::vector<const ToldEvent*>> columns;
  for (const ToldEvent* event : events)
    if (std::isfinite(event->time_s))
      columns[std::lround(std::clamp(x(event->time_s), strip_left, strip_right))].push_back(event);
  std::string svg;
  for (const auto& [column, here] : columns) {
    std::string tip;
    for (std::size_t i = 0; i < std::min(here.size(), most_told_at_a_tick); ++i)
      tip += (i ? "\n" : "") + sentence(*here[i]);
    if (here.size() > most_told_at_a_tick) tip += fmt::format("\nand {} more", here.size() - most_told_at_a_tick);
    // The wide one lies below, invisible, as a target for the pointer.
    svg += fmt::format(
        "<g><title>{}</title><path class=\"touch\" d=\"M{} {:.0f}v14\"/><path class=\"event\" d=\"M{} "
        "{:.0f}v14\"/></g>\n",
        escaped(tip), column, top, column, top);
  }
  return svg;
}

}  // namespace

std::string event_strip(std::span<const ToldEvent> events, document::Range time_s) {
  std::vector<std::pair<const EventRow*, std::vector<const ToldEvent*>>> rows;
  for (const EventRow& row : event_rows()) {
    std::vector<const ToldEvent*> its;
    for (const ToldEvent& event : events)
      if (event.row == &row) its.push_back(&event);
    if (!its.empty()) rows.emplace_back(&row, std::move(its));
  }
  if (rows.empty()) return "";
  const document::Axis x = document::axis_of(time_s, strip_left, strip_right);
  const double bottom = strip_head + strip_row_height * static_cast<double>(rows.size());
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Events\">\n<text class=\"title\" x=\"{}\" "
      "y=\"16\">Events</text>\n",
      strip_width, bottom + strip_foot, strip_left);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double top = strip_head + strip_row_height * static_cast<double>(i);
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{} {:.0f}H{}\"/><text class=\"legend\" x=\"{}\" y=\"{:.0f}\">{} ({})</text>\n",
        strip_left, top + strip_row_height, strip_right, strip_left, top + 14.0, rows[i].first->title,
        rows[i].second.size());
    svg += ticks_of(rows[i].second, x, top + strip_row_height - 14.0);
  }
  const auto ticks = document::round_ticks(time_s, 10);
  for (const double tick : ticks)
    svg += fmt::format(
        "<path class=\"axis\" d=\"M{:.1f} {:.0f}v5\"/><text class=\"x-tick\" x=\"{:.1f}\" y=\"{:.0f}\">{}</text>\n",
        x(tick), bottom, x(tick), bottom + 18.0, document::tick_label(tick, ticks));
  return svg + fmt::format("<text class=\"x-label\" x=\"{:.0f}\" y=\"{:.0f}\">simulated time, s</text></svg>\n",
                           (strip_left + strip_right) / 2.0, bottom + 36.0);
}

std::string event_table(std::span<const ToldEvent> events) {
  if (events.empty()) return "";
  std::vector<const ToldEvent*> ordered;
  for (const ToldEvent& event : events) ordered.push_back(&event);
  // Events without a valid time come last.
  std::ranges::stable_sort(ordered, {},
                           [](const ToldEvent* event) { return std::isfinite(event->time_s) ? event->time_s : 1e300; });
  std::map<const EventRow*, std::size_t> counts;
  std::string html =
      "<h2>What happened when</h2>\n<table class=\"events\"><tr><th>Time</th><th>Kind</th><th>What "
      "happened</th></tr>\n";
  for (const ToldEvent* event : ordered)
    if (++counts[event->row] <= most_listed_events)
      html += fmt::format("<tr><td class=\"value\">{:.1f} s</td><td class=\"name\">{}</td><td>{}</td></tr>\n",
                          event->time_s, event->row->title, escaped(event->says));
  for (const auto& [row, count] : counts)
    if (count > most_listed_events)
      html += fmt::format("<tr><td></td><td class=\"name\">{}</td><td>and {} more</td></tr>\n", row->title,
                          count - most_listed_events);
  return html + "</table>\n";
}

}  // namespace septet::logging
