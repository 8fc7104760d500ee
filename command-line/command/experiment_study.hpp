#pragma once
/// An experiment's folder: its plan, and how far each subject is by what lies there.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command-line/command/experiment_command.hpp"
#include "command-line/command/experiment_inputs.hpp"
#include "engine/core/expected.hpp"
#include "logging/experiment/design.hpp"

namespace septet::server {

/// A remaining time of free play that is shorter than this is not driven.
constexpr double least_drive_s = 1.0;

struct Study {
  logging::Experiment experiment;
  std::string text, name;  ///< The file and what it is called.
  std::vector<logging::PlannedSubject> plan;
  std::filesystem::path folder;
  std::vector<DueQuestionnaire> questionnaires;
};
/// The experiment and all that its drives are made from. Error: the first of it that cannot be used.
Expected<Study> read_study(const ExperimentOptions& options);

std::filesystem::path drive_folder(const Study& study, const logging::PlannedSubject& subject,
                                   const logging::PlannedDrive& drive, std::size_t lap);

/// A drive of the experiment's folder as it was found.
struct FoundDrive {
  bool is_whole = false;  ///< It has ended as it should, and its log is closed.
  bool is_begun = false;  ///< Something of it is there.
  double simulated_s = 0.0;
};
FoundDrive find_drive(const std::filesystem::path& folder);

/// The command line of a drive, without the program.
std::vector<std::string> drive_arguments(const logging::Experiment& experiment, const logging::PlannedSubject& subject,
                                         std::size_t drive, std::size_t lap, double seconds,
                                         const std::filesystem::path& folder);
/// These arguments behind `command`, as a shell takes them.
std::string command_text(std::string command, const std::vector<std::string>& arguments);

/// Where a subject stands in the plan.
struct Stand {
  std::size_t drive = 0, lap = 0;
  double done_s = 0.0;   ///< Of this drive's laps.
  double total_s = 0.0;  ///< Of all.
  std::vector<std::filesystem::path> sessions;
  std::vector<std::size_t> drive_of_session;  ///< Of the subject's drives, for each of `sessions`.
  bool is_finished = false;
  bool is_forgotten = false;  ///< Finished, and without sessions.
};
/// From what lies in the folder: the whole drives, up to the first that is not.
Stand stand_of(const Study& study, const logging::PlannedSubject& subject);

/// The experiment's folder, held until the object goes; a second run in it is refused.
class HeldFolder {
 public:
  /// Where the experiment's file has been changed since, it goes on all the same as long as nothing changes that was driven.
  static Expected<std::unique_ptr<HeldFolder>> hold(const Study& study);
  /// A folder as it is: nothing is written there.
  static Expected<std::unique_ptr<HeldFolder>> hold(const std::filesystem::path& folder);
  HeldFolder() = default;
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;
  ~HeldFolder();

 private:
  int file_ = -1;
};

/// The experiment's folder, of a session below its `subjects/PARTICIPANT`; nothing where it lies elsewhere.
std::optional<std::filesystem::path> experiment_of(const std::filesystem::path& session,
                                                   const std::string& participant);
/// Notes that this subject is not to be driven anew (a line of `forgotten.txt`). The experiment's folder is held meanwhile: refused while it is being run.
Expected<void> note_forgotten(const std::filesystem::path& experiment, const std::string& participant);

}  // namespace septet::server
