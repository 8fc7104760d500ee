#pragma once
/// Driving above the speed limit.
///
/// A sample is a violation if its speed exceeds the limit of its lane (OpenDRIVE's, of lane or road type) by more than
/// the tolerance; an episode is an unbroken run of them. Samples without a posted limit are counted apart and violate
/// nothing.

#include <optional>
#include <span>

#include "logging/session/records.hpp"

namespace septet::logging {

struct SpeedingSettings {
  double tolerance_mps = 3.0 / 3.6;
};

struct SpeedingMeasures {
  double share = 0.0;   ///< Share of the samples with a limit.
  double over_s = 0.0;  ///< 0.1 s a sample.
  std::size_t episodes = 0;
  double largest_excess_mps = 0.0;  ///< Over the limit, of the violations.
  std::size_t samples = 0;          ///< Samples with a limit.
  std::size_t no_limit = 0;
};

/// `limits_mps`: one for each sample; empty if unknown.
SpeedingMeasures compute_speeding(std::span<const Sample> samples, std::span<const std::optional<double>> limits_mps,
                                  const SpeedingSettings& settings = {});

}  // namespace septet::logging
