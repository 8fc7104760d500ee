#pragma once
/// Charts as SVG for an HTML page that brings the style (classes `axis`, `grid`, `line`, `bar`, `mark`, …);
/// chart_page.hpp makes a stand-alone file.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/document/chart_axis.hpp"

namespace septet::document {

struct Point {
  double x = 0.0, y = 0.0;  ///< A y that is not finite, or lies outside of the chart, interrupts the line.
};

enum class Stroke { line, dashed, dots };

struct Series {
  std::string name;  ///< Name in the legend, where there are several; an empty one is left out.
  std::vector<Point> points;
  Stroke stroke = Stroke::line;
};

/// A moment to mark in a line chart.
struct Mark {
  double x = 0.0;
  std::string label;  ///< One character or two.
  std::string tip;    ///< Shown by the browser over the mark.
};

struct LineChart {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::vector<Mark> marks;
  std::vector<Point> band_low, band_high;  ///< A shaded band behind the lines, edges with the same x.
  std::optional<Range> x;                  ///< Empty: from the first point to the last.
  std::optional<Range> y;                  ///< Empty: round numbers around the values.
  /// Absent: round numbers; an empty list: the height has no meaning of its own.
  std::optional<std::vector<double>> y_ticks;
};

struct Bar {
  double from = 0.0, to = 0.0;  ///< On the x axis.
  double value = 0.0;
  bool emphasised = false;
  std::string tip;
};

/// A value to compare the bars with.
struct Level {
  double value = 0.0;
  std::string label;
};

struct BarChart {
  std::string title, x_label, y_label;
  std::vector<Bar> bars;
  double x_low = 0.0, x_high = 1.0;  ///< The axis runs from x_low at the left; x_low > x_high mirrors it.
  std::vector<std::pair<double, std::string>> x_ticks;
  std::optional<Level> level = {};
};

/// A chart of 960 × 260 units that scales with the page.
std::string to_svg(const LineChart& chart);
std::string to_svg(const BarChart& chart);

/// Place of a chart within a picture.
struct Place {
  double x = 0.0, y = 0.0, width = 960.0, height = 260.0;
};

/// Content of an `svg` element. Long lines are thinned to the lowest and highest value of each column of the picture,
/// so that no peak is lost.
std::string drawn(const LineChart& chart, const Place& place);

}  // namespace septet::document
