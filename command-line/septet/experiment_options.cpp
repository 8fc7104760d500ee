#include "command-line/septet/options.hpp"
#include "program/command_line.hpp"

namespace septet::server {

void add_experiment_commands(CLI::App& app, Options& options) {
  auto* experiment = app.add_subcommand(
      "experiment", "Run an experiment with simulated subjects, or go on with it; for people, next says who is next");
  const auto add_common = [&](CLI::App& command) {
    command.add_option("--out", options.experiment.out, "Folder for drives and results")->default_str("out/NAME");
    command.add_option("--only", options.experiment.only, "This participant alone")->default_str("");
  };
  experiment->add_option("file", options.experiment.file, "TOML file, or ambulance-24 (docs/experiments.md)");
  add_common(*experiment);
  experiment->add_option("--jobs", options.experiment.jobs, "Drives at once")
      ->default_str("as many as there are processors")
      ->check(CLI::Range(1, 1024));
  experiment
      ->add_option("--ranks", options.experiment.ranks,
                   "Programs of mpirun that share the work (docs/experiments.md); 1 to 1024")
      ->default_str("this program alone, or one for each host")
      ->check(CLI::Range(1, 1024));
  experiment->add_option("--hosts", options.experiment.hosts, "File with the machines that drive, one a line")
      ->default_str("this machine");
  experiment->add_flag("--one-of-ranks", options.experiment.one_of_ranks)->group("");
  auto* next =
      experiment->add_subcommand("next", "Print the next participant, their drive, its command, and missing answers");
  next->add_option("file", options.experiment.file, "TOML file, or ambulance-24")->required();
  add_common(*next);
  experiment->callback([&, experiment, next] {
    if (next->parsed()) return;
    if (options.experiment.file.empty()) throw CLI::RequiredError(experiment->get_name() + ": file");
    options.work = [&] { return run_experiment(options.experiment); };
  });
  next->callback([&] { options.work = [&] { return run_experiment_next(options.experiment); }; });
}

}  // namespace septet::server
