#pragma once
/// Charts as an SVG file that stands by itself.

#include <string>
#include <vector>

#include "engine/document/chart.hpp"

namespace septet::document {

struct ChartPage {
  std::string title;
  std::vector<std::string> lines;  ///< Below the title.
  std::vector<LineChart> charts;   ///< Two by two; one by itself is larger.
  std::vector<std::string> notes;  ///< In a column on the right.
};

std::string to_svg(const ChartPage& page);

}  // namespace septet::document
