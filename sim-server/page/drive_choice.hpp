#pragma once
/// What can be chosen for a drive on the page, and what was.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace septet::page {

/// Something by its name, with a sentence about it.
struct Choice {
  std::string name, about;
  std::string title;    ///< As people call it: of a lesson, an experiment; else empty.
  bool is_own = false;  ///< A file of one's own, which the name is; else a name of what Septet came with.
};
struct ScenarioChoice : Choice {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Name and the scenario's own value.
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
/// The lists that a drive is chosen from, and what can be asked after it.
struct Choices {
  std::vector<ScenarioChoice> scenarios;
  std::vector<Choice> rigs, drivers, vehicles, experiments;
  std::vector<QuestionnaireChoice> questionnaires;
  std::string first_rig;  ///< The one that is meant where no other is chosen; empty: Septet's own choice.
};

/// A drive as it was chosen. Texts are printable; an empty one leaves the choice to scenario and rig.
struct DriveChoice {
  std::string scenario, rig;
  std::string driver;  ///< A simulated one; empty: whom the rig names, a person as a rule.
  std::string vehicle;
  std::string participant, group, condition, order, note;
  std::string seed, seconds;  ///< Numbers, which the command line reads as a person's.
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Of the scenario, other than its own.
  bool start_now = false;                                       ///< Does not wait for a person to take the controls.
  std::string
      experiment;  ///< Whose next drive it is, which the experiment chooses; the participant's, if one is named.
};

/// A task of a lesson that was driven.
struct PastTask {
  std::string says;
  std::optional<double> mark;  ///< 0 to 10; nothing: not seen.
  std::string severity;        ///< "none", "minor", "serious", "dangerous".
};

/// A drive of the past.
struct PastSession {
  std::uint64_t id = 0;  ///< Of the session as long as the program lasts.
  std::string folder;    ///< As it is called below the folder of all drives.
  std::string started_utc, scenario, rig, driver, participant, ended, note;
  double simulated_s = 0.0;
  bool has_report = false, has_debrief = false, has_film = false;
  std::vector<std::string> answered;  ///< What answers are called that it holds: "paper", "ssq-before".
  std::string lesson;                 ///< Its title, where the drive was one; else empty.
  std::optional<double> mark;         ///< Of the lesson, 0 to 10; nothing: too short to be marked, or nothing was seen.
  bool is_taken = false, is_passed = false;
  std::vector<PastTask> tasks;
  std::optional<double> points;  ///< Of a game, and the level that was reached.
  int level = 0;
};

}  // namespace septet::page
