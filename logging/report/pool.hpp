#pragma once
/// Many sessions as subjects: who drove which of them, and what they come to together.
///
/// Sessions of one participant, part and condition are measured as one drive with gaps: no measure runs across from one to the next.
/// A session without a participant is a subject of its own, called by its folder.

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/report/drive_measures.hpp"
#include "logging/statistics/survival.hpp"
#include "logging/subject.hpp"

namespace septet::logging {

struct PooledDrive {
  std::string label;  ///< Part and condition: "game", "game rain"; empty where neither is told.
  std::string order;  ///< Which of the driver's drives it was, as its first session tells.
  std::vector<std::filesystem::path> sessions;
  std::vector<std::uint64_t> seeds;
  bool ended_cleanly = true;  ///< All of them.
  DriveMeasures measures;
  std::map<std::string, double> answers;  ///< By item, scores among them; of its last session that has them.
  std::optional<ObservedTime> playing_time;
  std::string reason;  ///< For which they stopped.
};

struct PooledSubject {
  Subject
      subject;  ///< Of their first session; group and columns are those of a person, an order only where all drives have it.
  std::string driver;  ///< The simulated one; empty: a person.
  std::vector<PooledDrive> drives;
  // Of the person: what only one of their drives has, or all that have it say alike. What differs is the drive's alone.
  std::map<std::string, double> answers;
  std::optional<ObservedTime> playing_time;
  std::string reason;
};

/// Ordered by participant; the sessions of each in the order in which they are given.
Expected<std::vector<PooledSubject>> pool_sessions(std::span<const std::filesystem::path> sessions,
                                                   const MeasureSettings& settings);

/// `next` behind `all`, as a later part of the same drive with a gap before it.
void append(DriveRecords& all, DriveRecords next);

/// Items that somebody has answered in a drive with this label, in order.
std::vector<std::string> items_of(std::span<const PooledSubject> subjects, const std::string& label);

/// Labels of all drives, in the order in which they come first.
std::vector<std::string> labels_of(std::span<const PooledSubject> subjects);
/// Groups, likewise; the empty one is there where somebody has none.
std::vector<std::string> groups_of(std::span<const PooledSubject> subjects);

}  // namespace septet::logging
