#include "logging/study/measures/time_to_line_crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "logging/study/measures/order_statistics.hpp"
#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {
namespace {

bool has_lane(const Sample& sample) {
  return sample.lane != 0 && sample.lane_width_m > 0.0 && std::isfinite(sample.lateral_position_m);
}

/// Lateral motion in the lane at the middle one of three samples.
struct LateralMotion {
  double speed_mps = 0.0, acceleration_mps2 = 0.0;
};

std::optional<LateralMotion> lateral_motion(const Sample& before, const Sample& now, const Sample& after) {
  if (!follows(before, now) || !follows(now, after)) return std::nullopt;
  for (const Sample* sample : {&before, &now, &after})
    if (!has_lane(*sample) || std::abs(sample->lateral_position_m - now.lateral_position_m) > now.lane_width_m / 2.0)
      return std::nullopt;
  const double before_s = now.simulated_time_s - before.simulated_time_s;
  const double after_s = after.simulated_time_s - now.simulated_time_s;
  const double in_mps = (now.lateral_position_m - before.lateral_position_m) / before_s;
  const double out_mps = (after.lateral_position_m - now.lateral_position_m) / after_s;
  // The derivatives of the parabola through the three.
  return LateralMotion{(in_mps * after_s + out_mps * before_s) / (before_s + after_s),
                       2.0 * (out_mps - in_mps) / (before_s + after_s)};
}

std::optional<double> smaller(const std::optional<double>& one, const std::optional<double>& other) {
  if (!one || !other) return one ? one : other;
  return std::min(*one, *other);
}

using Values = std::array<std::optional<double>, 4>;  ///< By TlcKind.

/// For the nearer crossing of the two lines; empty if a side of the car is over one.
std::optional<Values> tlc_of(const Sample& sample, const LateralMotion& motion, double half_width_m) {
  const double speed_mps = sample.speed_mps;
  const double heading_rad = std::asin(std::clamp(motion.speed_mps / speed_mps, -1.0, 1.0));
  // The lane's direction turns by the part of the yaw rate that is not the car's turning within the lane.
  const double forward_mps = speed_mps * std::cos(heading_rad);
  const double curvature_pm =
      forward_mps > 0.0 ? (sample.yaw_rate_radps - motion.acceleration_mps2 / forward_mps) / forward_mps : 0.0;
  Values nearest;
  for (const double side : {1.0, -1.0}) {
    const double distance_m = sample.lane_width_m / 2.0 - half_width_m - side * sample.lateral_position_m;
    if (distance_m <= 0.0) return std::nullopt;
    const LineApproach approach{distance_m, side * motion.speed_mps, side * motion.acceleration_mps2};
    const double line_pm = curvature_pm / (1.0 - curvature_pm * side * distance_m);
    const Values values{
        simple_tlc_s(approach), quadratic_tlc_s(approach), van_winsum_tlc_s(approach),
        trigonometric_tlc_s({speed_mps, sample.yaw_rate_radps, heading_rad, side * distance_m, line_pm})};
    for (std::size_t kind = 0; kind < values.size(); ++kind) nearest[kind] = smaller(nearest[kind], values[kind]);
  }
  return nearest;
}

/// Statistics of one kind, over the samples in turn; an empty value means that no line is approached. The caller leaves
/// out all other samples without a value, by `interrupt`.
class Collector {
 public:
  explicit Collector(const TlcSettings& settings) : settings_(settings) {}

  void add(const std::optional<double>& tlc_s) {
    ++result_.samples;
    if (!tlc_s) ++result_.not_approaching;
    if (tlc_s) result_.smallest_s = smaller(result_.smallest_s, tlc_s);
    if (tlc_s && *tlc_s < settings_.short_s) ++short_;
    const double value_s = tlc_s.value_or(std::numeric_limits<double>::infinity());
    if (is_falling_ && value_s > previous_s_ && previous_s_ <= settings_.longest_s) minima_.push_back(previous_s_);
    if (value_s != previous_s_) is_falling_ = value_s < previous_s_;
    previous_s_ = value_s;
  }
  /// Later samples do not belong to the drift before.
  void interrupt() {
    is_falling_ = false;
    previous_s_ = std::numeric_limits<double>::infinity();
  }
  TlcStatistics result() const {
    TlcStatistics result = result_;
    result.minima = minima_.size();
    result.minimum_median_s = median(minima_);
    if (result.samples > 0) result.short_share = static_cast<double>(short_) / static_cast<double>(result.samples);
    return result;
  }

 private:
  TlcSettings settings_;
  TlcStatistics result_;
  std::vector<double> minima_;
  std::size_t short_ = 0;
  double previous_s_ = std::numeric_limits<double>::infinity();
  bool is_falling_ = false;
};

}  // namespace

std::optional<double> simple_tlc_s(const LineApproach& approach) {
  if (!(approach.speed_mps > 0.0)) return std::nullopt;
  return approach.distance_m / approach.speed_mps;
}

std::optional<double> quadratic_tlc_s(const LineApproach& approach) {
  const double v = approach.speed_mps, a = approach.acceleration_mps2, d = approach.distance_m;
  const double discriminant = v * v + 2.0 * a * d;
  if (discriminant < 0.0) return std::nullopt;
  // t = 2d / (v + √…) has no cancellation, and holds for a = 0; for a < 0 it is the earlier of the two roots.
  const double divisor = v + std::sqrt(discriminant);
  if (!(divisor > 0.0)) return std::nullopt;
  return 2.0 * d / divisor;
}

std::optional<double> van_winsum_tlc_s(const LineApproach& approach) {
  const double after_a_second_mps = approach.speed_mps + approach.acceleration_mps2;
  if (!(after_a_second_mps > 0.0)) return std::nullopt;
  return approach.distance_m / after_a_second_mps;
}

std::optional<double> trigonometric_tlc_s(const PathAndLine& path) {
  if (!(path.speed_mps > 0.0)) return std::nullopt;
  const double k = path.yaw_rate_radps / path.speed_mps, kappa = path.line_curvature_pm, d = path.distance_m;
  // A point (x, y) is on the line where κ(x² + y² + d²)/2 + d − y(1 + κd) = 0: a circle of curvature κ through (0, d),
  // or y = d. Along the path, with σ = 2/k·tan(ks/2) for the arc s (σ = s where it is straight), that is aσ² + bσ + c =
  // 0.
  const double c = d + kappa * d * d / 2.0;
  const double b = -(1.0 + kappa * d) * std::sin(path.heading_rad);
  const double a = (kappa - k * (1.0 + kappa * d) * std::cos(path.heading_rad)) / 2.0 + c * k * k / 4.0;
  std::optional<double> arc_m;
  const auto consider = [&](double sigma) {
    if (!std::isfinite(sigma)) return;
    double s = std::abs(k) > 1e-12 ? 2.0 / k * std::atan(k * sigma / 2.0) : sigma;
    if (s < 0.0 && std::abs(k) > 1e-12) s += 2.0 * std::numbers::pi / std::abs(k);  // The long arc.
    if (s >= 0.0) arc_m = smaller(arc_m, s);
  };
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2.0;
  consider(c / q);
  consider(q / a);
  return arc_m ? std::optional(*arc_m / path.speed_mps) : std::nullopt;
}

TlcMeasures compute_tlc(std::span<const Sample> samples, std::span<const LaneChange> changes,
                        const TlcSettings& settings) {
  TlcMeasures measures;
  measures.half_width_m = settings.half_width_m;
  std::array<Collector, 4> collectors{Collector(settings), Collector(settings), Collector(settings),
                                      Collector(settings)};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    const bool is_near_change = std::ranges::any_of(changes, [&](const LaneChange& change) {
      return std::abs(sample.simulated_time_s - change.simulated_time_s) < settings.exclude_around_lane_change_s;
    });
    std::optional<LateralMotion> motion;
    if (i > 0 && i + 1 < samples.size()) motion = lateral_motion(samples[i - 1], sample, samples[i + 1]);
    std::optional<Values> values;
    if (is_near_change)
      ++measures.excluded_lane_change;
    else if (!motion || sample.speed_mps < settings.least_speed_mps)
      ++measures.missing;
    else if (values = tlc_of(sample, *motion, settings.half_width_m); !values)
      ++measures.over_line;
    for (std::size_t kind = 0; kind < collectors.size(); ++kind)
      values ? collectors[kind].add((*values)[kind]) : collectors[kind].interrupt();
  }
  measures.simple = collectors[0].result();
  measures.quadratic = collectors[1].result();
  measures.van_winsum = collectors[2].result();
  measures.trigonometric = collectors[3].result();
  return measures;
}

}  // namespace septet::logging
