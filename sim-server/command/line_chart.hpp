#pragma once
/// Line charts as SVG text: enough for four curves on a page, with axes that a reader can read off.

#include <string>
#include <utility>
#include <vector>

namespace septet::server {

struct LineChart {
  std::string x_label, y_label;
  std::vector<std::pair<double, double>> points;  ///< Joined in this order.
};

/// Charts two by two under a title, notes in a column on the right.
std::string chart_page_svg(const std::string& title, const std::string& subtitle,
                           const std::vector<LineChart>& charts,
                           const std::vector<std::string>& notes);

}  // namespace septet::server
