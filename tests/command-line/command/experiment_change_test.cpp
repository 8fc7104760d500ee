#include "command-line/command/experiment_change.hpp"

#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "program/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

std::string experiment_text(int seconds, int subjects, int seed = 1) {
  return fmt::format(
      "seed = {}\n[[group]]\nname = \"g\"\nsubjects = {}\n"
      "[[part]]\nname = \"p\"\nscenario = \"motorway-ambulance\"\nseconds = {}\n",
      seed, subjects, seconds);
}

/// Why the folder of that earlier text is not this experiment's; empty: it is.
std::string refusal(const Study& study, const std::string& earlier_text) {
  const auto checked = check_same_drives(study, earlier_text);
  return checked ? std::string() : checked.error().what;
}

}  // namespace

TEST_CASE("what somebody has driven may not change, forgotten or not, and everything else of an experiment may") {
  const auto temporary = program::TemporaryFolder::make("septet-experiment").value();
  const auto folder = temporary.path() / "out";
  std::filesystem::create_directory(folder);
  const std::string text = experiment_text(10, 3);
  const auto experiment = logging::read_experiment(text, "experiment.toml");
  REQUIRE_MESSAGE(experiment.has_value(), why_not(experiment));
  const Study study{*experiment, text, "experiment", logging::plan_of(*experiment), folder, {}};
  CHECK(refusal(study, experiment_text(11, 3, 2)) == "");  // Nobody has driven yet.
  REQUIRE(note_forgotten(folder, "P02").has_value());
  CHECK(refusal(study, text) == "");
  CHECK(refusal(study, experiment_text(10, 2)) == "");  // A third subject is new.
  CHECK(refusal(study, experiment_text(11, 3))
            .ends_with("P02/p-01 was driven with --seconds 11.000, and would be with 10.000"));
  CHECK(refusal(study, experiment_text(10, 3, 2)).find("P02/p-01 was driven with --seed ") != std::string::npos);
  CHECK(refusal(study, "no experiment").ends_with("cannot be read"));
  const auto one = logging::read_experiment(experiment_text(10, 1), "experiment.toml");
  REQUIRE(one.has_value());
  CHECK(refusal({*one, text, "experiment", logging::plan_of(*one), folder, {}}, text)
            .ends_with("P02/p-01 was driven, and is not in it"));
}

}  // namespace septet::server
