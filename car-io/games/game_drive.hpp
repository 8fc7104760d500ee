#pragma once
/// A commercial game driven from the car: the actuators' commands from its telemetry and its force effects, and their
/// times of rest.
///
/// Telemetry silent for 200 ms is a menu, or a game that has gone or hangs: fan, shaker and the game's force fade in
/// 200 ms, and return over a second when it goes on. A game that never sent telemetry keeps its force. The emergency
/// stop, and a car whose reports stop, cut everything until the re-arm button has been held for a second; so do `cut`
/// and a lost CAN bus. At the beginning, and on re-arming, a tenth of a second of rest is sent, which arms a device
/// (car-io/firmware), and everything rises over a second. Of several formats the one that carries the speed decides. No
/// socket, device or clock of its own; one thread.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "car-io/actuator_guard.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/games/force_effects.hpp"
#include "car-io/games/telemetry.hpp"
#include "car-io/vibration_dose.hpp"

namespace septet::car_io {

class GameDrive {
 public:
  GameDrive(const rig::CarActuators& limits, double steering_lock_rad)
      : limits_(limits), steering_lock_rad_(steering_lock_rad) {}

  /// Takes a datagram of this format; an invalid one is counted and changes nothing.
  void receive(const TelemetryFormat& format, std::span<const std::byte> datagram, double now_s);
  /// Present commands of the actuators; call it a hundred times a second or more.
  Actuators actuate(const CarReading& reading, const ForceEffects& effects, double now_s);
  /// Empty without telemetry: then the cluster rests.
  std::optional<Instruments> instruments(double now_s) const;

  /// Brings the moving actuators to 0 for this reason until they are re-armed; no effect while they are cut, or rest
  /// before arming.
  void cut(const std::string& why);
  /// For the cluster: its loss cuts, and re-arming waits for its return.
  void set_bus_lost(bool is_lost);
  /// Re-arms the actuators from the terminal, also a device that has cut itself off; without effect while the emergency
  /// stop is pressed, or the CAN bus is lost.
  void rearm();

  std::uint64_t refused_datagrams() const { return refused_; }
  bool is_cut() const { return guard_.is_cut; }
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

 private:
  /// The latest telemetry of one format.
  struct Told {
    GameTelemetry telemetry;
    double at_s = 0.0;
  };
  std::optional<double> told_s() const;
  bool is_told(double now_s) const;
  void watch(const CarReading& reading, double dt_s);
  double wheel_force(const CarReading& reading, const ForceEffects& effects, double now_s, double dt_s);

  rig::CarActuators limits_;
  double steering_lock_rad_;
  GameTelemetry now_;
  double bump_ = 0.0, blow_ = 0.0;                    ///< Remainders of the latest.
  std::map<std::string, Told, std::less<>> told_by_;  ///< By the format's name.
  std::optional<double> speed_told_s_, other_told_s_, stepped_s_;
  ActuatorGuard guard_;
  DoseLimit dose_;
  bool was_fresh_ = false, stop_is_pressed_ = false, bus_is_lost_ = false, has_told_refusal_ = false;
  double awake_ = 1.0;  ///< 0: the telemetry has fallen silent.
  double resting_s_ = 0.1, rearm_held_s_ = 0.0, fan_ = 0.0, vibration_ = 0.0, force_ = 0.0;
  WheelPlace wheel_;
  std::uint64_t refused_ = 0;
  std::vector<std::string> messages_;
};

}  // namespace septet::car_io
