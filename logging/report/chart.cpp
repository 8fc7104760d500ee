#include "logging/report/chart.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace septet::logging {
namespace {

// The picture, in SVG units: the frame of the plot within it.
constexpr double width = 960, height = 260, left = 58, right = 946, top = 30, bottom = 222;

struct Axis {
  double low, high;        ///< In the data's unit.
  double at_low, at_high;  ///< In the picture.
  double operator()(double value) const {
    return at_low + (value - low) / (high - low) * (at_high - at_low);
  }
};

Axis axis_of(double low, double high, double at_low, double at_high) {
  return {low, high == low ? low + 1.0 : high, at_low, at_high};
}

std::string text(std::string_view css_class, double x, double y, std::string_view content) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", css_class, x, y,
                     escaped(content));
}

/// Enough digits to tell the ticks of an axis apart.
std::string tick_label(double value, double step) {
  int decimals = 0;
  for (double scaled = step; decimals < 6 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled;
       scaled *= 10.0)
    ++decimals;
  return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
}

std::string open_svg(std::string_view title, std::string_view y_label) {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width, height,
                     escaped(title)) +
         text("title", left, 16, title) + text("unit", right, 16, y_label);
}

std::string y_axis(const Axis& y, int count) {
  const auto ticks = round_ticks(y.low, y.high, count);
  std::string svg;
  for (const double tick : ticks) {
    svg += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", left, y(tick), right);
    svg += text("y-tick", left - 8, y(tick) + 4,
                tick_label(tick, ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0));
  }
  return svg;
}

std::string x_tick(double x, std::string_view label) {
  return fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}v5\"/>", x, bottom) +
         text("x-tick", x, bottom + 18, label);
}

std::string close_svg(std::string_view x_label) {
  return fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", left, bottom, right) +
         text("x-label", (left + right) / 2, height - 2, x_label) + "</svg>\n";
}

/// At most two points for each column of the picture: the lowest and the highest, in their order.
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

std::string path_of(const std::vector<Point>& line, const Axis& x, const Axis& y) {
  std::string path;
  bool pen_down = false;
  for (const Point& point : line) {
    if (std::isfinite(point.y))
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', x(point.x), y(point.y));
    pen_down = std::isfinite(point.y);
  }
  return path;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::vector<double> round_ticks(double low, double high, int count) {
  if (!(high > low) || count < 1) return {low};
  const double rough = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double nice : {1.0, 2.0, 2.5, 5.0})
    if (nice * power >= rough * (1.0 - 1e-9)) {
      step = nice * power;
      break;
    }
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k += 1.0)
    ticks.push_back(k * step);
  return ticks;
}

std::string to_svg(const LineChart& chart) {
  const double x_low = chart.line.empty() ? 0.0 : chart.line.front().x,
               x_high = chart.line.empty() ? 1.0 : chart.line.back().x;
  const Axis x = axis_of(x_low, x_high, left, right),
             y = axis_of(chart.y_low, chart.y_high, bottom, top + 8);
  std::string svg = open_svg(chart.title, chart.y_label);
  if (!chart.band_low.empty()) {
    std::vector<Point> edge = thinned(chart.band_low, x), back = thinned(chart.band_high, x);
    edge.insert(edge.end(), back.rbegin(), back.rend());
    svg += fmt::format("<path class=\"band\" d=\"{}Z\"/>\n", path_of(edge, x, y));
  }
  svg += y_axis(y, 5);
  const auto ticks = round_ticks(x_low, x_high, 10);
  for (const double tick : ticks)
    svg += x_tick(x(tick), tick_label(tick, ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0));
  for (const Mark& mark : chart.marks) {
    svg += fmt::format("<g><title>{}</title><path class=\"mark\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>",
                       escaped(mark.tip), x(mark.x), top + 4, bottom);
    svg += text("mark-label", x(mark.x), top + 2, mark.label) + "</g>";
  }
  svg += fmt::format("<path class=\"line\" d=\"{}\"/>\n", path_of(thinned(chart.line, x), x, y));
  return svg + close_svg(chart.x_label);
}

std::string to_svg(const BarChart& chart) {
  double largest = 0.0;
  for (const Bar& bar : chart.bars) largest = std::max(largest, bar.value);
  const Axis x = axis_of(chart.x_low, chart.x_high, left, right);
  const Axis y = axis_of(0.0, largest > 0.0 ? largest * 1.08 : 1.0, bottom, top + 8);
  std::string svg = open_svg(chart.title, chart.y_label) + y_axis(y, 5);
  for (const Bar& bar : chart.bars) {
    const double a = std::min(x(bar.from), x(bar.to)) + 1.5,
                 b = std::max(x(bar.from), x(bar.to)) - 1.5;
    svg += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"><title>{}</title></rect>\n",
        bar.emphasised ? "bar strong" : "bar", a, y(bar.value), b - a, bottom - y(bar.value),
        escaped(bar.tip));
  }
  for (const auto& [value, label] : chart.x_ticks) svg += x_tick(x(value), label);
  return svg + close_svg(chart.x_label);
}

}  // namespace septet::logging
