#include "command-line/command/experiment_change.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <vector>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using logging::PlannedDrive, logging::PlannedSubject;

namespace {

/// Drives finished in the experiment's folder under this plan, by their command lines; for a forgotten subject, all
/// planned ones.
std::map<fs::path, std::vector<std::string>> driven_words(const Study& study) {
  std::map<fs::path, std::vector<std::string>> drives;
  for (const PlannedSubject& subject : study.plan) {
    const Stand stand = stand_of(study, subject);
    const auto add = [&](std::size_t index, std::size_t lap, double done_s) {
      const PlannedDrive& drive = subject.drives[index];
      const fs::path folder = drive_folder(study, subject, drive, lap);
      auto& words = drives[folder] =
          drive_arguments(study.experiment, subject, index, lap, drive.seconds - done_s, folder);
      if (drive.stops) words.emplace_back("(and stops)");
    };
    if (stand.is_forgotten)
      for (std::size_t i = 0; i < subject.drives.size(); ++i) add(i, 0, 0.0);
    double done_s = 0.0;
    for (std::size_t i = 0, lap = 0; i < stand.sessions.size(); ++i, ++lap) {
      const std::size_t index = stand.drive_of_session[i];
      if (i == 0 || index != stand.drive_of_session[i - 1]) lap = 0, done_s = 0.0;
      add(index, lap, done_s);
      done_s += find_drive(stand.sessions[i].parent_path()).simulated_s;
    }
  }
  return drives;
}

}  // namespace

Expected<void> check_same_drives(const Study& study, const std::string& earlier_text) {
  const auto differs = [&](const std::string& what) {
    return failure("the folder holds another experiment, or this one before it was changed: " + what,
                   study.folder.string(), "choose another folder with --out, or take that change back");
  };
  const auto earlier = logging::read_experiment(earlier_text, (study.folder / "experiment.toml").string());
  if (!earlier) return differs("its experiment.toml cannot be read");
  Study before{*earlier, earlier_text, study.name, plan_of(*earlier), study.folder, {}};
  const auto now = driven_words(study);
  for (const auto& [folder, words] : driven_words(before)) {
    const auto found = now.find(folder);
    const std::string drive = folder.lexically_relative(study.folder / "subjects").string();
    if (found == now.end()) return differs(drive + " was driven, and is not in it");
    if (found->second == words) continue;
    const auto [was, is] = std::ranges::mismatch(words, found->second);
    // A value with the option before it.
    const std::string option =
        was != words.begin() && was[-1].starts_with("--") && was[-1].find('=') == std::string::npos ? was[-1] + ' '
                                                                                                    : "";
    return differs(fmt::format("{} was driven with {}{}, and would be with {}", drive, option,
                               was == words.end() ? "less" : printable(*was),
                               is == found->second.end() ? "less" : printable(*is)));
  }
  return {};
}

}  // namespace septet::server
