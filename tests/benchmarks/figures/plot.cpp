#include "tests/benchmarks/figures/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace septet::figures {
namespace {

constexpr double width = 760, height = 520, left = 80, right = 20, top = 40, bottom = 128;
constexpr std::array<const char*, 6> colours{"#1f5fa8", "#c8402a", "#2d8a4e",
                                             "#7b4ba0", "#b8860b", "#555555"};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  double share(double v) const { return (v - low) / (high - low); }
};

/// 1, 2 or 5 times a power of ten, about six to the range.
double tick_step(const Range& range) {
  const double rough = (range.high - range.low) / 6.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power) return factor * power;
  return 10.0 * power;
}

std::string text(double x, double y, const char* anchor, int size, const std::string& words) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\">{}</text>\n", x, y,
      anchor, size, escaped(words));
}

}  // namespace

std::string to_svg(const Plot& plot) {
  Range xs, ys;
  for (const Series& s : plot.series) {
    for (const double x : s.x) xs.add(x);
    for (const double y : s.y) ys.add(y);
  }
  if (plot.y_low != plot.y_high) ys = {plot.y_low, plot.y_high};
  const auto px = [&](double x) { return left + xs.share(x) * (width - left - right); };
  const auto py = [&](double y) { return height - bottom - ys.share(y) * (height - top - bottom); };

  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "font-family=\"sans-serif\" fill=\"#222\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"#fff\"/>\n",
      width, height);
  svg += text(left, 24, "start", 16, plot.title);
  const double x_step = tick_step(xs), y_step = tick_step(ys);
  for (double x = std::ceil(xs.low / x_step) * x_step; x <= xs.high + 1e-9 * x_step; x += x_step) {
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#ddd\"/>\n", px(x), top,
                       height - bottom);
    svg += text(px(x), height - bottom + 16, "middle", 12,
                fmt::format("{:.4g}", std::abs(x) < 1e-9 * x_step ? 0.0 : x));
  }
  for (double y = std::ceil(ys.low / y_step) * y_step; y <= ys.high + 1e-9 * y_step; y += y_step) {
    svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"#ddd\"/>\n", left, py(y),
                       width - right);
    svg += text(left - 6, py(y) + 4, "end", 12,
                fmt::format("{:.4g}", std::abs(y) < 1e-9 * y_step ? 0.0 : y));
  }
  svg += text((left + width - right) / 2, height - bottom + 36, "middle", 13, plot.x_label);
  svg += fmt::format("<g transform=\"translate(20 {:.1f}) rotate(-90)\">{}</g>\n",
                     (top + height - bottom) / 2, text(0, 0, "middle", 13, plot.y_label));
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const Series& s = plot.series[k];
    const char* colour = colours[k % colours.size()];
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const bool inside = s.y[i] >= ys.low && s.y[i] <= ys.high;
      if (inside && s.mark == Mark::dots)
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n",
                           px(s.x[i]), py(s.y[i]), colour);
      if (inside)
        path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", px(s.x[i]), py(s.y[i]));
      drawing = inside;
    }
    if (s.mark != Mark::dots)
      svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}/>\n",
                         path, colour, s.mark == Mark::dashed ? " stroke-dasharray=\"6 4\"" : "");
    const double column = left + 345.0 * static_cast<double>(k % 2);
    const double row = height - 72 + 16.0 * static_cast<double>(k / 2);
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"4\" fill=\"{}\"/>\n",
                       column, row - 6, colour);
    svg += text(column + 20, row, "start", 12, s.name);
  }
  svg += text(left, height - 20, "start", 12, "Paper: " + plot.claim);
  svg += text(left, height - 5, "start", 12, "Here: " + plot.measured);
  return svg + "</svg>\n";
}

}  // namespace septet::figures
