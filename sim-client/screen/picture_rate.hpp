#pragma once
/// How many pictures a second a screen has shown lately, and what to tell a driver for whom they are too few.

#include <deque>
#include <optional>
#include <string>

namespace septet::screen {

class PictureRate {
 public:
  /// A picture was shown at this instant of the caller's clock.
  void add(double now_s);
  /// Over the last two seconds and at least three pictures; nothing before there are as many.
  std::optional<double> per_second() const;

 private:
  std::deque<double> shown_s_;  ///< Ascending.
};

/// One line, or nothing where the rate will do.
std::optional<std::string> slowness(const PictureRate& rate, bool drawn_in_software);

}  // namespace septet::screen
