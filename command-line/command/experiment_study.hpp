#pragma once
/// An experiment's folder: its plan, and each subject's progress from the files there.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command-line/command/experiment_command.hpp"
#include "command-line/command/experiment_inputs.hpp"
#include "engine/core/expected.hpp"
#include "logging/study/experiment/design.hpp"

namespace septet::server {

/// A shorter remainder of free play is not driven.
constexpr double least_drive_s = 1.0;

struct Study {
  logging::Experiment experiment;
  std::string text, name;  ///< The file's text and its name.
  std::vector<logging::PlannedSubject> plan;
  std::filesystem::path folder;
  std::vector<DueQuestionnaire> questionnaires;
};
/// The experiment and all inputs of its drives. Error: the first unusable one.
Expected<Study> read_study(const ExperimentOptions& options);

std::filesystem::path drive_folder(const Study& study, const logging::PlannedSubject& subject,
                                   const logging::PlannedDrive& drive, std::size_t lap);

/// A drive found in the experiment's folder.
struct FoundDrive {
  bool is_whole = false;  ///< It ended regularly, and its log is closed.
  bool is_begun = false;  ///< Parts of it exist.
  double simulated_s = 0.0;
};
FoundDrive find_drive(const std::filesystem::path& folder);

/// The command line of a drive, without the program.
std::vector<std::string> drive_arguments(const logging::Experiment& experiment, const logging::PlannedSubject& subject,
                                         std::size_t drive, std::size_t lap, double seconds,
                                         const std::filesystem::path& folder);
/// These arguments behind `command`, quoted for a shell.
std::string command_text(std::string command, const std::vector<std::string>& arguments);

/// A subject's position in the plan.
struct Stand {
  std::size_t drive = 0, lap = 0;
  double done_s = 0.0;   ///< Over this drive's laps.
  double total_s = 0.0;  ///< Over all drives.
  std::vector<std::filesystem::path> sessions;
  std::vector<std::size_t> drive_of_session;  ///< Index of the subject's drive, for each of `sessions`.
  bool is_finished = false;
  bool is_forgotten = false;  ///< Finished, and without sessions.
};
/// From the files in the folder: the whole drives, up to the first that is not.
Stand stand_of(const Study& study, const logging::PlannedSubject& subject);

/// The experiment's folder, held until the object goes; a second run in it is refused.
class HeldFolder {
 public:
  /// A changed experiment file is accepted as long as no finished drive changes.
  static Expected<std::unique_ptr<HeldFolder>> hold(const Study& study);
  /// A folder opened for reading: nothing is written there.
  static Expected<std::unique_ptr<HeldFolder>> hold(const std::filesystem::path& folder);
  HeldFolder() = default;
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;
  ~HeldFolder();

 private:
  int file_ = -1;
};

/// Experiment folder of a session below its `subjects/PARTICIPANT`; empty if the session lies elsewhere.
std::optional<std::filesystem::path> experiment_of(const std::filesystem::path& session,
                                                   const std::string& participant);
/// Notes that this subject is not to be driven again (a line of `forgotten.txt`). Holds the experiment's folder
/// meanwhile: refused while it is running.
Expected<void> note_forgotten(const std::filesystem::path& experiment, const std::string& participant);

}  // namespace septet::server
