#include "sim-server/command/film_command.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/core.h>

#include "sim-server/child_process.hpp"

namespace septet::server {

int run_film(std::vector<std::string> arguments) {
  std::string program = (program_folder() / "septet-film").string();
  std::vector<char*> argv{program.data()};
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  fmt::print(stderr, "septet: {}\n", describe({std::strerror(errno), program, "check that it lies beside septet"}));
  return 1;
}

}  // namespace septet::server
