#include "logging/study/report/group_words.hpp"

#include <cmath>

#include <fmt/core.h>

#include "engine/document/markup.hpp"
#include "logging/study/measures/order_statistics.hpp"
#include "logging/study/statistics/compare.hpp"

namespace septet::logging {
namespace {

/// Four digits, and all of them before the point.
std::string figure_text(double value) {
  return std::abs(value) >= 1e4 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

}  // namespace

std::string framed(const std::string& svg, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, document::escaped(caption));
}

std::string name_of_group(const std::string& group) { return group.empty() ? "no group" : group; }

std::string spread_text(const std::vector<double>& values) {
  if (values.empty()) return "–";
  const MeanAndSpread spread = summarise(values);
  return fmt::format("{} ± {}; {} [{}, {}] ({})", figure_text(spread.mean), figure_text(spread.sd),
                     figure_text(*median(values)), figure_text(*quantile(values, 0.25)),
                     figure_text(*quantile(values, 0.75)), values.size());
}

}  // namespace septet::logging
