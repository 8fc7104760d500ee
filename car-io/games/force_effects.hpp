#pragma once
/// The force effects that a game has loaded into a wheel, and their sum at an instant: the model of the kernel's wheel
/// drivers (Linux' Documentation/input/ff.rst), as plain data.
///
/// Forces are shares of the motor's maximum, −1 to 1, positive to the left. A pure function of effects, wheel and time.

#include <cstdint>
#include <map>
#include <optional>

namespace septet::car_io {

enum class ForceKind : std::uint8_t { constant, spring, damper, friction, inertia, periodic, ramp };
enum class ForceWave : std::uint8_t { square, triangle, sine, saw_up, saw_down };

struct ForceEffect {
  ForceKind kind = ForceKind::constant;
  double level = 0.0;      ///< For constant, periodic and a ramp's beginning.
  double end_level = 0.0;  ///< For a ramp.
  double offset = 0.0;     ///< For a periodic.
  ForceWave wave = ForceWave::sine;
  double period_s = 0.1, phase_turns = 0.0;
  // For conditions: shares of force at full travel (or speed) to the left and to the right, their limits, and the
  // centre.
  double left_coefficient = 0.0, right_coefficient = 0.0, left_most = 1.0, right_most = 1.0;
  double centre = 0.0, dead_band = 0.0;
  double length_s = 0.0, delay_s = 0.0;  ///< 0: until it is stopped.
  double attack_s = 0.0, attack_level = 0.0, fade_s = 0.0, fade_level = 0.0;
};

struct WheelPlace {
  double share = 0.0;        ///< −1 full right to 1 full left.
  double speed_per_s = 0.0;  ///< Change of the share per second.
  double change_per_s2 = 0.0;
};

class ForceEffects {
 public:
  void load(std::int16_t id, const ForceEffect& effect);
  void erase(std::int16_t id);
  /// `times`: 0 stops it.
  void play(std::int16_t id, int times, double now_s);
  void set_gain(double gain) { gain_ = gain; }
  void set_autocentre(double share) { autocentre_ = share; }
  /// Clears all: the game has gone.
  void clear() { *this = {}; }
  std::size_t size() const { return loaded_.size(); }

  double force(const WheelPlace& wheel, double now_s) const;

 private:
  struct Loaded {
    ForceEffect effect;
    std::optional<double> began_s;
    int times = 1;
  };
  std::map<std::int16_t, Loaded> loaded_;
  double gain_ = 1.0, autocentre_ = 0.0;
};

}  // namespace septet::car_io
