#pragma once
/// Choices for a drive on the page, and a choice made.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace septet::page {

/// A name with a sentence about it.
struct Choice {
  std::string name, about;
  std::string title;    ///< Title for people: of a lesson, an experiment; else empty.
  bool is_own = false;  ///< True: the name is a user's file; false: one of Septet's own names.
};
struct ScenarioChoice : Choice {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Name and the scenario's default value.
  bool is_lesson = false, is_game = false;
};
/// A questionnaire that can be answered after a drive.
struct QuestionnaireItemChoice {
  std::string id, text;
  int least = 0, most = 0;
  std::vector<std::string> labels;  ///< From least to most; may be empty.
};
struct QuestionnaireChoice : Choice {
  std::vector<QuestionnaireItemChoice> items;
};
/// The lists that a drive is chosen from, and the questionnaires after it.
struct Choices {
  std::vector<ScenarioChoice> scenarios;
  std::vector<Choice> rigs, drivers, vehicles, experiments;
  std::vector<QuestionnaireChoice> questionnaires;
  std::string first_rig;  ///< Default rig; empty: Septet's own choice.
};

/// A chosen drive. Texts are printable; an empty one leaves the choice to scenario and rig.
struct DriveChoice {
  std::string scenario, rig;
  std::string driver;  ///< A simulated one; empty: the rig's, a person as a rule.
  std::string vehicle;
  std::string participant, group, condition, order, note;
  std::string seed, seconds;  ///< Numbers, parsed by the command line as if typed.
  /// Scenario parameters that differ from their defaults.
  std::vector<std::pair<std::string, std::string>> parameters;
  bool start_now = false;  ///< Does not wait for a person to take the controls.
  std::string experiment;  ///< Experiment whose next drive is wanted; the participant's, if one is named.
};

/// A lesson's task in a past drive.
struct PastTask {
  std::string says;
  std::optional<double> mark;  ///< 0 to 10; empty: no occasion.
  std::string severity;        ///< "none", "minor", "serious", "dangerous".
};

/// A drive of the past.
struct PastSession {
  std::uint64_t id = 0;  ///< Identity of the session while the program lasts.
  std::string folder;    ///< Relative to the folder of all drives.
  std::string started_utc, scenario, rig, driver, participant, ended, note;
  double simulated_s = 0.0;
  bool has_report = false, has_debrief = false, has_film = false;
  std::vector<std::string> answered;  ///< Names of its answers: "paper", "ssq-before".
  std::string lesson;                 ///< Title of the lesson, if the drive was one; else empty.
  std::optional<double> mark;  ///< Mark of the lesson, 0 to 10; empty: too short to be marked, or without an occasion.
  bool is_taken = false, is_passed = false;
  std::vector<PastTask> tasks;
  std::optional<double> points;  ///< Points of a game, and the level reached.
  int level = 0;
};

}  // namespace septet::page
