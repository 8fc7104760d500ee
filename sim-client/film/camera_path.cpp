#include "sim-client/film/camera_path.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace septet::film {
namespace {

using Turning = IncrementalTurn<double, 2>;

UnitVector<double, 2> unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

Expected<Turning> turning(const char* what, double from_rad, double to_rad, std::size_t steps, const Turn& turn,
                          const Shot& shot) {
  auto result = Turning::between(unit(from_rad), unit(to_rad), steps, turn.sigma);
  if (result) return result;
  const double degrees = 180.0 / std::numbers::pi;
  if (std::abs(turn.sigma) <= 1.0)
    return failure(
        fmt::format(
            "the turn until {} s changes the {} from {:.0f}° to {:.0f}°, half a circle: neither way is the shorter",
            turn.until_s, what, from_rad * degrees, to_rad * degrees),
        shot.where, "put a turn to an angle between them before it");
  return failure(fmt::format("the turn until {} s: {}", turn.until_s, result.error().what), shot.where,
                 result.error().remedy);
}

}  // namespace

Expected<std::vector<Look>> camera_path(const Shot& shot, double frames_per_second) {
  const double frames_per_simulated_s = frames_per_second / shot.speed;
  const double frames = std::round((shot.to_s - shot.from_s) * frames_per_simulated_s);
  if (!(frames >= 1.0))
    return failure(fmt::format("it lasts from {} to {} s, less than a frame", shot.from_s, shot.to_s), shot.where,
                   "let to_s be later than from_s");
  const auto last = static_cast<std::size_t>(frames) - 1;
  std::vector<Look> path;
  path.reserve(last + 1);
  Look look{unit(shot.heading_rad), unit(shot.pitch_rad)};
  double heading_rad = shot.heading_rad, pitch_rad = shot.pitch_rad;
  for (const Turn& turn : shot.turns) {
    const double until = std::round((turn.until_s - shot.from_s) * frames_per_simulated_s);
    const std::size_t end = std::min(last, static_cast<std::size_t>(std::max(0.0, until)));
    if (end <= path.size())
      return failure(fmt::format("the turn until {} s lasts less than a frame", turn.until_s), shot.where,
                     "let each turn's until_s be later than the one before, and the first later than from_s");
    const std::size_t steps = end - path.size();
    auto pan = turning("heading", heading_rad, turn.heading_rad, steps, turn, shot);
    if (!pan) return tl::unexpected(pan.error());
    auto tilt = turning("pitch", pitch_rad, turn.pitch_rad, steps, turn, shot);
    if (!tilt) return tl::unexpected(tilt.error());
    for (std::size_t n = 0; n < steps; ++n, pan->advance(), tilt->advance())
      path.push_back({pan->value(), tilt->value()});
    look = {pan->value(), tilt->value()};
    heading_rad = turn.heading_rad, pitch_rad = turn.pitch_rad;
  }
  path.resize(last + 1, look);
  return path;
}

}  // namespace septet::film
