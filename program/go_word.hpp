#pragma once
/// What somebody has told a program on its standard input: to go (Enter, or the line "go"), and to let fan, shaker and wheel force run again (the
/// line "rearm").

#include <string>

namespace septet::program {

class GoWord {
 public:
  /// Reads what has come, without waiting. Once said it stays said.
  bool said();
  /// Each "rearm" once.
  bool take_rearm();

 private:
  void read();
  bool said_ = false, rearm_ = false, closed_ = false;
  std::string line_;
};

}  // namespace septet::program
