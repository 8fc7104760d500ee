/// `septet-film`: a recorded session to the pictures of a film, the queue of films that wait, and the film of an
/// accident. `septet film` starts it, and `septet accident` with the word `accident` before all others.

#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "program/console.hpp"
#include "sim-client/film/accident/accident_arguments.hpp"
#include "sim-client/film/film_arguments.hpp"
#include "sim-client/film/film_frames.hpp"
#include "sim-client/film/film_program.hpp"
#include "sim-client/film/queue/queue_commands.hpp"
#include "sim-client/film/traced/ranks.hpp"

namespace {

using namespace septet;

/// An invalid film is reported now, and not when its turn comes.
Expected<int> queue(const film::QueueArguments& arguments) {
  if (arguments.film.empty()) return film::queue_film(arguments, {});
  CLI::App app("", "septet film queue");
  film::FilmArguments film;
  film::add_film_options(app, film);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("septet: septet film queue: {}; septet film --help shows a film's options\n", error.what());
  });
  const auto parse = [&] { app.parse(std::vector<std::string>(arguments.film.rbegin(), arguments.film.rend())); };
  return program::run("septet", app, parse, [&]() -> Expected<int> {
    if (auto settled = film::settle(app, film); !settled) return tl::unexpected(settled.error());
    if (const auto frames = film::FilmFrames::open(film.film); !frames) return tl::unexpected(frames.error());
    return film::queue_film(arguments, film.film.out);
  });
}

/// `septet accident`: a command of its own to those who type it.
int accident(int argc, char** argv) {
  film::AccidentOptions options;
  CLI::App app{"Plan and make the film of a contact, from the log alone, or check one (docs/accident.md).",
               "septet accident"};
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("septet: {}; septet accident --help shows the options\n", error.what());
  });
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  film::add_accident_options(app, options);
  return program::run("septet", app, argc, argv, [&] { return film::run_accident(options); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && argv[1] == std::string_view("accident")) return accident(argc - 1, argv + 1);
  film::FilmArguments arguments;
  film::QueueArguments of_queue;
  CLI::App app{
      "Turn a recorded session into a folder of numbered pictures, or a film, seen by the cameras of a script.\n"
      "Without --shots: the driver's eyes, once round the driver's car, and the eyes of whoever is nearest then.\n"
      "FILM.md in sim-client/film describes the script; this is one:\n\n"
      "  [[shot]]\n  from_s = 2.0\n  to_s = 6.0\n  participant = \"ambulance\"  # or \"driver\", \"nearest\", an id\n"
      "  distance_m = 9.0           # 0: through their eyes\n  heading_deg = 150.0        # looks back at it\n"
      "  pitch_deg = -12.0\n  [[shot.turn]]              # half of the way round, speeding up\n  heading_deg = 10.0\n"
      "  sigma = 1.0\n",
      "septet film"};
  app.failure_message([](const CLI::App* self, const CLI::Error& error) {
    const std::vector<CLI::App*> chosen = self->get_subcommands();
    return fmt::format("septet: {}; septet film{} --help shows the options\n", error.what(),
                       chosen.empty() ? "" : " " + chosen.front()->get_name());
  });
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  film::add_film_options(app, arguments);
  const auto add_folder = [&](CLI::App* command) {
    command->add_option("--queue", of_queue.folder, "Folder of the queue")
        ->default_str("septet/films in ~/.local/state");
  };
  CLI::App* const queue_command = app.add_subcommand(
      "queue",
      "Add a film, by the options of septet film, to those that are made one after another, and go on with them");
  add_folder(queue_command);
  queue_command->prefix_command();
  queue_command->add_flag("--make", of_queue.make)->group("");  // Set by start_making_films alone.
  CLI::App* const status_command = app.add_subcommand("status", "Tell how far the films of the queue are");
  add_folder(status_command);
  CLI::App* const cancel_command =
      app.add_subcommand("cancel", "Take films out of the queue, also one that is being made");
  add_folder(cancel_command);
  cancel_command->add_option("number", of_queue.numbers, "As septet film status tells")->required();
  return film::run_alone_or_by_mpirun([&](film::Machines* others) {
    const int status = program::run("septet", app, argc, argv, [&]() -> Expected<int> {
      of_queue.film = queue_command->remaining();
      if (*queue_command) return queue(of_queue);
      if (*status_command) return film::show_queue(of_queue);
      if (*cancel_command) return film::cancel_films(of_queue);
      if (auto settled = film::settle(app, arguments); !settled) return tl::unexpected(settled.error());
      return film::run_film(arguments, {argv + 1, argv + argc}, others);
    });
    if (arguments.one_of_ranks) program::announce(film::last_words + std::to_string(status));
    return status;
  });
}
