#include "sim-server/command/film_command.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "program/child_process.hpp"

namespace septet::server {

Expected<int> run_film(std::vector<std::string> arguments) {
  std::string program = (program::own_folder() / "septet-film").string();
  std::vector<char*> argv{program.data()};
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  return failure(std::strerror(errno), program, "check that it lies beside septet");
}

}  // namespace septet::server
