#pragma once
/// Many sessions as subjects: the assignment of sessions to drivers, and their pooled records.
///
/// Sessions of one participant, part and condition are measured as one drive with gaps: no measure runs across from one
/// to the next. A session without a participant is a subject of its own, named after its folder.

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/session/subject.hpp"
#include "logging/study/report/drive_measures.hpp"
#include "logging/study/statistics/survival.hpp"

namespace septet::logging {

struct PooledDrive {
  std::string label;  ///< Part and condition: "game", "game rain"; empty if neither is given.
  std::string order;  ///< Position among the driver's drives, from its first session.
  std::vector<std::filesystem::path> sessions;
  std::vector<std::uint64_t> seeds;
  bool ended_cleanly = true;  ///< All of them.
  DriveMeasures measures;
  std::map<std::string, double> answers;  ///< By item, including scores; from the last session with answers.
  std::optional<ObservedTime> playing_time;
  std::string reason;  ///< Reason for stopping.
};

struct PooledSubject {
  /// From their first session; group and columns are those of a person, an order only if all drives have it.
  Subject subject;
  std::string driver;  ///< Name of a simulated driver; empty: a person.
  std::vector<PooledDrive> drives;
  // Answers of the person: given in one drive only, or equal in all drives with them. Differing ones belong to the
  // drives alone.
  std::map<std::string, double> answers;
  std::optional<ObservedTime> playing_time;
  std::string reason;
};

/// Ordered by participant; the sessions of each in the given order.
Expected<std::vector<PooledSubject>> pool_sessions(std::span<const std::filesystem::path> sessions,
                                                   const MeasureSettings& settings);

/// `next` behind `all`, as a later part of the same drive with a gap before it.
void append(DriveRecords& all, DriveRecords next);

/// Items answered in any drive with this label, in order.
std::vector<std::string> items_of(std::span<const PooledSubject> subjects, const std::string& label);

/// Labels of all drives, by first appearance.
std::vector<std::string> labels_of(std::span<const PooledSubject> subjects);
/// Groups, likewise; includes the empty one if a subject has no group.
std::vector<std::string> groups_of(std::span<const PooledSubject> subjects);

}  // namespace septet::logging
