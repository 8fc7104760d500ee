#pragma once
/// What can be chosen for a drive on the page, and what was.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace septet::page {

/// Something by its name, with a sentence about it.
struct Choice {
  std::string name, about;
};
struct ScenarioChoice : Choice {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Name and the scenario's own value.
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
  std::vector<Choice> rigs, drivers, vehicles;
  std::vector<QuestionnaireChoice> questionnaires;
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
};

/// A drive of the past.
struct PastSession {
  std::uint64_t id = 0;  ///< Of the session as long as the program lasts.
  std::string folder;    ///< As it is called below the folder of all drives.
  std::string started_utc, scenario, rig, driver, participant, ended;
  double simulated_s = 0.0;
  bool has_report = false, has_debrief = false;
  std::vector<std::string> answered;  ///< What answers are called that it holds: "paper", "ssq-before".
};

}  // namespace septet::page
