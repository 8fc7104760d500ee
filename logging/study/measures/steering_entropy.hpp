#pragma once
/// Steering entropy after Nakayama, Futami, Nakamura and Boer (SAE 1999-01-0892): unpredictability of the hand wheel.
///
/// The wheel's angle every 150 ms is predicted from the three before it by a second-order Taylor series; e is the
/// prediction error. α is the 90th percentile of |e| in a baseline drive. e is counted in nine bins with edges ±0.5,
/// ±1, ±2.5 and ±5 α, and the entropy is −Σ p log₉ p: 0 if one bin has all, 1 if all have the same. A normal e gives
/// 0.542 in its own baseline. Boer's form of 2005 (4 Hz, autoregressive prediction, 14 bins) is another measure; the
/// two must not be pooled.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

inline constexpr double steering_entropy_interval_s = 0.15;

/// Prediction errors of angles every 150 ms without a gap: three fewer than there are angles.
std::vector<double> steering_prediction_errors(std::span<const double> steering_rad);
/// α. Empty without an error.
std::optional<double> steering_entropy_alpha(std::span<const double> baseline_errors);
/// Empty without an error, or if α is 0: the baseline had no steering.
std::optional<double> steering_entropy_of(std::span<const double> errors, double alpha_rad);

struct SteeringEntropySettings {
  /// α of a baseline drive of the same driver; without it the drive's own beginning is the baseline.
  std::optional<double> alpha_rad;
  double baseline_s = 60.0;  ///< From the beginning.
};

struct SteeringEntropy {
  std::optional<double> entropy, alpha_rad;
  std::size_t errors = 0;    ///< Number of errors counted, including the baseline's.
  std::size_t left_out = 0;  ///< Intervals of 150 ms that have no prediction: after a gap of the log.
};

/// The inputs come at every tick (120 a second); each 150 ms are averaged.
SteeringEntropy compute_steering_entropy(std::span<const InputRecord> inputs, double ticks_per_second,
                                         const SteeringEntropySettings& settings = {});

}  // namespace septet::logging
