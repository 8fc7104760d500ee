#pragma once
/// Due times at an even rate, for what is done with the first frame after each.

#include <optional>

namespace septet::screen {

class EvenTimes {
 public:
  explicit EvenTimes(double every_s) : every_s_(every_s) {}

  bool is_due(double now_s) const { return !due_s_ || now_s >= *due_s_; }
  /// It is done now. The next time counts from the one before, not from now: late frames do not lower the rate. After a
  /// second of standstill it counts anew.
  void done(double now_s) {
    constexpr double caught_up_within_s = 1.0;
    due_s_ = (due_s_ && now_s - *due_s_ < caught_up_within_s ? *due_s_ : now_s) + every_s_;
  }
  void reset() { due_s_.reset(); }

 private:
  double every_s_;
  std::optional<double> due_s_;
};

}  // namespace septet::screen
