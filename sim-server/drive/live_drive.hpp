#pragma once
/// A drive that is being simulated: the car's device, the simulation and the session log, one tick after the other.

#include <algorithm>
#include <functional>
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

/// Where the driver's input comes from, and where the car's feedback goes.
struct DriverSeat {
  std::vector<std::unique_ptr<SeatDevice>> devices;  ///< Called in this order.
  std::unique_ptr<car_io::CarConnection> car;        ///< Null: only a screen's keyboard or gamepad.
  rig::CarActuators actuators;                       ///< Limits of the devices that move.
  bool shakes_by_sound = false;       ///< The sound has a channel of low frequencies, on which a shaker may hang.
  double steering_lock_rad = 7.85;    ///< Where the hand wheel ends.
  bool is_real_time = true;           ///< Only then is silence on the wall clock a fault.
  std::shared_ptr<RemoteCar> remote;  ///< Of a car on another machine.

  /// Whether a simulated driver drives, and not a person.
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
  /// The drive as it stands at tick 0.
  static Expected<std::unique_ptr<LiveDrive>> start(std::shared_ptr<const simulation::Model> model,
                                                    std::unique_ptr<traffic::TrafficEngine> traffic, DriverSeat seat);
  /// The drive as it stands in `state`, which is of this model: at a state that an earlier log of the drive kept.
  static std::unique_ptr<LiveDrive> start(std::shared_ptr<const simulation::Model> model, simulation::State state,
                                          DriverSeat seat);
  /// From here on everything is logged, the present tick first. `log` outlives the drive.
  void log_to(SessionLog& log);

  /// Between two ticks: done now and logged, so that the drive run again has it too. Error: this drive cannot do that, or not now.
  Expected<void> command(const simulation::OperatorCommand& command);
  /// The instructor's brake, 0 to 1, until the next word: from the next tick on the driver's input brakes at least so much and does not
  /// accelerate. What is logged is what was driven with.
  void brake(double share) { instructor_brake_ = share; }
  const simulation::State& state() const { return state_; }
  /// A fault beside the ticks (sound that has stopped): fan, shaker and wheel force fall to 0 until somebody re-arms.
  void cut_actuators(const std::string& why);
  /// Lets them run again, over a second. Answers why not.
  std::optional<std::string> rearm_actuators(const std::string& by);
  /// Why they are at 0; nothing while they run.
  const std::optional<std::string>& actuators_cut() const { return cut_why_; }
  bool has_actuators() const { return seat_.has_actuators() || seat_.shakes_by_sound; }
  /// Whom to tell of what happens, beside the log, with the simulated time.
  void watch_events(std::function<void(const simulation::Event&, double)> told) { told_ = std::move(told); }

  Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>& controls) override;
  std::optional<Error> take_error() override;
  logging::DriveEnd end() const override { return end_.value_or(logging::DriveEnd::failed); }
  std::shared_ptr<const TakenSnapshot> first() const override { return newest_; }
  /// A person is ready when a screen sends controls, or those of the device are no longer as they were found.
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
  simulation::State state_;
  double instructor_brake_ = 0.0;
  DriverInput held_;                       ///< The last controls from a screen: they come less often than ticks.
  std::optional<Tick> heard_tick_;         ///< When they came.
  std::vector<simulation::Event> events_;  ///< Since the last tick, to be logged with the next one.
  std::function<void(const simulation::Event&, double)> told_;
  SnapshotMemory memory_;
  std::shared_ptr<const TakenSnapshot> newest_;
  bool car_was_there_ = false;
  bool was_fresh_ = false, is_stale_ = false;  ///< Whether the controls have ever come, and whether they have stopped.
  bool stop_is_pressed_ = false,
       is_stopped_ = false;  ///< The emergency stop now, and since it was pressed until re-armed.
  int rearm_held_ticks_ = 0, resting_ticks_ = 0;
  std::optional<std::string> cut_why_;
  DriverWord word_;
  car_io::ActuatorGuard guard_;
  std::optional<road::RoadPosition> felt_at_;
  double bump_ = 0.0, blow_ = 0.0;  ///< What is left of the last.
  car_io::DoseLimit dose_;
  car_io::WheelTorqueState wheel_torque_;
  std::optional<DriverInput> found_;  ///< The device's controls before anybody touched them.
  double device_from_drive_s_;  ///< The device's clock, which begins with the wait for the driver, less simulated time.
  std::optional<logging::DriveEnd> end_;
  std::vector<std::string> messages_;
  MessageLimit limit_;  ///< Of what the device causes to be said.
};

}  // namespace septet::server
