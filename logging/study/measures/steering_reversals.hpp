#pragma once
/// Steering wheel reversal rate: reversals of the hand wheel by more than a gap, per minute.
///
/// Markkula and Engström, "A Steering Wheel Reversal Rate Metric for Assessing Effects of Visual and Cognitive
/// Secondary Task Load", ITS World Congress 2006 (in SAE J2944:2015 too): low-pass by a second-order Butterworth
/// filter, run forwards and backwards so that nothing is shifted (with a mirrored beginning and end); stationary
/// points; swings between them of more than the gap, up and down; over the recording's length, (n − 1)/rate. For visual
/// load they use 0.6 Hz and 3°, for cognitive load 2 Hz and 0.1°. Other settings give other numbers: report them beside
/// the value.

#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

struct ReversalSettings {
  double cut_off_hz = 0.6;
  double gap_rad = 3.0 / 180.0 * std::numbers::pi;
};
inline constexpr ReversalSettings visual_load_reversals{};
inline constexpr ReversalSettings cognitive_load_reversals{2.0, 0.1 / 180.0 * std::numbers::pi};

/// b₀ + b₁z⁻¹ + b₂z⁻² over 1 + a₁z⁻¹ + a₂z⁻².
struct SecondOrderFilter {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};
/// Low-pass, by the bilinear transform with the cut-off kept in its place. 0 < cut-off < half of the rate.
SecondOrderFilter butterworth_low_pass(double cut_off_hz, double rate_hz);
/// Forwards and backwards. Fewer than seven values are returned unchanged: they are shorter than the part mirrored at
/// an end.
std::vector<double> filtered_both_ways(const SecondOrderFilter& filter, std::span<const double> values);

/// Number of swings by more than the gap, up and down together, without any filter.
std::size_t count_reversals(std::span<const double> values, double gap);

struct ReversalRate {
  std::optional<double> per_minute;
  std::size_t reversals = 0;
  double measured_s = 0.0;  ///< Total length of the unbroken runs.
  std::size_t samples = 0;
  std::size_t left_out = 0;  ///< Samples of runs shorter than three periods of the cut-off.
};

/// Rate of a drive's samples, run by run.
ReversalRate compute_reversal_rate(std::span<const Sample> samples, const ReversalSettings& settings = {});

}  // namespace septet::logging
