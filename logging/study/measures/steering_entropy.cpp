#include "logging/study/measures/steering_entropy.hpp"

#include <algorithm>
#include <cmath>

#include "logging/study/measures/order_statistics.hpp"

namespace septet::logging {

std::vector<double> steering_prediction_errors(std::span<const double> steering_rad) {
  std::vector<double> errors;
  for (std::size_t n = 3; n < steering_rad.size(); ++n) {
    const double last = steering_rad[n - 1] - steering_rad[n - 2], before = steering_rad[n - 2] - steering_rad[n - 3];
    errors.push_back(steering_rad[n] - (steering_rad[n - 1] + last + (last - before) / 2.0));
  }
  return errors;
}

std::optional<double> steering_entropy_alpha(std::span<const double> baseline_errors) {
  std::vector<double> sizes;
  for (const double error : baseline_errors) sizes.push_back(std::abs(error));
  return quantile(sizes, 0.9);
}

std::optional<double> steering_entropy_of(std::span<const double> errors, double alpha_rad) {
  if (errors.empty() || !(alpha_rad > 0.0)) return std::nullopt;
  constexpr std::array edges{-5.0, -2.5, -1.0, -0.5, 0.5, 1.0, 2.5, 5.0};
  std::array<std::size_t, edges.size() + 1> counts{};
  for (const double error : errors)
    ++counts[static_cast<std::size_t>(std::ranges::upper_bound(edges, error / alpha_rad) - edges.begin())];
  double entropy = 0.0;
  for (const std::size_t count : counts) {
    if (count == 0) continue;
    const double share = static_cast<double>(count) / static_cast<double>(errors.size());
    entropy -= share * std::log(share) / std::log(static_cast<double>(counts.size()));
  }
  return entropy;
}

SteeringEntropy compute_steering_entropy(std::span<const InputRecord> inputs, double ticks_per_second,
                                         const SteeringEntropySettings& settings) {
  SteeringEntropy result;
  const auto per_interval = static_cast<std::size_t>(std::llround(steering_entropy_interval_s * ticks_per_second));
  if (per_interval == 0 || inputs.empty()) return result;
  std::vector<double> errors, baseline, run;
  const double begin_s = static_cast<double>(inputs.front().tick) / ticks_per_second;
  double run_end_s = begin_s;
  const auto end_run = [&] {
    const auto missed = steering_prediction_errors(run);
    result.left_out += run.size() - missed.size();
    for (std::size_t i = 0; i < missed.size(); ++i) {
      errors.push_back(missed[i]);
      const double time_s = run_end_s - static_cast<double>(missed.size() - 1 - i) * steering_entropy_interval_s;
      if (time_s - begin_s <= settings.baseline_s) baseline.push_back(missed[i]);
    }
    run.clear();
  };
  std::size_t in_interval = 0;
  double sum_rad = 0.0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (i > 0 && inputs[i].tick != inputs[i - 1].tick + 1) {
      if (in_interval > 0) ++result.left_out;
      in_interval = 0;
      sum_rad = 0.0;
      end_run();
    }
    sum_rad += inputs[i].input.steering_wheel_rad;
    if (++in_interval < per_interval) continue;
    run.push_back(sum_rad / static_cast<double>(per_interval));
    run_end_s = static_cast<double>(inputs[i].tick) / ticks_per_second;
    in_interval = 0;
    sum_rad = 0.0;
  }
  end_run();
  result.errors = errors.size();
  result.alpha_rad = settings.alpha_rad ? settings.alpha_rad : steering_entropy_alpha(baseline);
  if (result.alpha_rad) result.entropy = steering_entropy_of(errors, *result.alpha_rad);
  return result;
}

}  // namespace septet::logging
