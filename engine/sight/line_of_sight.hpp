#pragma once
/// Lines of sight: boxes in their way, and the share of light that passes the air between two points.
///
/// World frame, metres, radians. Pure functions: no files, no triangles, no renderer.

#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/math/rigid_transform.hpp"

namespace septet::sight {

/// A ray from an eye. `direction`: unit.
struct Line {
  Vec3 from_m{0.0}, direction{1.0, 0.0, 0.0};
};

/// A body as a box around the origin of its frame.
struct Box {
  RigidTransform world_from_box;
  Vec3 half_m{0.5};
};

/// A box that many lines are held against.
class BoxInTheWay {
 public:
  explicit BoxInTheWay(const Box& box) : box_from_world_(inverse(box.world_from_box)), half_m_(box.half_m) {}
  /// Distance at which a line enters it: 0 if it begins inside. Empty: it passes.
  std::optional<double> entry_m(const Line& line) const;

 private:
  RigidTransform box_from_world_;
  Vec3 half_m_;
};

/// The same for one line.
inline std::optional<double> entry_m(const Box& box, const Line& line) { return BoxInTheWay(box).entry_m(line); }

/// Share of light that passes along a line for `length_m` through air of this extinction, exp(−∫ ext ds), by the
/// midpoint rule with steps of at most `step_m` (positive). `extinction_per_m`: function of a place of the world, as
/// smoke::extinction_per_m is.
template <class Extinction>
double transmittance(const Line& line, double length_m, double step_m, const Extinction& extinction_per_m) {
  if (!(length_m > 0.0)) return 1.0;
  const auto steps = static_cast<std::int64_t>(std::ceil(length_m / step_m));
  const double each_m = length_m / static_cast<double>(steps);
  double depth = 0.0;
  for (std::int64_t n = 0; n < steps; ++n)
    depth += each_m * extinction_per_m(line.from_m + (static_cast<double>(n) + 0.5) * each_m * line.direction);
  return std::exp(-depth);
}

/// Distance along a line at which what stands there is no longer seen; `length_m` where all is. Steps and `extinction_per_m` as above;
/// `is_seen`: of the optical depth up to a distance, and that distance.
template <class Extinction, class IsSeen>
double seen_m(const Line& line, double length_m, double step_m, const Extinction& extinction_per_m,
              const IsSeen& is_seen) {
  if (!(length_m > 0.0)) return 0.0;
  const auto steps = static_cast<std::int64_t>(std::ceil(length_m / step_m));
  const double each_m = length_m / static_cast<double>(steps);
  double depth = 0.0;
  for (std::int64_t n = 0; n < steps; ++n) {
    const double from_m = static_cast<double>(n) * each_m;
    const double per_m = extinction_per_m(line.from_m + (from_m + 0.5 * each_m) * line.direction);
    if (!is_seen(depth + per_m * each_m, from_m + each_m)) {
      // Within the step, by halves.
      double seen = 0.0, unseen = each_m;
      for (int half = 0; half < 8; ++half) {
        const double middle = 0.5 * (seen + unseen);
        (is_seen(depth + per_m * middle, from_m + middle) ? seen : unseen) = middle;
      }
      return from_m + seen;
    }
    depth += per_m * each_m;
  }
  return length_m;
}

}  // namespace septet::sight
