#pragma once
/// A diagram of curves as an SVG file.

#include <string>
#include <vector>

namespace septet::figures {

enum class Mark { line, dashed, dots };

struct Series {
  std::string name;
  Mark mark = Mark::line;
  std::vector<double> x, y;
};

struct Plot {
  std::string title, x_label, y_label;
  std::string claim;     ///< What the paper says.
  std::string measured;  ///< What came out here.
  std::vector<Series> series;
  double y_low = 0.0, y_high = 0.0;  ///< Equal: as the series need it.
};

/// The diagram, 760 by 520 points; points outside the axes are left out.
std::string to_svg(const Plot& plot);

}  // namespace septet::figures
