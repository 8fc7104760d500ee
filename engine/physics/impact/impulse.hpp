#pragma once
/// The impulse that two bodies exchange at one point in plan, in closed form.
///
/// After Kudlich (1966) and Slibar, as reconstruction programs use it; the equations of planar impact mechanics stand
/// in Brach (1983, Analysis of planar vehicle collisions using equations of impulse and momentum). With r_k the arms
/// from the mass centres to the point, n the normal from the first body to the second, t = n turned left, u the
/// velocity of the first's material at the point relative to the second's, and a×b = ax by − ay bx:
///
///   K_nn = Σ 1/m + (r×n)²/I,  K_tt = Σ 1/m + (r×t)²/I,  K_nt = Σ (r×n)(r×t)/I,  D = K_nn K_tt − K_nt²
///   End of compression without slip:  N = (u_n K_tt − u_t K_nt)/D,  T = (u_t K_nn − u_n K_nt)/D
///   Where |T| > μN:  s = sign T,  N = u_n/(K_nn + sμ K_nt),  T = sμN
///   Impulse on the second body:  J = (1+e)(N n + T t); the first takes −J
///
/// The restitution e thus acts on both components where the bodies stick. u_n turns into −e u_n, stick or slip, and
/// the kinetic energy lost is Kelvin's ½ J·(u + u′) ≥ 0. Momentum and angular momentum about the point are kept.
///
/// A contact may be too slight to stop the approach: two fenders that overlap by a hand's breadth bend by that much and
/// are past each other. `most_stopped_mps` bounds the part of u_n that is stopped (meet.hpp).

#include <optional>

#include "engine/physics/impact/body.hpp"

namespace septet::impact {

/// Where two bodies meet.
struct Place {
  Vec2 point_m{0.0};
  Vec2 normal{1.0, 0.0};  ///< Unit length, from the first body to the second.
};

struct Rule {
  double restitution = 0.1;  ///< e, 0 to 1.
  double friction = 0.5;     ///< μ ≥ 0.
  double most_stopped_mps = INFINITY;
};

struct Impulse {
  Vec2 on_second_ns{0.0};  ///< J; the first body takes −J.
  Vec2 first_arm_m{0.0}, second_arm_m{0.0};
  double normal_ns = 0.0, tangential_ns = 0.0;  ///< J along n and t.
  double closing_mps = 0.0;                     ///< u_n before.
  double sliding_mps = 0.0;                     ///< u_t before.
  double stopped_mps = 0.0;                     ///< Part of u_n that compression stops.
  bool sticks = false;
};

/// Empty where the surfaces do not approach, or where both bodies stand fast.
std::optional<Impulse> impulse_at(const Body& first, const Body& second, const Place& place, const Rule& rule);

/// Gives both bodies their share, a part of it for `share` below 1.
void exchange(const Impulse& impulse, double share, Body& first, Body& second);

}  // namespace septet::impact
