#include "command-line/command/other_program.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "program/child_process.hpp"

namespace septet::server {

Expected<int> become(const std::string& name, std::vector<std::string> arguments) {
  std::string program = (program::own_folder() / name).string();
  std::vector<char*> argv{program.data()};
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  return failure(std::strerror(errno), program, "check that it lies beside septet");
}

}  // namespace septet::server
