#include <iostream>

#include "command-line/septet/options.hpp"
#include "program/command_line.hpp"
#include "program/confinement.hpp"
#include "program/machines.hpp"

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

  auto* what_if = app.add_subcommand(
      "what-if", "A session again with a change of its driver's inputs: what would have followed (docs/what-if.md)");
  what_if->add_option("session", options.what_if.session, "Session file")->required();
  what_if
      ->add_option("--change", options.what_if.changes,
                   "brake:-0.5s, brake:x1.2, brake:=0.8@12.3s, or a range as brake:-1s..0s/1000; as often as needed")
      ->type_name("INPUT:CHANGE")
      ->default_str("none: the logged inputs again")
      ->allow_extra_args(false);
  what_if
      ->add_option("--runs", options.what_if.runs,
                   "Of a drive with --motion: so many runs, each within the ± of its table (docs/given-motion.md)")
      ->default_str("none")
      ->check(CLI::Range(1, 1'000'000));
  what_if
      ->add_option("--sessions", options.what_if.sessions,
                   "Of these runs, the first so many as sessions too, which septet film --ghost shows together")
      ->default_str("none")
      ->check(CLI::Range(1, 1000));
  what_if->add_option("--from", options.what_if.run.from_s, "Simulated second: collisions before it are passed over")
      ->check(program::number_between(0.0, 1e6));
  what_if
      ->add_option("--seconds", options.what_if.run.seconds, "Simulated seconds to run from the first changed input on")
      ->check(program::number_between(0.1, 3600.0));
  what_if->add_option("--jobs", options.what_if.jobs, "Variants of a range at once")
      ->default_str("as many as there are processors")
      ->check(CLI::Range(1, 1024));
  what_if->add_option("--out", options.what_if.out, "Folder for what-if.csv, and what-if.sqlite or what-if.svg")
      ->default_str("what-if, beside the session");
  what_if->callback([&] {
    options.work = [&] {
      // Programs of mpirun speak through files of Open MPI's own.
      if (!program::number_by_mpirun()) program::write_only_below({what_if_folder(options.what_if)});
      return run_what_if(options.what_if, std::cout);
    };
  });
}

}  // namespace septet::server
