#include "logging/study/measures/steering_reversals.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"
#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {
namespace {

/// Direct form II transposed, started in the steady state of the first value.
void run(const SecondOrderFilter& f, std::vector<double>& values) {
  const double gain = (f.b0 + f.b1 + f.b2) / (1.0 + f.a1 + f.a2);
  double second = (f.b2 - f.a2 * gain) * values.front();
  double first = (f.b1 - f.a1 * gain) * values.front() + second;
  for (double& value : values) {
    const double in = value;
    value = f.b0 * in + first;
    first = f.b1 * in - f.a1 * value + second;
    second = f.b2 * in - f.a2 * value;
  }
}

int sign_of(double value) { return (value > 0.0) - (value < 0.0); }

/// Upward swings between stationary values.
std::size_t upward_swings(std::span<const double> stationary, double direction, double gap) {
  if (stationary.empty()) return 0;
  std::size_t count = 0;
  double lowest = direction * stationary.front();
  for (const double value : stationary) {
    const double now = direction * value;
    const bool is_swing = now - lowest > gap;
    if (is_swing) ++count;
    if (is_swing || now <= lowest) lowest = now;
  }
  return count;
}

}  // namespace

SecondOrderFilter butterworth_low_pass(double cut_off_hz, double rate_hz) {
  SEPTET_CHECK(cut_off_hz > 0.0 && cut_off_hz < rate_hz / 2.0, "{} Hz of {} Hz", cut_off_hz, rate_hz);
  const double k = std::tan(std::numbers::pi * cut_off_hz / rate_hz);
  const double divisor = 1.0 + std::numbers::sqrt2 * k + k * k;
  const double b = k * k / divisor;
  return {b, 2.0 * b, b, 2.0 * (k * k - 1.0) / divisor, (1.0 - std::numbers::sqrt2 * k + k * k) / divisor};
}

std::vector<double> filtered_both_ways(const SecondOrderFilter& filter, std::span<const double> values) {
  constexpr std::size_t mirrored = 6;  // Three times the filter's order, at either end.
  const std::size_t count = values.size();
  if (count <= mirrored) return {values.begin(), values.end()};
  std::vector<double> longer(count + 2 * mirrored);
  for (std::size_t i = 0; i < mirrored; ++i) {
    longer[i] = 2.0 * values.front() - values[mirrored - i];
    longer[mirrored + count + i] = 2.0 * values.back() - values[count - 2 - i];
  }
  std::ranges::copy(values, longer.begin() + mirrored);
  run(filter, longer);
  std::ranges::reverse(longer);
  run(filter, longer);
  std::ranges::reverse(longer);
  return {longer.begin() + mirrored, longer.end() - mirrored};
}

std::size_t count_reversals(std::span<const double> values, double gap) {
  // Stationary points: the first value, and each change between rising and falling, or a rest.
  std::vector<double> stationary;
  int direction = 0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const int next = sign_of(values[i + 1] - values[i]);
    if (direction == 0 || direction * next < 0) stationary.push_back(values[i]);
    direction = next;
  }
  return upward_swings(stationary, 1.0, gap) + upward_swings(stationary, -1.0, gap);
}

ReversalRate compute_reversal_rate(std::span<const Sample> samples, const ReversalSettings& settings) {
  constexpr double rate_hz = 1.0 / sample_interval_s;
  const auto filter = butterworth_low_pass(settings.cut_off_hz, rate_hz);
  const auto shortest = static_cast<std::size_t>(std::ceil(3.0 * rate_hz / settings.cut_off_hz));
  ReversalRate result;
  for (const auto run_of_samples : unbroken_runs(samples)) {
    if (run_of_samples.size() <= std::max<std::size_t>(shortest, 7)) {
      result.left_out += run_of_samples.size();
      continue;
    }
    std::vector<double> steering_rad;
    for (const Sample& sample : run_of_samples) steering_rad.push_back(sample.steering_wheel_rad);
    result.reversals += count_reversals(filtered_both_ways(filter, steering_rad), settings.gap_rad);
    result.samples += run_of_samples.size();
    result.measured_s += static_cast<double>(run_of_samples.size() - 1) / rate_hz;
  }
  if (result.measured_s > 0.0) result.per_minute = static_cast<double>(result.reversals) * 60.0 / result.measured_s;
  return result;
}

}  // namespace septet::logging
