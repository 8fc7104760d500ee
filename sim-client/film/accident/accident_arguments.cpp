#include "sim-client/film/accident/accident_arguments.hpp"

#include <string>

#include "program/command_line.hpp"
#include "sim-client/film/film_arguments.hpp"
#include "sim-client/film/film_program.hpp"

namespace septet::film {

void add_accident_options(CLI::App& app, AccidentOptions& options) {
  FilmOptions& film = options.film;
  app.add_option("session", film.session, "Session file of a drive; with --check where it lies now")->default_str("");
  app.add_option("--event", options.event, "Number of the contact, from 1 on, by time")
      ->check(CLI::Range(1u, 1'000'000u))
      ->default_str("the first; without one the nearest approach");
  app.add_option("--out", film.out, "New or empty folder for film, subtitles, stills, page and manifest")
      ->default_str("accident, beside the session");
  app.add_option("--plan", options.plan, "Write the storyboard there, as a script of septet film --shots, and stop")
      ->default_str("none: make the film");
  app.add_option("--fps", film.frames_per_second, "Frames a second")
      ->check(program::number_between(1.0, 1000.0))
      ->capture_default_str();
  app.add_option("--size", "Of the picture, in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->default_str("1280x720")
      ->each([&film](const std::string& text) {
        if (const auto problem = read_size(text, film); !problem.empty()) throw CLI::ValidationError(problem);
      });
  app.add_flag_callback(
      "--no-sound", [&film] { film.sound = false; }, "Leave out what the driver heard");
  app.add_option_function<std::string>(
         "--renderer", [&film](const std::string& name) { film.renderer = renderer_named(name); },
         "raster, or traced: light follows paths, on all cores; slow")
      ->check(CLI::IsMember({"raster", "traced"}))
      ->default_str("raster");
  app.add_option("--samples", film.samples, "Of a pixel that is traced: four times as many halve the noise")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  app.add_flag("--denoise", film.denoise, "Take the noise out of what is traced");
  app.add_flag("--resume", film.resume, "Go on with a film that was stopped: what is drawn is not drawn again");
  app.add_flag("--software", film.software, "Draw without a graphics card, pixel for pixel as off-screen screens do");
  app.add_option("--voice", options.voice,
                 "Command of a narrator, run by the shell for each subtitle: reads $WORDS, writes a WAV file, $WAV")
      ->type_name("COMMAND")
      ->default_str("none");
  app.add_option("--check", options.check,
                 "Compare the film in this folder with its manifest and its session, and draw three frames again")
      ->default_str("none: make a film");
}

}  // namespace septet::film
