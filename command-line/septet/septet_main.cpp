/// `septet`: the command people type.

#include <string>

#include <fmt/core.h>

#include "command-line/septet/options.hpp"
#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "program/console.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  CLI::App app{"Septet: a driving simulator that surrounds a real car with seven screens.", "septet"};
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 finished, 1 failed, 2 wrong use, 3 a drive or replay that somebody stopped before its end.");
  app.failure_message([](const CLI::App* self, const CLI::Error& error) {
    std::string command = "septet";
    for (auto chosen = self->get_subcommands(); !chosen.empty(); chosen = chosen.front()->get_subcommands())
      command += " " + chosen.front()->get_name();
    return fmt::format("septet: {}; {} --help shows the options\n", error.what(), command);
  });
  app.option_defaults()->always_capture_default();
  server::Options options;
  if (argc > 2) options.passed_on = {argv + 2, argv + argc};
  server::add_drive_commands(app, options);
  server::add_track_commands(app, options);
  server::add_session_commands(app, options);
  server::add_experiment_commands(app, options);
  server::add_file_commands(app, options);
  if (const auto known = program::commands_instead_of(app, argc, argv)) {
    program::say(fmt::format("septet: there is no command \"{}\"; use one of: {}", argv[1], *known));
    return program::wrong_use_status;
  }
  return program::run("septet", app, argc, argv, [&] { return options.work(); });
}
