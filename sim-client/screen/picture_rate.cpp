#include "sim-client/screen/picture_rate.hpp"

#include <fmt/core.h>

namespace septet::screen {
namespace {
constexpr double span_s = 2.0;
constexpr std::size_t least_pictures = 3;
constexpr double enough_per_s = 25.0;  ///< Least rate at which a driver steers by the present and not by the past.
}  // namespace

void PictureRate::add(double now_s) {
  shown_s_.push_back(now_s);
  // The oldest kept picture begins the span.
  while (shown_s_.size() > least_pictures && shown_s_[1] <= now_s - span_s) shown_s_.pop_front();
}

std::optional<double> PictureRate::per_second() const {
  if (shown_s_.size() < least_pictures || shown_s_.back() - shown_s_.front() < span_s) return std::nullopt;
  return static_cast<double>(shown_s_.size() - 1) / (shown_s_.back() - shown_s_.front());
}

std::optional<std::string> slowness(const PictureRate& rate, bool drawn_in_software) {
  const auto per_second = rate.per_second();
  if (!per_second || *per_second >= enough_per_s) return std::nullopt;
  const std::string figure =
      *per_second < 3.0 ? fmt::format("{:.1f}", *per_second) : fmt::format("{:.0f}", *per_second);
  return fmt::format("{} pictures a second: {}", figure,
                     drawn_in_software ? "no GPU found, drawing in software; try --virtual, or fewer pixels in the rig"
                                       : "the GPU is too slow for this picture; try fewer pixels in the rig");
}

}  // namespace septet::screen
