#pragma once
/// The debris of a drive: elastic pieces that can break further, and shards that cannot.
///
/// `advance_debris` is the tick: melting, contacts, the air, one elastic step, plastic flow, fracture, sleep. World
/// frame of Septet. State is plain data; the same state and input give the same result. One thread.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/effects/debris/breakable_part.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::debris {

struct Piece;         ///< An elastic piece: defined in piece.hpp.
struct EnergyLedger;  ///< Where energy came from and went to: defined in energy_ledger.hpp.

/// A rigid splinter of glass, drawn as one triangle.
struct Shard {
  Vec3 position_m{0.0}, velocity_mps{0.0}, angular_velocity_radps{0.0};
  Quat orientation{1.0, 0.0, 0.0, 0.0};
  double size_m = 0.03;
  double mass_kg = 0.0;
  double shade_m2 = 0.0;  ///< Mean area of its shade over all attitudes: a quarter of its surface; 0: no air.
};

/// Its special members are defined where Piece is complete, so that users of a state need not include it.
struct State {
  State();
  State(const State&);
  State(State&&) noexcept;
  State& operator=(const State&);
  State& operator=(State&&) noexcept;
  ~State();

  std::vector<Piece> pieces;  ///< Ascending id.
  std::vector<Shard> shards;
  std::uint32_t next_id = 1;
  std::uint32_t bad_numbers = 0;  ///< Nodes reset since the start.
};

struct GroundPoint {
  double height_m = 0.0;
  Vec3 normal{0.0, 0.0, 1.0};
  double friction_factor = 1.0;  ///< Multiplies the material's friction; 0.15 on ice.
};

/// A plane of a hull, in its box's frame: points beyond it along the normal are outside.
struct HullPlane {
  Vec3 normal{0.0, 0.0, 1.0};  ///< Unit length.
  double offset_m = 0.0;       ///< From the box's centre.
};

/// A vehicle, a barrier's segment or any other box that debris cannot move; `cuts` make a convex hull of it.
struct Box {
  RigidTransform world_from_box;  ///< Origin at the centre.
  Vec3 half_size_m{1.0};
  std::vector<HullPlane> cuts;
  Vec3 velocity_mps{0.0};  ///< Velocity of the centre.
  Vec3 angular_velocity_radps{0.0};
  double friction = 0.4;
  Vec3 impulse_ns{0.0};  ///< Out: impulse of the debris on the box during the tick.
};

struct ContactWorld {
  std::function<GroundPoint(double x_m, double y_m)> ground;
  std::vector<Box> boxes;
  Vec3 wind_mps{0.0};     ///< Velocity of the air (air_force.hpp).
  double melted_m = 0.0;  ///< Thickness that a surface of ice loses in the step (melt.hpp).
};

struct StepReport {
  int fractures = 0;  ///< Faces that opened.
  int awake = 0;      ///< Pieces stepped.
  int bad_numbers = 0;
};

/// A part in one piece, without an id; the splinters are drawn from `random`. `height_left`: remaining share of its
/// size along z, where it has melted.
Piece make_part(Part part, const RigidTransform& world_from_part, const Vec3& velocity_mps,
                const Vec3& angular_velocity_radps, Random& random, double height_left = 1.0);

/// Adds a part in one piece; the splinters are drawn from `random`. Returns its id.
std::uint32_t spawn_part(State& state, Part part, const RigidTransform& world_from_part, const Vec3& velocity_mps,
                         const Vec3& angular_velocity_radps, Random& random, double height_left = 1.0);

/// `ledger`, where there is one, gets what the tick came to.
StepReport advance_debris(State& state, ContactWorld& world, double step_s, EnergyLedger* ledger = nullptr);

/// Height of the highest debris within `radius_m` of a place, for wheels that meet it; pieces thinner than a centimetre
/// and shards are no obstacle.
std::optional<double> highest_debris_m(const State& state, double x_m, double y_m, double radius_m);

}  // namespace septet::debris
