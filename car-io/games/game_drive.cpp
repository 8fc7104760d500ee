#include "car-io/games/game_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace septet::car_io {
namespace {

constexpr double silent_after_s = 0.2, falls_asleep_in_s = 0.2, wakes_in_s = 1.0, rearm_held_for_s = 1.0,
                 rests_for_s = 0.1;
constexpr double fan_full_in_s = 1.0, vibration_full_in_s = 0.2, force_full_in_s = 0.05, dies_in_s = 0.09;
constexpr double stop_within = 0.03;  // Share of the wheel's travel before its end.

bool carries(const TelemetryFormat& format, double GameTelemetry::*quantity) {
  return std::ranges::any_of(format.fields, [&](const TelemetryField& field) { return field.quantity == quantity; });
}

double towards(double from, double to, double most) { return std::clamp(to, from - most, from + most); }

}  // namespace

/// A game without new speeds is silent, whatever else it sends.
std::optional<double> GameDrive::told_s() const { return speed_told_s_ ? speed_told_s_ : other_told_s_; }

bool GameDrive::is_told(double now_s) const { return told_s() && now_s - *told_s() <= silent_after_s; }

void GameDrive::receive(const TelemetryFormat& format, std::span<const std::byte> datagram, double now_s) {
  const auto read = decode_telemetry(format, datagram, now_);
  if (!read) {
    ++refused_;
    if (!std::exchange(has_told_refusal_, true)) messages_.push_back(describe(read.error()));
    return;
  }
  const bool tells_speed = carries(format, &GameTelemetry::speed_mps);
  const auto before = told_by_.find(format.name);
  const bool is_first = before == told_by_.end();
  // A jolt is a change between two datagrams of one format: other formats come at any time in between.
  const CarMotion felt =
      motion_of(*read, is_first ? *read : before->second.telemetry, is_first ? 0.0 : now_s - before->second.at_s);
  if (carries(format, &GameTelemetry::vertical_mps2)) bump_ = std::max(bump_, felt.bump);
  if (tells_speed) blow_ = std::max(blow_, felt.blow);
  now_ = *read;
  told_by_.insert_or_assign(format.name, Told{*read, now_s});
  (tells_speed ? speed_told_s_ : other_told_s_) = now_s;
}

void GameDrive::watch(const CarReading& reading, double dt_s) {
  if (reading.switches.emergency_stop) {
    if (!stop_is_pressed_) messages_.emplace_back("EMERGENCY STOP: everything that moves is at 0");
    guard_.stop();
  }
  stop_is_pressed_ = reading.switches.emergency_stop;
  was_fresh_ = was_fresh_ || !reading.is_stale;
  if (guard_.trip(was_fresh_ && reading.is_stale))
    messages_.emplace_back("fan, shaker and wheel force are cut, for the car's reports have stopped");
  const double held_before_s = rearm_held_s_;
  rearm_held_s_ = reading.switches.rearm && !reading.is_stale && !stop_is_pressed_ ? rearm_held_s_ + dt_s : 0.0;
  if (held_before_s < rearm_held_for_s && rearm_held_s_ >= rearm_held_for_s) rearm();
}

void GameDrive::cut(const std::string& why) {
  const bool rests = resting_s_ > 0.0;
  if (!rests && guard_.trip(true))
    messages_.push_back("fan, shaker and wheel force are cut, for " + why + "; look why, then re-arm them");
}

void GameDrive::set_bus_lost(bool is_lost) {
  bus_is_lost_ = is_lost;
  if (is_lost) cut("the CAN bus is lost");
}

void GameDrive::rearm() {
  if (stop_is_pressed_ || bus_is_lost_) {
    messages_.emplace_back(stop_is_pressed_ ? "not re-armed: the emergency stop is still pressed"
                                            : "not re-armed: the CAN bus is still lost");
    return;
  }
  guard_.rearm();
  resting_s_ = rests_for_s;
  messages_.emplace_back("fan, shaker and wheel force are re-armed");
}

double GameDrive::wheel_force(const CarReading& reading, const ForceEffects& effects, double now_s, double dt_s) {
  const double share = std::clamp(reading.input.steering_wheel_rad / steering_lock_rad_, -2.0, 2.0);
  if (dt_s > 0.0) {
    const double speed_per_s = (share - wheel_.share) / dt_s;
    wheel_.change_per_s2 = (speed_per_s - wheel_.speed_per_s) / dt_s;
    wheel_.speed_per_s = speed_per_s;
  }
  wheel_.share = share;
  // A game that hangs leaves its force where it was.
  double wanted = awake_ * effects.force(wheel_, now_s);
  // The end stop overrides the game's force.
  const double beyond = (std::abs(share) - (1.0 - stop_within)) / stop_within;
  if (beyond > 0.0) {
    const double stop = std::min(beyond, 1.0);
    wanted = (1.0 - stop) * wanted - stop * std::copysign(1.0, share);
  }
  return force_ = towards(force_, std::clamp(wanted, -1.0, 1.0), dt_s / force_full_in_s);
}

Actuators GameDrive::actuate(const CarReading& reading, const ForceEffects& effects, double now_s) {
  const double dt_s = std::clamp(stepped_s_ ? now_s - *stepped_s_ : 0.0, 0.0, 0.1);
  stepped_s_ = now_s;
  watch(reading, dt_s);
  const bool is_silent = told_s() && !is_told(now_s);
  awake_ = std::clamp(awake_ + (is_silent ? -dt_s / falls_asleep_in_s : dt_s / wakes_in_s), 0.0, 1.0);
  const double left = std::exp(-dt_s / dies_in_s);
  CarMotion motion = told_s() ? motion_of(now_, now_, 0.0) : CarMotion{};
  bump_ *= left, blow_ *= left;
  motion.bump = bump_, motion.blow = blow_;
  Actuators wanted = actuators_for(motion, limits_);
  wanted.fan = awake_ * (fan_ = towards(fan_, wanted.fan, dt_s / fan_full_in_s));
  wanted.vibration = awake_ * (vibration_ = towards(vibration_, wanted.vibration, dt_s / vibration_full_in_s));
  wanted.steering = wheel_force(reading, effects, now_s, dt_s) * limits_.steering_most;
  // Not the command of rest, which would re-arm the writer.
  wanted.vibration_hz = std::max(wanted.vibration_hz, 1.0);
  if (resting_s_ > 0.0 && !guard_.is_cut) {
    resting_s_ -= dt_s;
    guard_.share = 0.0;
    return {};
  }
  const Actuators done = dose_.pass(guard_.pass(wanted, dt_s), limits_, dt_s);
  if (auto message = dose_.take_message()) messages_.push_back(std::move(*message));
  return done;
}

std::optional<Instruments> GameDrive::instruments(double now_s) const {
  return is_told(now_s) ? std::optional(instruments_of(now_)) : std::nullopt;
}

}  // namespace septet::car_io
