#pragma once
/// Distance of a camera from what is solid: what stands beside the roads (engine/roadside), houses with their inside,
/// the ground, and the bodies of participants as boxes.
///
/// World frame, metres. Trees count with a crown of `crown_radius_m`, and what stands on the land without an upper end
/// (Obstacle) ends `endless_above_ground_m` over it, above any house and tree that is drawn. Pure.

#include <memory>
#include <span>
#include <vector>

#include "engine/film_script/shot.hpp"
#include "engine/roadside/obstacles.hpp"
#include "sim-client/film/accident/accident_facts.hpp"

namespace septet::film {

inline constexpr double least_clearance_m = 0.3;
inline constexpr double crown_radius_m = 2.0, endless_above_ground_m = 30.0;

/// Distance from a box that stands at a way point; 0 within it.
double distance_from_body_m(const Vec3& p, const VehicleModel& model, const WayPoint& at);

class Solids {
 public:
  /// `obstacles`: null where the road is unknown; then nothing stands anywhere.
  explicit Solids(std::shared_ptr<const roadside::Obstacles> obstacles);

  /// Distance from the nearest of what stands still, as far as `reach_m` (at most 25); that, where nothing is so near.
  /// 0 in a house and in the ground.
  double distance_m(const Vec3& p, double reach_m) const;
  /// True within something that stands; the ground does not count.
  bool holds(const Vec3& p) const;

 private:
  double standing_m(const Vec3& p, double reach_m) const;

  struct House {
    std::vector<Obstacle> walls;
    Vec2 low_m, high_m;
  };

  std::shared_ptr<const roadside::Obstacles> obstacles_;
  std::vector<House> houses_;
};

/// Camera of a shot at an instant, and the point that it looks at; for a place both are the same.
struct CameraPose {
  Vec3 eye_m{0.0}, aim_m{0.0};
};

/// Where the camera of a shot from outside stands when its participant is at `at`; turns are not followed.
CameraPose camera_pose(const Shot& shot, const Involved* pivot, const WayPoint& at);

/// True if the camera of a shot from outside is never nearer than `least_clearance_m` to what stands or to anybody of
/// `facts`, and nothing that stands lies between it and its participant. The instants are those of the ways.
bool is_clear(const Shot& shot, const AccidentFacts& facts, const Solids& solids);

/// The shot, or with another heading or distance, or a higher place, where that is needed to be clear; empty: none of
/// those is.
std::optional<Shot> cleared(const Shot& shot, const AccidentFacts& facts, const Solids& solids);

}  // namespace septet::film
