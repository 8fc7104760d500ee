#include "sim-server/command/line_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

namespace septet::server {
namespace {

constexpr double chart_width = 470.0, chart_height = 280.0;
constexpr double left = 62.0, right = 14.0, top = 14.0, bottom = 44.0;
constexpr double head = 64.0, notes_width = 330.0;

struct Axis {
  double low = 0.0, high = 1.0, step = 0.2;
};

/// Bounds on a round grid of 1, 2 or 5 times a power of ten.
Axis round_axis(double low, double high) {
  if (!(high - low > 1e-9)) {
    const double middle = std::isfinite(low) ? low : 0.0;
    low = middle - 0.5;
    high = middle + 0.5;
  }
  const double raw = (high - low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double part = raw / power;
  const double step = power * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
  return {std::floor(low / step + 1e-3) * step, std::ceil(high / step - 1e-3) * step, step};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return out;
}

std::string chart_svg(const LineChart& chart, double x0, double y0) {
  double x_low = std::numeric_limits<double>::max(), x_high = -x_low, y_low = x_low,
         y_high = -x_low;
  for (const auto& [x, y] : chart.points) {
    x_low = std::min(x_low, x);
    x_high = std::max(x_high, x);
    y_low = std::min(y_low, y);
    y_high = std::max(y_high, y);
  }
  if (chart.points.empty()) x_low = y_low = 0.0, x_high = y_high = 1.0;
  const Axis x_axis = round_axis(x_low, x_high), y_axis = round_axis(y_low, y_high);
  const double width = chart_width - left - right, height = chart_height - top - bottom;
  const auto px = [&](double x) {
    return x0 + left + (x - x_axis.low) / (x_axis.high - x_axis.low) * width;
  };
  const auto py = [&](double y) {
    return y0 + top + (y_axis.high - y) / (y_axis.high - y_axis.low) * height;
  };

  std::string svg;
  const auto tick = [](double value, double step) {
    return fmt::format("{:.6g}", std::round(value / step) * step);
  };
  for (double x = x_axis.low; x < x_axis.high + 0.5 * x_axis.step; x += x_axis.step)
    svg += fmt::format(
        "<path class='grid' d='M{0:.1f} {1:.1f}V{2:.1f}'/><text class='tick' text-anchor='middle' "
        "x='{0:.1f}' y='{3:.1f}'>{4}</text>\n",
        px(x), y0 + top, y0 + top + height, y0 + top + height + 16.0, tick(x, x_axis.step));
  for (double y = y_axis.low; y < y_axis.high + 0.5 * y_axis.step; y += y_axis.step)
    svg += fmt::format(
        "<path class='grid' d='M{0:.1f} {1:.1f}H{2:.1f}'/><text class='tick' text-anchor='end' "
        "x='{3:.1f}' y='{4:.1f}'>{5}</text>\n",
        x0 + left, py(y), x0 + left + width, x0 + left - 6.0, py(y) + 4.0, tick(y, y_axis.step));
  svg += fmt::format("<text class='label' text-anchor='middle' x='{:.1f}' y='{:.1f}'>{}</text>\n",
                     x0 + left + 0.5 * width, y0 + chart_height - 8.0, escaped(chart.x_label));
  svg += fmt::format(
      "<text class='label' text-anchor='middle' transform='translate({:.1f} {:.1f}) "
      "rotate(-90)'>{}</text>\n",
      x0 + 14.0, y0 + top + 0.5 * height, escaped(chart.y_label));
  svg += "<polyline class='curve' points='";
  double last_x = -1e9, last_y = -1e9;
  for (std::size_t i = 0; i < chart.points.size(); ++i) {
    const double x = px(chart.points[i].first), y = py(chart.points[i].second);
    // Points closer than a third of a pixel add bytes and no ink.
    if (std::abs(x - last_x) + std::abs(y - last_y) < 0.33 && i + 1 < chart.points.size()) continue;
    svg += fmt::format("{:.1f},{:.1f} ", x, y);
    last_x = x;
    last_y = y;
  }
  return svg + "'/>\n";
}

}  // namespace

std::string chart_page_svg(const std::string& title, const std::string& subtitle,
                           const std::vector<LineChart>& charts,
                           const std::vector<std::string>& notes) {
  const double width = 2.0 * chart_width + notes_width;
  const double height = head + std::ceil(static_cast<double>(charts.size()) / 2.0) * chart_height;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
      "height='{1:.0f}'>\n"
      "<style>text{{font-family:'DejaVu Sans',sans-serif;fill:#222}} "
      ".title{{font-size:20px;font-weight:bold}} "
      ".label{{font-size:13px}} .tick{{font-size:11px;fill:#555}} "
      ".grid{{stroke:#ddd;stroke-width:1;fill:none}} "
      ".curve{{stroke:#0b5fa5;stroke-width:1.8;fill:none;stroke-linejoin:round}}</style>\n"
      "<rect width='100%' height='100%' fill='#fff'/>\n"
      "<text class='title' x='20' y='30'>{2}</text><text class='label' x='20' y='51'>{3}</text>\n",
      width, height, escaped(title), escaped(subtitle));
  for (std::size_t i = 0; i < charts.size(); ++i)
    svg += chart_svg(charts[i], chart_width * static_cast<double>(i % 2),
                     head + chart_height * static_cast<double>(i / 2));
  for (std::size_t i = 0; i < notes.size(); ++i)
    svg += fmt::format("<text class='label' x='{:.0f}' y='{:.0f}'>{}</text>\n",
                       2.0 * chart_width + 10.0, head + 24.0 + 24.0 * static_cast<double>(i),
                       escaped(notes[i]));
  return svg + "</svg>\n";
}

}  // namespace septet::server
