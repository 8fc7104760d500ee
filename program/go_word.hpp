#pragma once
/// Commands on a program's standard input: to go (Enter, or the line "go"), and to let fan, shaker and wheel force run
/// again (the line "rearm").

#include <string>

namespace septet::program {

class GoWord {
 public:
  /// Reads pending input, without waiting. True from then on.
  bool said();
  /// Each "rearm" once.
  bool take_rearm();

 private:
  void read();
  bool said_ = false, rearm_ = false, closed_ = false;
  std::string line_;
};

}  // namespace septet::program
