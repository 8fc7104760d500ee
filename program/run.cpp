#include "program/run.hpp"

#include <exception>
#include <string>

#include "program/console.hpp"
#include "program/stop_signal.hpp"

namespace septet::program {

int run(std::string_view name, const std::function<Expected<int>()>& work) {
  survive_failed_writes();
  std::string wrong;
  try {
    const auto status = work();
    if (status) return *status;
    wrong = describe(status.error());
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  say(std::string(name) + ": " + wrong);
  return failed_status;
}

}  // namespace septet::program
