#pragma once
/// A display without a monitor, for the programs that open windows.

#include <map>
#include <string>

#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

/// An Xvfb on a display number of its own choice; it ends with this object.
class XDisplay {
 public:
  XDisplay() : server_(start_server()) {
    const auto number = server_.read_line(60s);
    REQUIRE(number.has_value());
    name_ = ":" + *number;
  }
  std::map<std::string, std::string> environment() const { return {{"DISPLAY", name_}}; }

 private:
  static server::ChildProcess start_server() {
    auto process = server::ChildProcess::start({.program = "/usr/bin/Xvfb",
                                                .arguments = {"-displayfd", "1", "-screen", "0", "640x480x24", "-nolisten", "tcp"},
                                                .environment = {},
                                                .log = "/dev/null"});
    REQUIRE(process.has_value());
    return std::move(*process);
  }

  server::ChildProcess server_;
  std::string name_;
};

}  // namespace septet::pipeline
