#pragma once
/// Execution of the command line of `septet-sight`: who was unobstructed for whom in a recorded session.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "sim-client/sight/session_sight.hpp"

namespace septet::sight {

struct SightOptions {
  std::filesystem::path session;
  std::filesystem::path out;  ///< Folder; empty: sight beside the session.
  std::string eyes, target;   ///< Names or numbers; empty: chosen by range.
  std::optional<double> from_s, to_s;
  double every_s = 0.1;
  double range_m = 100.0;
  std::size_t pairs = 6;
  bool mirrors = true;
  Threshold threshold;
};

/// Writes sight.csv, sight.svg and sight.txt and prints the sentences. Returns the exit status; 1 if a person stopped it.
Expected<int> run_sight(SightOptions options);

}  // namespace septet::sight
