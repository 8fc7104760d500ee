#pragma once
/// Checks of every program's command line beyond CLI11's own.

#include <charconv>
#include <cstdint>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "program/run.hpp"

namespace septet::program {

/// A number from `least` to `most`. CLI11's Range lets "nan" pass.
inline CLI::Validator number_between(double least, double most) {
  const std::string bounds = fmt::format("[{:g} - {:g}]", least, most);
  return {[=](std::string& text) -> std::string {
            double number = 0.0;
            if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return {};
            return fmt::format("{} is not a number in {}", text, bounds);
          },
          "FLOAT in " + bounds};
}

/// A whole number of 64 bits without a sign. CLI11 turns "-1", and all numbers beyond the range, into the largest one.
inline CLI::Validator seed_number() {
  return {[](std::string& text) -> std::string {
            std::uint64_t number = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            if (error == std::errc() && end == text.data() + text.size()) return {};
            return fmt::format("{} is not a whole number from 0 to {}", text, ~std::uint64_t{0});
          },
          ""};
}

/// List of the commands, for a first word that is not among them: the parser's own message does not name that word.
inline std::optional<std::string> commands_instead_of(const CLI::App& app, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  if (word.starts_with('-')) return std::nullopt;
  std::string commands;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_name() == word) return std::nullopt;
    commands += (commands.empty() ? "" : ", ") + command->get_name();
  }
  return commands;
}

/// Throws if a word after an option of `app`, or of the chosen command, is empty, as from an unset shell variable:
/// otherwise it would read as if the option were absent.
inline void refuse_empty_words(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& word : option->results())
      if (word.empty()) throw CLI::ValidationError(option->get_name(), "the word after it is empty");
  for (const CLI::App* command : app.get_subcommands()) refuse_empty_words(*command);
}

/// Reads the command line by `parse`, of `app`, then does the work; returns the exit status. 0 after --help and
/// --version, 2 for a wrong command line.
inline int run(std::string_view name, const CLI::App& app, const std::function<void()>& parse,
               const std::function<Expected<int>()>& work) {
  try {
    parse();
    refuse_empty_words(app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, std::cout, std::cerr) == 0 ? status_after_output(name, 0) : wrong_use_status;
  }
  return run(name, work);
}

/// The same, of the program's own command line.
inline int run(std::string_view name, CLI::App& app, int argc, char** argv,
               const std::function<Expected<int>()>& work) {
  return run(
      name, app, [&] { app.parse(argc, argv); }, work);
}

}  // namespace septet::program
