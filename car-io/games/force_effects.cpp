#include "car-io/games/force_effects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace septet::car_io {
namespace {

double number(double value) { return std::isfinite(value) ? value : 0.0; }

double within(double value) { return std::clamp(number(value), -1.0, 1.0); }

/// Reaction to the wheel's position or speed: against it, beyond the dead band.
double answer(const ForceEffect& effect, double wheel) {
  const double away = number(wheel) - effect.centre, half = 0.5 * std::max(effect.dead_band, 0.0);
  if (away > half) return -std::min(effect.left_coefficient * (away - half), effect.left_most);
  if (away < -half) return std::min(effect.right_coefficient * (-away - half), effect.right_most);
  return 0.0;
}

double wave(const ForceEffect& effect, double played_s) {
  const double turns = played_s / std::max(effect.period_s, 1e-3) + effect.phase_turns;
  const double part = turns - std::floor(turns);
  switch (effect.wave) {
    case ForceWave::square:
      return part < 0.5 ? 1.0 : -1.0;
    case ForceWave::triangle:
      return 1.0 - 4.0 * std::abs(part - 0.5);
    case ForceWave::saw_up:
      return 2.0 * part - 1.0;
    case ForceWave::saw_down:
      return 1.0 - 2.0 * part;
    default:
      return std::sin(2.0 * std::numbers::pi * part);
  }
}

/// Factor on the level: its attack and fade.
double envelope(const ForceEffect& effect, double played_s, double level) {
  const double sign = level < 0.0 ? -1.0 : 1.0;
  if (effect.attack_s > 0.0 && played_s < effect.attack_s)
    return sign * (effect.attack_level + (std::abs(level) - effect.attack_level) * played_s / effect.attack_s);
  const double left_s = effect.length_s - played_s;
  if (effect.length_s > 0.0 && effect.fade_s > 0.0 && left_s < effect.fade_s)
    return sign * (effect.fade_level + (std::abs(level) - effect.fade_level) * left_s / effect.fade_s);
  return level;
}

double force_of(const ForceEffect& effect, const WheelPlace& wheel, double played_s) {
  switch (effect.kind) {
    case ForceKind::constant:
      return envelope(effect, played_s, effect.level);
    case ForceKind::ramp: {
      const double share = effect.length_s > 0.0 ? std::clamp(played_s / effect.length_s, 0.0, 1.0) : 0.0;
      return envelope(effect, played_s, effect.level + (effect.end_level - effect.level) * share);
    }
    case ForceKind::periodic:
      return effect.offset + envelope(effect, played_s, effect.level) * wave(effect, played_s);
    case ForceKind::spring:
      return answer(effect, wheel.share);
    case ForceKind::damper:
      return answer(effect, wheel.speed_per_s);
    case ForceKind::inertia:
      return answer(effect, wheel.change_per_s2 / 100.0);
    case ForceKind::friction: {
      // Full as soon as it turns; softly around standstill, or it trembles.
      const double turning = std::clamp(number(wheel.speed_per_s) / 0.05, -1.0, 1.0);
      return turning > 0.0 ? -turning * std::min(effect.left_coefficient, effect.left_most)
                           : -turning * std::min(effect.right_coefficient, effect.right_most);
    }
  }
  return 0.0;
}

}  // namespace

void ForceEffects::load(std::int16_t id, const ForceEffect& effect) {
  constexpr std::size_t most = 64;
  if (loaded_.size() >= most && !loaded_.contains(id)) return;
  loaded_[id].effect = effect;  // A playing effect goes on with its changes.
}

void ForceEffects::erase(std::int16_t id) { loaded_.erase(id); }

void ForceEffects::play(std::int16_t id, int times, double now_s) {
  const auto found = loaded_.find(id);
  if (found == loaded_.end()) return;
  found->second.times = times;
  found->second.began_s.reset();
  if (times > 0) found->second.began_s = now_s;
}

double ForceEffects::force(const WheelPlace& wheel, double now_s) const {
  double sum = 0.0;
  for (const auto& [id, loaded] : loaded_) {
    if (!loaded.began_s) continue;
    double played_s = now_s - *loaded.began_s - loaded.effect.delay_s;
    const double length_s = loaded.effect.length_s;
    if (played_s < 0.0 || (length_s > 0.0 && played_s >= length_s * loaded.times)) continue;
    if (length_s > 0.0) played_s = std::fmod(played_s, length_s);
    sum += within(force_of(loaded.effect, wheel, played_s));
  }
  sum -= autocentre_ * within(wheel.share);
  return within(within(sum) * std::clamp(number(gain_), 0.0, 1.0));
}

}  // namespace septet::car_io
