#include "command-line/command/experiment_next.hpp"

#include <fmt/format.h>

#include "command-line/command/experiment_study.hpp"

namespace septet::server {

Expected<std::vector<std::string>> next_of_experiment(const ExperimentOptions& options) {
  const auto study = read_study(options);
  if (!study) return tl::unexpected(study.error());
  for (const logging::PlannedSubject& subject : study->plan) {
    if (!options.only.empty() && subject.participant != options.only) continue;
    const Stand stand = stand_of(*study, subject);
    if (stand.is_finished) continue;
    const logging::PlannedDrive& drive = subject.drives[stand.drive];
    return drive_arguments(study->experiment, subject, stand.drive, stand.lap, drive.seconds - stand.done_s,
                           drive_folder(*study, subject, drive, stand.lap));
  }
  return failure(options.only.empty() ? std::string("everybody has driven all of it")
                                      : fmt::format("{} has driven all of it", options.only),
                 options.file, "name another participant, or see its report with: septet experiment");
}

}  // namespace septet::server
