#pragma once
/// Whether the operator has told the server to go: Enter, or the line "go", on its standard input.

#include <string>

namespace septet::server {

class GoWord {
 public:
  /// Reads what has come, without waiting. Once said it stays said.
  bool said();

 private:
  bool said_ = false, closed_ = false;
  std::string line_;
};

}  // namespace septet::server
