#include "engine/driver/mirrors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace septet::driver {
namespace {

/// Smooth step from 0 to 1 with the least jerk (Flash and Hogan 1985).
double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
}

}  // namespace

double head_heading_rad(Mirror mirror) {
  constexpr double degree = std::numbers::pi / 180.0;
  switch (mirror) {
    case Mirror::left:
      return 0.8 * 44.0 * degree;
    case Mirror::inside:
      return -0.8 * 39.0 * degree;
    case Mirror::right:
      return -0.8 * 66.0 * degree;
  }
  return 0.0;
}

bool begin_glance(MirrorState& state, Mirror mirror, const MirrorParameters& mirrors, Random& random) {
  if (state.target) return false;
  state.target = mirror;
  state.since_s = 0.0;
  state.hold_s =
      std::min(mirrors.longest_glance_s, mirrors.glance_s * std::exp(mirrors.glance_spread * random.normal()));
  state.from_rad = state.head_rad;
  return true;
}

bool sees_road(const MirrorState& state) { return !state.target; }

std::optional<Mirror> advance_mirrors(MirrorState& state, const MirrorParameters& mirrors, bool at_ease, double dt_s,
                                      Random& random) {
  if (!state.target) {
    state.next_habit_s -= dt_s;
    if (state.next_habit_s <= 0.0 && at_ease) {
      state.next_habit_s = -mirrors.interval_s * std::log(1.0 - random.uniform());
      const double which = random.uniform();
      begin_glance(state, which < 0.6 ? Mirror::inside : which < 0.85 ? Mirror::left : Mirror::right, mirrors, random);
    }
    return std::nullopt;
  }
  state.since_s += dt_s;
  const double there = head_heading_rad(*state.target);
  const double back_at_s = mirrors.turn_s + state.hold_s;
  if (state.since_s < back_at_s) {
    state.head_rad = state.from_rad + (there - state.from_rad) * smooth_step(state.since_s / mirrors.turn_s);
    return std::nullopt;
  }
  state.head_rad = there * (1.0 - smooth_step((state.since_s - back_at_s) / mirrors.turn_s));
  if (state.since_s < back_at_s + mirrors.turn_s) return std::nullopt;
  const Mirror seen = *state.target;
  state.head_rad = 0.0;
  state.target.reset();
  return seen;
}

}  // namespace septet::driver
