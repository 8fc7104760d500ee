#pragma once
/// Charts as inline SVG, for a page that brings the style (report_page.cpp): classes `axis`,
/// `grid`, `line`, `bar`, `mark`, …

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace septet::logging {

struct Point {
  double x = 0.0, y = 0.0;  ///< A y that is not finite interrupts the line.
};

/// A moment to mark in a line chart.
struct Mark {
  double x = 0.0;
  std::string label;  ///< One character or two.
  std::string tip;    ///< Shown by the browser over the mark.
};

struct LineChart {
  std::string title, x_label, y_label;
  std::vector<Point> line;  ///< Ascending x.
  std::vector<Mark> marks;
  std::vector<Point> band_low,
      band_high;  ///< A shaded band behind the line, edges with the same x.
  double y_low = 0.0, y_high = 1.0;
};

/// A chart of 960 × 260 units that scales with the page. Long lines are thinned to the lowest and
/// highest value of each column of the picture, so that no peak is lost.
std::string to_svg(const LineChart& chart);

struct Bar {
  double from = 0.0, to = 0.0;  ///< On the x axis.
  double value = 0.0;
  bool emphasised = false;
  std::string tip;
};

struct BarChart {
  std::string title, x_label, y_label;
  std::vector<Bar> bars;
  double x_low = 0.0,
         x_high = 1.0;  ///< The axis runs from x_low at the left; x_low > x_high mirrors it.
  std::vector<std::pair<double, std::string>> x_ticks;
};

std::string to_svg(const BarChart& chart);

/// Round numbers in [low, high], about `count` of them.
std::vector<double> round_ticks(double low, double high, int count);

/// Text as HTML shows it: & < > " escaped.
std::string escaped(std::string_view text);

}  // namespace septet::logging
