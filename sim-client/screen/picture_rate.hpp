#pragma once
/// Pictures a second of a screen in the recent past, and advice to a driver if they are too few.

#include <deque>
#include <optional>
#include <string>

namespace septet::screen {

class PictureRate {
 public:
  /// Counts a picture shown at this instant of the caller's clock.
  void add(double now_s);
  /// Rate over the last two seconds and at least three pictures; empty before that.
  std::optional<double> per_second() const;

 private:
  std::deque<double> shown_s_;  ///< Ascending.
};

/// Advice in one line; empty if the rate is sufficient.
std::optional<std::string> slowness(const PictureRate& rate, bool drawn_in_software);

}  // namespace septet::screen
