#pragma once
/// Whom an eye sees now, past opaque bodies and walls and through the air.
///
/// A body is seen where one of nine points of its box, the corners of its upper half and the middle of its top, has
/// nothing opaque before it and is seen through the air. That is far cheaper than the share of its silhouette
/// (silhouette.hpp), and comes as early: a corner is the first of a box to come into sight. Attention plays no part.
///
///     const Lookout lookout(eye_m, bodies, &walls, gone);
///     const auto point_m = lookout.seen_point(id, box, is_seen_through_air);
///
/// World frame, metres. Pure.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/sight/line_of_sight.hpp"
#include "engine/sight/walls.hpp"

namespace septet::sight {

/// A body that hides what is behind it, with its participant's number.
struct OpaqueBody {
  std::uint32_t id = 0;
  Box box;
};

/// Points of a box of which one must be seen, a twentieth of its half sizes within its sides, the top ones first.
std::array<Vec3, 9> points_to_see(const Box& box);

class Lookout {
 public:
  /// Of `bodies` those around the eye itself hide nothing. `walls` (null: there are none) and `gone` (of Walls::hide) must
  /// live as long.
  Lookout(const Vec3& eye_m, std::span<const OpaqueBody> bodies, const Walls* walls,
          std::span<const std::uint32_t> gone = {});

  /// The first of the target's points that is seen; empty: it is hidden. `is_seen_through_air`: of a place of the world.
  template <class IsSeen>
  std::optional<Vec3> seen_point(std::uint32_t target, const Box& box, const IsSeen& is_seen_through_air) const {
    const std::vector<const Box*> before = before_target(target, box);
    for (const Vec3& point_m : points_to_see(box))
      if (!is_hidden(before, point_m) && is_seen_through_air(point_m)) return point_m;
    return std::nullopt;
  }

 private:
  /// A body around the eye: where it stands in plan from there.
  struct Around {
    OpaqueBody body;
    Vec2 away_m{0.0};
    double nearest_m = 0.0, reach_m = 0.0;
  };

  /// Bodies that may hide some of a box.
  std::vector<const Box*> before_target(std::uint32_t target, const Box& box) const;
  bool is_hidden(std::span<const Box* const> before, const Vec3& point_m) const;

  Vec3 eye_m_;
  std::vector<Around> around_;  ///< Nearest first.
  const Walls* walls_;
  std::span<const std::uint32_t> gone_;
};

}  // namespace septet::sight
