#pragma once
/// Charts as a stand-alone SVG file.

#include <string>
#include <vector>

#include "engine/document/chart.hpp"

namespace septet::document {

struct ChartPage {
  std::string title;
  std::vector<std::string> lines;  ///< Below the title.
  std::vector<LineChart> charts;   ///< Two by two; a single one is larger.
  std::vector<std::string> notes;  ///< In a column on the right.
};

std::string to_svg(const ChartPage& page);

}  // namespace septet::document
