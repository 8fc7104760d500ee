#include <cmath>
#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>

#include "engine/document/chart_page.hpp"

namespace septet::document {
namespace {

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("ticks are round numbers within the range and a round range holds it") {
  CHECK(round_ticks({0, 100}, 5) == std::vector<double>{0, 20, 40, 60, 80, 100});
  CHECK(round_ticks({-2, 2}, 5) == std::vector<double>{-2, -1, 0, 1, 2});
  CHECK(round_ticks({0, 10}, 4) == std::vector<double>{0, 2.5, 5, 7.5, 10});
  CHECK(round_ticks({3, 3}, 5) == std::vector<double>{3});
  const Range range = round_range({-0.13, 0.71}, 5);
  CHECK(range.low == doctest::Approx(-0.2));
  CHECK(range.high == doctest::Approx(0.8));
  const Range point = round_range({7, 7}, 5);
  CHECK(point.low < 7);
  CHECK(point.high > 7);
}

TEST_CASE("a tick's label tells it from its neighbours and zero has no sign") {
  const std::vector<double> ticks{-0.25, 0.0, 0.25};
  CHECK(tick_label(-0.25, ticks) == "-0.25");
  CHECK(tick_label(-1e-17, ticks) == "0.00");
  CHECK(tick_label(40, {20, 40}) == "40");
}

TEST_CASE("a line of many samples is thinned and keeps its highest and its lowest peak") {
  LineChart chart;
  chart.series.emplace_back();
  for (int i = 0; i < 100000; ++i) chart.series[0].points.push_back({static_cast<double>(i), 0.0});
  chart.series[0].points[54321].y = 1.0;
  chart.series[0].points[12345].y = -1.0;
  chart.y = {-1.0, 1.0};
  const std::string svg = to_svg(chart);
  CHECK(svg.size() < 60000);
  const auto begin = svg.find("class=\"line\"");
  REQUIRE(begin != std::string::npos);
  const std::string line = svg.substr(begin, svg.find("/>", begin) - begin);
  CHECK(count_of(line, " 38.0") == 1);  // The plot's upper edge is at y = 38.
  CHECK(count_of(line, " 38.0L") + count_of(line, " 38.0M") == 1);
  chart.series[0].points[12345].y = 0.0;
  const std::string without = to_svg(chart);
  CHECK(count_of(line, "L") > count_of(without.substr(without.find("class=\"line\""), line.size()), "L"));
}

TEST_CASE("a line is interrupted where it is not finite or leaves the chart") {
  LineChart chart;
  chart.series = {{"", {{0, 0}, {1, 1}, {2, std::nan("")}, {3, 1}, {4, 9}, {5, 0}}}};
  chart.y = {0.0, 2.0};
  const std::string svg = to_svg(chart);
  const auto begin = svg.find("class=\"line\" d=\"");
  REQUIRE(begin != std::string::npos);
  CHECK(count_of(svg.substr(begin, svg.find("/>", begin) - begin), "M") == 3);
}

TEST_CASE("a page holds its charts side by side with a legend where there are several series and any text") {
  LineChart one, two;
  one.series = {{"", {{0, 0}, {1, 2}}}};
  two.series = {{"a < b", {{0, 0}, {1, 2}}},
                {"points", {{0, 1}, {1, 1}}, Stroke::dots},
                {"theory", {{0, 2}, {1, 0}}, Stroke::dashed}};
  two.x_label = "time, s";
  const std::string svg =
      to_svg(ChartPage{.title = "R & D", .lines = {"\"quoted\""}, .charts = {one, two}, .notes = {"mass: 1 kg"}});
  for (const char* part : {"R &amp; D", "&quot;quoted&quot;", "a &lt; b", "mass: 1 kg", "class=\"line dashed s2\"",
                           "class=\"dots s1\"", "time, s"}) {
    CAPTURE(part);
    CHECK(svg.find(part) != std::string::npos);
  }
  CHECK(count_of(svg, "class=\"legend\"") == 3);
  CHECK(count_of(svg, "<svg") == 1);
  if (const char* keep = std::getenv("SEPTET_KEEP_CHART")) std::ofstream(keep) << svg;
}

TEST_CASE(
    "a chart whose height means nothing has no numbers at its side, and points keep off the frame that is given") {
  LineChart chart;
  chart.series = {{"", {{1.0, 1.0}, {2.0, 1.0}}, Stroke::dots}};
  chart.y = {0.0, 1.5};
  const std::string with = to_svg(chart);
  CHECK(with.find("y-tick") != std::string::npos);
  chart.y_ticks.emplace();
  chart.x = {0.5, 2.5};
  const std::string without = to_svg(chart);
  CHECK(without.find("y-tick") == std::string::npos);
  CHECK(without.find("x-tick") != std::string::npos);
  const auto first_x = [](const std::string& svg) { return std::stod(svg.substr(svg.find("cx=\"") + 4)); };
  CHECK(first_x(without) > first_x(with) + 100.0);
  chart.y_ticks = {1.0};
  const std::string one = to_svg(chart);
  CHECK(one.find("y-tick") == one.rfind("y-tick"));
}

}  // namespace septet::document
