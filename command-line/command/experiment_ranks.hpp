#pragma once
/// An experiment's drives on all machines of mpirun: the first program deals them out, first come first served, and
/// keeps the results.
///
/// The others drive in folders of their own machine and send whole drives back, so that no disk need be shared; Septet,
/// and all own files that the experiment names, must be on each. A lost program costs the drives that it was running:
/// they are dealt again. A message is one word, then its content; both sides are of one build, which the first message
/// checks.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "program/child_process.hpp"
#include "program/machines.hpp"
#include "program/process_mark.hpp"

namespace septet::server {

/// Removes the part of a drive that a stopped run has left beside `folder`: a drive from another program is written
/// there, and moved to `folder` once it is whole.
void clear_half_drive(const std::filesystem::path& folder);

/// The first program's view of the others. One thread.
class ExperimentRanks {
 public:
  explicit ExperimentRanks(program::Machines& machines) : machines_(machines) {}
  /// Tells them that the work is over.
  ~ExperimentRanks();
  ExperimentRanks(const ExperimentRanks&) = delete;
  ExperimentRanks& operator=(const ExperimentRanks&) = delete;

  bool has_room() const;
  /// Deals a drive to a program with room for it; once it has ended the content of `folder` is whole, its log lies
  /// beside it. Returns the drive's number; empty: no program has room.
  std::optional<std::uint64_t> deal(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

  struct Ended {
    std::uint64_t drive = 0;
    program::ChildExit exit;
    bool is_lost = false;  ///< Its program is gone.
  };
  /// Returns drives that have ended meanwhile. Error: the folder cannot be written.
  Expected<std::vector<Ended>> take_ended();
  std::vector<std::string> take_messages();

 private:
  struct Rank {
    std::size_t jobs = 0;
    program::ProcessMark process;
    double heard_s = 0.0;
  };
  struct Drive {
    int rank = 0;
    std::filesystem::path folder;
  };
  Expected<void> obey(const program::Mail& mail, std::vector<Ended>& ended);
  void lose(int rank, const std::string& why, std::vector<Ended>& ended);
  bool has_room(int rank) const;

  program::Machines& machines_;
  std::map<int, Rank> ranks_;
  std::map<std::uint64_t, Drive> drives_;
  std::uint64_t next_drive_ = 1;
  double told_s_ = 0.0;
  std::vector<std::string> messages_;
};

/// Whole run of a program that mpirun has started and that is not the first: drives its assignments, `jobs` at once (0:
/// its share of the processors), until the work is over or the first is gone. Returns the exit status.
int drive_for_experiment(program::Machines& machines, std::size_t jobs);

}  // namespace septet::server
