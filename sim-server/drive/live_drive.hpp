#pragma once
/// A drive being simulated: the car's device, the simulation and the session log, tick by tick.

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "car-io/actuator_guard.hpp"
#include "car-io/actuators.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/vibration_dose.hpp"
#include "car-io/wheel_torque.hpp"
#include "engine/core/message_limit.hpp"
#include "engine/rig/rig.hpp"
#include "engine/simulation/operator_command.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/driver_word.hpp"
#include "sim-server/drive/seat/seat_device.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/host/remote_car.hpp"
#include "sim-server/host/tick_source.hpp"

namespace septet::server {

/// Source of the driver's input, and destination of the car's feedback.
struct DriverSeat {
  std::vector<std::unique_ptr<SeatDevice>> devices;  ///< Called in this order.
  std::unique_ptr<car_io::CarConnection> car;        ///< Null: only a screen's keyboard or gamepad.
  rig::CarActuators actuators;                       ///< Limits of the devices that move.
  bool shakes_by_sound = false;       ///< The sound has a low-frequency channel, to which a shaker may be connected.
  double steering_lock_rad = 7.85;    ///< Hand-wheel angle at the end stop.
  bool is_real_time = true;           ///< True: silence on the wall clock is a fault.
  std::shared_ptr<RemoteCar> remote;  ///< Set if the car is on another machine.

  /// True if a simulated driver drives, not a person.
  bool is_driven_by_a_device() const { return any(&SeatDevice::drives); }
  bool has_actuators() const { return any(&SeatDevice::moves); }
  bool is_bus_lost() const { return any(&SeatDevice::is_lost); }
  bool has_cut_itself() const { return any(&SeatDevice::has_cut); }
  bool any(bool (SeatDevice::*says)() const) const {
    return std::ranges::any_of(devices, [says](const auto& device) { return (*device.*says)(); });
  }
};

class LiveDrive final : public TickSource {
 public:
  /// Begins a drive at tick 0.
  static Expected<std::unique_ptr<LiveDrive>> start(std::shared_ptr<const simulation::Model> model,
                                                    std::unique_ptr<traffic::TrafficEngine> traffic, DriverSeat seat);
  /// Begins a drive at `state`, which is of this model: a state kept in an earlier log of the drive.
  static std::unique_ptr<LiveDrive> start(std::shared_ptr<const simulation::Model> model, simulation::State state,
                                          DriverSeat seat);
  /// Logs everything from here on, the present tick first. `log` outlives the drive.
  void log_to(SessionLog& log);
  /// Logs the crashes whose impact is not over, as far as they are known. Call it once, before the log is closed.
  void log_unfinished();

  /// Executes a command between two ticks and logs it, so that a repeated drive has it too. Error: this drive cannot
  /// execute it, or not now.
  Expected<void> command(const simulation::OperatorCommand& command);
  /// Instructor's brake, 0 to 1, until the next call: from the next tick on, the driver's input brakes at least that
  /// much and does not accelerate. The log has the resulting input.
  void brake(double share) { instructor_brake_ = share; }
  /// Changes of the scene that the storyboard has asked for since the last call, each a line of engine/scene/command_text.hpp.
  std::vector<std::string> take_scene_lines() { return std::exchange(scene_lines_, {}); }
  const simulation::State& state() const { return state_; }
  /// Reports a fault outside the ticks (the sound has stopped): fan, shaker and wheel force fall to 0 until somebody
  /// re-arms them.
  void cut_actuators(const std::string& why);
  /// Lets them run again, ramped up over a second. Returns the reason for a refusal.
  std::optional<std::string> rearm_actuators(const std::string& by);
  /// Reason for the cut; empty while they run.
  const std::optional<std::string>& actuators_cut() const { return cut_why_; }
  bool has_actuators() const { return seat_.has_actuators() || seat_.shakes_by_sound; }

  Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>& controls) override;
  std::optional<Error> take_error() override;
  logging::DriveEnd end() const override { return end_.value_or(logging::DriveEnd::failed); }
  std::shared_ptr<const TakenSnapshot> first() const override { return newest_; }
  /// True once a screen sends controls, or the device's controls differ from those found at first.
  bool driver_is_ready(const std::optional<DriverInput>& controls, double waited_s) override;
  void stand_still() override;
  std::string alarm() const override;
  std::string word_to_driver() const override { return seat_.is_driven_by_a_device() ? std::string() : word_.text(); }
  double shaking_share() const override { return dose_.is_reached() ? 0.0 : guard_.share; }
  double tick_rate_hz() const override { return simulation::tick_rate_hz; }
  std::vector<std::string> take_messages() override { return std::exchange(messages_, {}); }
  const Snapshot& newest() const { return newest_->snapshot(); }

 private:
  LiveDrive(std::shared_ptr<const simulation::Model> model, DriverSeat seat, simulation::State state);
  logging::InputRecord read_input(const std::optional<DriverInput>& controls);
  void watch_switches(const car_io::CarSwitches& switches);
  void watch_faults();
  void feel(const Snapshot& before, car_io::CarMotion& motion);
  void move_actuators(const Snapshot& before);
  void actuate(const car_io::Actuators& actuators);
  void show_instruments(const DriverInput& input);
  void keep_state();
  void tell(const std::string& what);

  std::shared_ptr<const simulation::Model> model_;
  DriverSeat seat_;
  SessionLog* log_ = nullptr;
  std::vector<simulation::OperatorCommand> unlogged_;  ///< Given before there was a log.
  simulation::State state_;
  double instructor_brake_ = 0.0;
  DriverInput held_;                       ///< The last controls from a screen, which arrive less often than ticks.
  std::optional<Tick> heard_tick_;         ///< Tick at which they arrived.
  std::vector<simulation::Event> events_;  ///< Since the last tick, to be logged with the next one.
  SnapshotMemory memory_;
  std::shared_ptr<const TakenSnapshot> newest_;
  bool car_was_there_ = false;
  bool was_fresh_ = false, is_stale_ = false;  ///< The controls have arrived at least once; they have stopped.
  bool stop_is_pressed_ = false,
       is_stopped_ = false;  ///< The emergency stop is pressed; it was pressed and has not been re-armed.
  int rearm_held_ticks_ = 0, resting_ticks_ = 0;
  std::optional<std::string> cut_why_;
  DriverWord word_;
  car_io::ActuatorGuard guard_;
  std::optional<road::RoadPosition> felt_at_;
  double bump_ = 0.0, blow_ = 0.0;  ///< Decaying remainders of the last bump and blow.
  car_io::DoseLimit dose_;
  car_io::WheelTorqueState wheel_torque_;
  std::optional<DriverInput> found_;  ///< The device's controls before anybody touched them.
  double device_from_drive_s_;  ///< Device clock, which starts with the wait for the driver, minus simulated time.
  std::optional<logging::DriveEnd> end_;
  std::vector<std::string> messages_, scene_lines_;
  MessageLimit limit_;  ///< For messages caused by the device.
};

}  // namespace septet::server
