#include "engine/simulation/deviation_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/document/table_line.hpp"

namespace septet::simulation {
namespace {

constexpr std::array shares{&MotionValues::time_s,      &MotionValues::x_m,       &MotionValues::y_m,
                            &MotionValues::heading_rad, &MotionValues::speed_mps, &MotionValues::yaw_rate_radps};

}  // namespace

std::string deviation_text(const MotionDeviation& deviation) {
  std::string text;
  for (double MotionValues::*value : shares)
    text += fmt::format("{}{}", text.empty() ? "" : " ", deviation.share.*value);
  return text;
}

Expected<MotionDeviation> read_deviation(std::string_view text, std::string_view where) {
  MotionDeviation deviation;
  std::size_t read = 0;
  for (std::string_view rest = text; !rest.empty(); ++read) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    const auto number = document::number_in<double>(word);
    if (read == shares.size() || !number || !(*number >= -1.0 && *number <= 1.0)) break;
    deviation.share.*shares[read] = *number;
    if (rest.empty() && read + 1 == shares.size()) return deviation;
  }
  return failure(fmt::format("\"{}\" are not six shares of −1 to 1", printable(text)), std::string(where),
                 "use an unaltered copy");
}

}  // namespace septet::simulation
