#include "engine/document/chart_page.hpp"

#include <string_view>

#include <fmt/core.h>

#include "engine/document/markup.hpp"

namespace septet::document {
namespace {

constexpr double margin = 10.0, row = 20.0, notes_width = 330.0;

constexpr std::string_view style = R"css(
text { font: 12px 'DejaVu Sans', sans-serif; fill: #555 }
.page-title { font-size: 20px; font-weight: bold; fill: #222 } .words { font-size: 13px; fill: #222 }
.title { font-size: 14px; font-weight: bold; fill: #222 }
.unit, .y-tick { text-anchor: end } .x-tick, .x-label { text-anchor: middle }
.grid { stroke: #ddd; fill: none } .axis { stroke: #777; fill: none }
.line { stroke: #0b5fa5; stroke-width: 1.8; fill: none; stroke-linejoin: round } .dashed { stroke-dasharray: 6 4 } .dots { fill: #0b5fa5 }
.line.s1 { stroke: #c8402a } .line.s2 { stroke: #2d8a4e } .line.s3 { stroke: #7b4ba0 } .line.s4 { stroke: #b8860b }
.dots.s1 { fill: #c8402a } .dots.s2 { fill: #2d8a4e } .dots.s3 { fill: #7b4ba0 } .dots.s4 { fill: #b8860b }
)css";

}  // namespace

std::string to_svg(const ChartPage& page) {
  const bool alone = page.charts.size() == 1;
  const double chart_width = alone ? 740.0 : 470.0, chart_height = alone ? 430.0 : 280.0;
  const double head = 44.0 + row * static_cast<double>(page.lines.size()), columns = alone ? 1.0 : 2.0;
  const double notes_at = margin + columns * chart_width + margin;
  const double width = page.notes.empty() ? notes_at : notes_at + notes_width;
  const std::size_t chart_rows = (page.charts.size() + 1) / 2;
  const double height = head + static_cast<double>(chart_rows) * chart_height + margin;
  const auto text = [](std::string_view css_class, double x, double y, std::string_view words) {
    return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", css_class, x, y, escaped(words));
  };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n<style>{2}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height, style);
  svg += text("page-title", 2 * margin, 30.0, page.title);
  for (std::size_t n = 0; n < page.lines.size(); ++n)
    svg += text("words", 2 * margin, 51.0 + row * static_cast<double>(n), page.lines[n]);
  for (std::size_t n = 0; n < page.charts.size(); ++n) {
    const std::size_t chart_column = n % 2, chart_row = n / 2;
    svg += drawn(page.charts[n], {margin + chart_width * static_cast<double>(chart_column),
                                  head + chart_height * static_cast<double>(chart_row), chart_width, chart_height});
  }
  for (std::size_t n = 0; n < page.notes.size(); ++n)
    svg += text("words", notes_at, head + 24.0 + 24.0 * static_cast<double>(n), page.notes[n]);
  return svg + "</svg>\n";
}

}  // namespace septet::document
