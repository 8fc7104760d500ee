#include "engine/physics/impact/crush_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/check.hpp"

namespace septet::impact {
namespace {

/// One body as a spring of the approach: deceleration per depth of its own, and where it gets harder.
struct Spring {
  double steepness_ps2 = INFINITY;
  double hard_from_mps2 = INFINITY;  ///< Deceleration.
  double harder_times = 1.0;

  double give_s2(double deceleration_mps2) const {
    return 1.0 / (steepness_ps2 * (deceleration_mps2 < hard_from_mps2 ? 1.0 : harder_times));
  }
  double crush_m(double deceleration_mps2) const {
    const double soft_mps2 = std::min(deceleration_mps2, hard_from_mps2);
    return soft_mps2 / steepness_ps2 + (deceleration_mps2 - soft_mps2) / (steepness_ps2 * harder_times);
  }
};

Spring spring_of(const Stiffness& own, const Stiffness& other) {
  if (!std::isfinite(own.mass_kg)) return {};
  // k/m of the approach with k = own mass · ω².
  const double steepness = own.crush.frequency_radps * own.crush.frequency_radps * (1.0 + own.mass_kg / other.mass_kg);
  return {steepness, steepness * own.crush.crumple_m, own.crush.harder_times};
}

struct Course {
  double amplitude_m, frequency_radps, from_rad, to_rad;  ///< depth + offset = amplitude · sin(phase).
  double offset_m;
};

/// The approach within one piece, which it enters at `speed_mps`.
Course course_in(const CrushCurve& curve, std::size_t piece, double speed_mps) {
  const CrushPiece& own = curve.pieces[piece];
  Course course;
  course.frequency_radps = std::sqrt(own.steepness_ps2);
  const double start_m = own.deceleration_mps2 / own.steepness_ps2, swing_m = speed_mps / course.frequency_radps;
  course.offset_m = start_m - own.depth_m;
  course.amplitude_m = std::hypot(start_m, swing_m);
  course.from_rad = std::atan2(start_m, swing_m);
  course.to_rad = 0.5 * std::numbers::pi;
  if (piece + 1 < curve.count) {
    const double end_m = curve.pieces[piece + 1].depth_m + course.offset_m;
    if (end_m < course.amplitude_m) course.to_rad = std::asin(end_m / course.amplitude_m);
  }
  return course;
}

/// The piece in which a depth lies; the last one goes on without end.
std::size_t piece_at(const CrushCurve& curve, double depth_m) {
  std::size_t piece = curve.count - 1;
  while (piece > 0 && curve.pieces[piece].depth_m > depth_m) --piece;
  return piece;
}

/// Work against the piece's deceleration between its beginning and `depth_m`, m²/s².
double work_to(const CrushPiece& piece, double depth_m) {
  const double in_m = depth_m - piece.depth_m;
  return in_m * (piece.deceleration_mps2 + 0.5 * piece.steepness_ps2 * in_m);
}

}  // namespace

CrushCurve crush_curve(const Stiffness& first, const Stiffness& second) {
  const Spring a = spring_of(first, second), b = spring_of(second, first);
  SEPTET_CHECK(std::isfinite(a.steepness_ps2) || std::isfinite(b.steepness_ps2), "two bodies that stand fast");
  std::array<double, 2> bends{a.hard_from_mps2, b.hard_from_mps2};
  std::ranges::sort(bends);
  CrushCurve curve;
  double begins_mps2 = 0.0;
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    curve.pieces[i] = {a.crush_m(begins_mps2) + b.crush_m(begins_mps2), begins_mps2,
                       1.0 / (a.give_s2(begins_mps2) + b.give_s2(begins_mps2))};
    curve.count = i + 1;
    const auto next = std::ranges::upper_bound(bends, begins_mps2);
    if (next == bends.end() || !std::isfinite(*next)) break;
    begins_mps2 = *next;
  }
  return curve;
}

CrushCurve beyond(const CrushCurve& curve, double depth_m) {
  CrushCurve rest;
  const std::size_t begin = piece_at(curve, depth_m);
  for (std::size_t i = begin; i < curve.count; ++i) {
    CrushPiece piece = curve.pieces[i];
    if (i == begin) piece.deceleration_mps2 = deceleration_mps2(curve, depth_m);
    piece.depth_m = i == begin ? 0.0 : piece.depth_m - depth_m;
    rest.pieces[rest.count++] = piece;
  }
  return rest;
}

double depth_m(const CrushCurve& curve, double speed_mps) {
  double energy = 0.5 * speed_mps * speed_mps;
  for (std::size_t i = 0;; ++i) {
    const CrushPiece& piece = curve.pieces[i];
    if (i + 1 < curve.count) {
      const double work = work_to(piece, curve.pieces[i + 1].depth_m);
      if (work <= energy) {
        energy -= work;
        continue;
      }
    }
    const double start_m = piece.deceleration_mps2 / piece.steepness_ps2;
    // ½κ(x² + 2 x start) = energy, as a quotient that keeps its digits where the root is small.
    const double twice_m2 = 2.0 * energy / piece.steepness_ps2;
    const double root_m = std::sqrt(start_m * start_m + twice_m2);
    return piece.depth_m + (root_m + start_m > 0.0 ? twice_m2 / (root_m + start_m) : 0.0);
  }
}

double speed_mps(const CrushCurve& curve, double depth_m) {
  double energy = 0.0;
  for (std::size_t i = 0; i < curve.count; ++i) {
    if (depth_m <= curve.pieces[i].depth_m) break;
    const double to_m = i + 1 < curve.count ? std::min(depth_m, curve.pieces[i + 1].depth_m) : depth_m;
    energy += work_to(curve.pieces[i], to_m);
  }
  return std::sqrt(2.0 * energy);
}

double deceleration_mps2(const CrushCurve& curve, double depth_m) {
  const CrushPiece& piece = curve.pieces[piece_at(curve, depth_m)];
  return piece.deceleration_mps2 + piece.steepness_ps2 * (depth_m - piece.depth_m);
}

double compression_s(const CrushCurve& curve, double speed_mps) {
  double time_s = 0.0;
  for (std::size_t i = 0; i < curve.count; ++i) {
    const Course course = course_in(curve, i, speed_mps);
    time_s += (course.to_rad - course.from_rad) / course.frequency_radps;
    speed_mps = course.amplitude_m * course.frequency_radps * std::cos(course.to_rad);
    if (course.to_rad >= 0.5 * std::numbers::pi) break;
  }
  return time_s;
}

Approach approach_at(const CrushCurve& curve, double speed_mps, double time_s) {
  for (std::size_t i = 0;; ++i) {
    const Course course = course_in(curve, i, speed_mps);
    const double here_s = (course.to_rad - course.from_rad) / course.frequency_radps;
    if (time_s <= here_s || i + 1 == curve.count || course.to_rad >= 0.5 * std::numbers::pi) {
      const double phase = course.from_rad + course.frequency_radps * std::min(time_s, here_s);
      return {course.amplitude_m * std::sin(phase) - course.offset_m,
              course.amplitude_m * course.frequency_radps * std::cos(phase)};
    }
    time_s -= here_s;
    speed_mps = course.amplitude_m * course.frequency_radps * std::cos(course.to_rad);
  }
}

CrushShares crush_shares(const Stiffness& first, const Stiffness& second, double depth) {
  const double deceleration = deceleration_mps2(crush_curve(first, second), depth);
  return {spring_of(first, second).crush_m(deceleration), spring_of(second, first).crush_m(deceleration)};
}

}  // namespace septet::impact
