#pragma once
/// Sight in sentences, as a table and as a chart.

#include <string>
#include <vector>

#include "sim-client/sight/pairs.hpp"
#include "sim-client/sight/session_sight.hpp"

namespace septet::sight {

/// The two ways of a pair, in the order of `directed`.
struct Looking {
  logging::Stay observer, target;
  std::optional<double> contact_s;
};

/// Directed pairs of the chosen ones: both ways, where eyes are.
std::vector<Looking> lookings_of(const std::vector<ChosenPair>& pairs);
std::vector<DirectedPair> directed(const std::vector<Looking>& lookings);

/// One sentence for each looking: since when, from how far, how long before contact or the nearest point.
std::vector<std::string> sentences(const SessionSight& sight, const std::vector<Looking>& lookings,
                                   const Threshold& threshold);

/// Table of comma-separated values with a head; a row for straight sight, and one for each mirror with an image.
std::string table(const SessionSight& sight, const std::vector<Looking>& lookings);

/// SVG page with a chart of shares over time for each pair.
std::string chart(const SessionSight& sight, const std::vector<Looking>& lookings, const Threshold& threshold,
                  const std::string& title);

}  // namespace septet::sight
