#include "engine/document/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/core.h>

#include "engine/document/markup.hpp"

namespace septet::document {
namespace {

constexpr double legend_row = 16.0;

/// The edges of the plot within a chart's place, in the picture's units.
struct Frame {
  Place place;
  double left, right, top, bottom;
};

Frame frame_of(const Place& place, std::size_t legend_rows = 0) {
  return {place, place.x + 58.0, place.x + place.width - 14.0, place.y + 30.0,
          place.y + place.height - 38.0 - legend_row * static_cast<double>(legend_rows)};
}

std::string text(std::string_view css_class, double x, double y, std::string_view content) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", css_class, x, y, escaped(content));
}

std::string heading(const Frame& frame, std::string_view title, std::string_view y_label) {
  return text("title", frame.left, frame.place.y + 16, title) + text("unit", frame.right, frame.place.y + 16, y_label);
}

std::string y_axis(const Frame& frame, const Axis& y, const std::vector<double>& ticks) {
  std::string svg;
  for (const double tick : ticks)
    svg += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", frame.left, y(tick), frame.right) +
           text("y-tick", frame.left - 8, y(tick) + 4, tick_label(tick, ticks));
  return svg;
}

std::string x_tick(const Frame& frame, double x, std::string_view label) {
  return fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}v5\"/>", x, frame.bottom) +
         text("x-tick", x, frame.bottom + 18, label);
}

std::string x_line(const Frame& frame, std::string_view x_label) {
  return fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", frame.left, frame.bottom, frame.right) +
         text("x-label", (frame.left + frame.right) / 2, frame.bottom + 36, x_label);
}

/// Thins a line to two points for each column of the picture that it enters: the lowest and the highest, in their
/// order.
std::vector<Point> thinned(const std::vector<Point>& line, const Axis& x) {
  if (line.size() < 2000) return line;
  std::vector<Point> result;
  std::size_t i = 0;
  while (i < line.size()) {
    const double column = std::floor(x(line[i].x));
    std::size_t low = i, high = i;
    for (; i < line.size() && std::floor(x(line[i].x)) == column; ++i) {
      if (!std::isfinite(line[i].y) || !std::isfinite(line[low].y)) low = high = i;
      if (line[i].y < line[low].y) low = i;
      if (line[i].y > line[high].y) high = i;
    }
    result.push_back(line[std::min(low, high)]);
    if (low != high) result.push_back(line[std::max(low, high)]);
  }
  return result;
}

bool is_inside(const Point& point, const Axis& y) {
  return std::isfinite(point.y) && point.y >= y.low && point.y <= y.high;
}

std::string path_of(const std::vector<Point>& line, const Axis& x, const Axis& y) {
  std::string path;
  bool pen_down = false;
  for (const Point& point : line) {
    const bool inside = is_inside(point, y);
    if (inside) path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', x(point.x), y(point.y));
    pen_down = inside;
  }
  return path;
}

/// CSS class of a series: "line", and for those after the first "line s1", "line s2", …
std::string css_class(const Series& series, std::size_t number) {
  std::string name = series.stroke == Stroke::dots ? "dots" : "line";
  if (series.stroke == Stroke::dashed) name += " dashed";
  return number == 0 ? name : fmt::format("{} s{}", name, number);
}

std::string drawn(const Series& series, std::size_t number, const Axis& x, const Axis& y) {
  const std::string its_class = css_class(series, number);
  if (series.stroke != Stroke::dots)
    return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", its_class, path_of(thinned(series.points, x), x, y));
  std::string svg;
  for (const Point& point : series.points)
    if (is_inside(point, y))
      svg += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>\n", its_class, x(point.x),
                         y(point.y));
  return svg;
}

/// Rows of the legend; series without a name have none.
std::size_t legend_rows(const LineChart& chart) {
  const auto named = std::ranges::count_if(chart.series, [](const Series& series) { return !series.name.empty(); });
  return chart.series.size() > 1 ? (static_cast<std::size_t>(named) + 1) / 2 : 0;
}

std::string legend(const LineChart& chart, const Frame& frame) {
  std::string svg;
  if (legend_rows(chart) == 0) return svg;
  std::size_t entry = 0;
  for (std::size_t n = 0; n < chart.series.size(); ++n) {
    if (chart.series[n].name.empty()) continue;
    const std::size_t column = entry % 2, row = entry / 2;
    ++entry;
    const double x = frame.left + (frame.right - frame.left) / 2 * static_cast<double>(column),
                 y = frame.bottom + 52 + legend_row * static_cast<double>(row);
    const std::string its_class = css_class(chart.series[n], n);
    svg += chart.series[n].stroke == Stroke::dots
               ? fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>", its_class, x + 12, y - 4)
               : fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}h24\"/>", its_class, x, y - 4);
    svg += text("legend", x + 30, y, chart.series[n].name);
  }
  return svg;
}

/// Range over all points that can be drawn, by one of their coordinates.
Range range_of(const LineChart& chart, double Point::*coordinate) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Series& series : chart.series)
    for (const Point& point : series.points) {
      if (!std::isfinite(point.*coordinate)) continue;
      range.low = std::min(range.low, point.*coordinate);
      range.high = std::max(range.high, point.*coordinate);
    }
  return range.low <= range.high ? range : Range{};
}

std::string in_svg(const std::string& title, const std::string& content) {
  const Place place;
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n", place.width,
                     place.height, escaped(title), content);
}

}  // namespace

std::string drawn(const LineChart& chart, const Place& place) {
  const Frame frame = frame_of(place, legend_rows(chart));
  const Range x_range = chart.x.value_or(range_of(chart, &Point::x));
  const Axis x = axis_of(x_range, frame.left, frame.right);
  const Axis y = axis_of(chart.y.value_or(round_range(range_of(chart, &Point::y), 5)), frame.bottom, frame.top + 8);
  std::string svg = heading(frame, chart.title, chart.y_label);
  if (!chart.band_low.empty()) {
    std::vector<Point> edge = thinned(chart.band_low, x), back = thinned(chart.band_high, x);
    edge.insert(edge.end(), back.rbegin(), back.rend());
    svg += fmt::format("<path class=\"band\" d=\"{}Z\"/>\n", path_of(edge, x, y));
  }
  svg += y_axis(frame, y, chart.y_ticks.value_or(round_ticks({y.low, y.high}, 5)));
  const auto ticks = round_ticks(x_range, static_cast<int>(place.width / 96.0));
  for (const double tick : ticks) svg += x_tick(frame, x(tick), tick_label(tick, ticks));
  for (const Mark& mark : chart.marks) {
    svg += fmt::format("<g><title>{}</title><path class=\"mark\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", escaped(mark.tip),
                       x(mark.x), frame.top + 4, frame.bottom);
    svg += text("mark-label", x(mark.x), frame.top + 2, mark.label) + "</g>";
  }
  for (std::size_t n = 0; n < chart.series.size(); ++n) svg += drawn(chart.series[n], n, x, y);
  return svg + x_line(frame, chart.x_label) + legend(chart, frame);
}

std::string to_svg(const LineChart& chart) { return in_svg(chart.title, drawn(chart, {})); }

std::string to_svg(const BarChart& chart) {
  const Frame frame = frame_of({});
  double largest = 0.0;
  for (const Bar& bar : chart.bars) largest = std::max(largest, bar.value);
  if (chart.level) largest = std::max(largest, chart.level->value);
  const Axis x = axis_of({chart.x_low, chart.x_high}, frame.left, frame.right);
  const Axis y = axis_of({0.0, largest > 0.0 ? largest * 1.08 : 1.0}, frame.bottom, frame.top + 8);
  std::string svg = heading(frame, chart.title, chart.y_label) + y_axis(frame, y, round_ticks({y.low, y.high}, 5));
  for (const Bar& bar : chart.bars) {
    const double a = std::min(x(bar.from), x(bar.to)) + 1.5, b = std::max(x(bar.from), x(bar.to)) - 1.5;
    svg += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}</title></rect>\n",
        bar.emphasised ? "bar strong" : "bar", a, y(bar.value), b - a, frame.bottom - y(bar.value), escaped(bar.tip));
  }
  if (const auto& level = chart.level) {
    svg += fmt::format("<path class=\"mark\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", frame.left, y(level->value), frame.right) +
           text("level", frame.left + 8, y(level->value) - 5, level->label);
  }
  for (const auto& [value, label] : chart.x_ticks) svg += x_tick(frame, x(value), label);
  return in_svg(chart.title, svg + x_line(frame, chart.x_label));
}

}  // namespace septet::document
