#include <iostream>

#include "command-line/septet/options.hpp"
#include "program/command_line.hpp"
#include "program/confinement.hpp"

namespace septet::server {

void add_session_commands(CLI::App& app, Options& options) {
  auto* session =
      app.add_subcommand("session", "Who takes part in a session; additions to it after the drive, and removals");
  session->require_subcommand(1);

  auto* participants = session->add_subcommand(
      "participants", "Who takes part: number, name in the scenario, kind, model, from when to when");
  participants->add_option("session", options.participants.session, "Session file")->required();
  participants->add_flag("--json", options.participants.json, "One JSON array instead of lines");
  participants->callback([&] {
    options.work = [&] {
      program::write_only_below({});
      return run_session_participants(options.participants, std::cout);
    };
  });

  auto* answer = session->add_subcommand("answer", "A questionnaire: asks its items, or takes the answers from a file");
  answer->add_option("session", options.answer.session, "Session file")->required();
  answer->add_option("questionnaire", options.answer.questionnaire, "TOML file, or paper or ssq (docs/experiments.md)")
      ->required();
  answer->add_option("--answers", options.answer.answers, "TOML file with ITEM = NUMBER; without it they are asked")
      ->default_str("");
  answer->add_option("--as", options.answer.as, "Name of the answers: ssq-before, ssq-after")
      ->default_str("the questionnaire's id");
  answer->callback([&] { options.work = [&] { return run_session_answer(options.answer, std::cin, std::cout); }; });

  auto* stop = session->add_subcommand("stop", "The driver has dropped out: so long observed, and why");
  stop->add_option("session", options.stop.session, "Session file")->required();
  stop->add_option("--reason", options.stop.reason, "In their words")->required();
  stop->add_option("--at", options.stop.at_s, "Simulated second")
      ->default_str("the session's end")
      ->check(program::number_between(0.0, 1e6));
  stop->callback([&] { options.work = [&] { return run_session_stop(options.stop); }; });

  auto* forget = session->add_subcommand(
      "forget", "Take a participant out of sessions: code, note, own columns and reasons; what was measured stays");
  forget->add_option("participant", options.forget.participant, "Their code")->required();
  forget->add_option("places", options.forget.places, "Sessions, or folders with sessions below")->required();
  forget->add_flag("--delete", options.forget.delete_data, "Delete their drives instead");
  forget->callback([&] { options.work = [&] { return run_session_forget(options.forget); }; });
}

}  // namespace septet::server
