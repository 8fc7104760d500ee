#pragma once
/// The best list of a game: best-list.json in the folder that holds the drives' folders, the best first.
///
/// Atomic: written whole or not at all. A file that is not a best list is never overwritten. Two drives that end at the
/// same moment may lose one entry.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::logging {

struct BestListEntry {
  std::string game, participant;  ///< The scenario; the driver's code, which may be empty.
  double points = 0.0, survived_s = 0.0;
  std::uint32_t level = 1;
  std::string end, started_utc;
  bool operator==(const BestListEntry&) const = default;
};

inline constexpr std::size_t longest_best_list = 200;  ///< Entries of one game.

/// Empty if the file does not exist.
Expected<std::vector<BestListEntry>> read_best_list(const std::filesystem::path& path);

/// Adds the entry; returns its place among those of its game, from 1 on.
Expected<std::size_t> enter_best_list(const std::filesystem::path& path, const BestListEntry& entry);

/// Removes everything of a participant. Returns the number of entries removed.
Expected<std::size_t> forget_in_best_list(const std::filesystem::path& path, const std::string& participant);

}  // namespace septet::logging
