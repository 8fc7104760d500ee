#include "sim-server/drive/live_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "car-io/can/instruments.hpp"
#include "engine/audio/heard.hpp"
#include "engine/core/printable.hpp"
#include "engine/simulation/crash_recording.hpp"
#include "engine/simulation/examiner.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/world/scene_call.hpp"
#include "sim-server/drive/car_motion.hpp"
#include "sim-server/drive/kept_state.hpp"
#include "sim-server/drive/natural_end.hpp"

namespace septet::server {
namespace {

/// The last controls of a silent screen are held for this long. A screen sends them with every picture, and for two
/// seconds after the last key.
constexpr Tick silent_screen_ticks = 120;

constexpr auto saved_state_ticks = static_cast<Tick>(state_kept_every_s * simulation::tick_rate_hz);

/// The re-arm button must be held for this long, so that nobody presses it in passing.
constexpr int rearm_held_for_ticks = 120;
/// Actuators are re-armed by a command of rest. It is repeated, since one may be lost on its way to a car on another
/// machine.
constexpr int rest_after_rearming_ticks = 12;

/// True for a change beyond the noise of an untouched device.
bool is_moved(const DriverInput& now, const DriverInput& found) {
  constexpr double clearly = 0.1;  // Share of a pedal's travel; radians of the hand wheel.
  for (const auto control :
       {&DriverInput::steering_wheel_rad, &DriverInput::accelerator, &DriverInput::brake, &DriverInput::clutch})
    if (std::abs(now.*control - found.*control) > clearly) return true;
  return now.selector != found.selector || now.gear != found.gear || now.indicator != found.indicator ||
         now.hazard_lights != found.hazard_lights || now.horn != found.horn || now.low_beam != found.low_beam ||
         now.high_beam != found.high_beam || now.parking_brake != found.parking_brake;
}

}  // namespace

Expected<std::unique_ptr<LiveDrive>> LiveDrive::start(std::shared_ptr<const simulation::Model> model,
                                                      std::unique_ptr<traffic::TrafficEngine> traffic,
                                                      DriverSeat seat) {
  auto state = simulation::initial_state(*model, std::move(traffic));
  if (!state) return tl::unexpected(state.error());
  return start(std::move(model), std::move(*state), std::move(seat));
}

std::unique_ptr<LiveDrive> LiveDrive::start(std::shared_ptr<const simulation::Model> model, simulation::State state,
                                            DriverSeat seat) {
  return std::unique_ptr<LiveDrive>(new LiveDrive(std::move(model), std::move(seat), std::move(state)));
}

LiveDrive::LiveDrive(std::shared_ptr<const simulation::Model> model, DriverSeat seat, simulation::State state)
    : model_(std::move(model)),
      seat_(std::move(seat)),
      state_(std::move(state)),
      word_(seat_.car == nullptr),
      device_from_drive_s_(-state_.time_s()) {
  if (state_.tick > 0) events_ = simulation::notes_in_force(state_);
  newest_ = memory_.share(simulation::capture_snapshot(*model_, state_));
}

void LiveDrive::log_to(SessionLog& log) {
  log_ = &log;
  log_->record_tick(newest_, {});
  for (const simulation::OperatorCommand& command : std::exchange(unlogged_, {}))
    log_->record_command(state_.tick + 1, command);
  if (state_.tick > 0) keep_state();
}

logging::InputRecord LiveDrive::read_input(const std::optional<DriverInput>& controls) {
  logging::InputRecord record;
  record.tick = state_.tick + 1;
  if (model_->motion) {
    // Nobody drives; what comes free of its table rolls.
    record.input.selector = GearSelector::neutral;
    return record;
  }
  if (controls) {
    held_ = *controls;
    heard_tick_ = state_.tick;
  }
  record.input = held_;
  // A window without pressed keys is silent too, and holds no accelerator.
  if (!seat_.car && heard_tick_ && state_.tick - *heard_tick_ > silent_screen_ticks && held_.accelerator > 0.0) {
    record.input = car_io::released(held_);
    if (state_.diagnostics.input_stale_ticks++ % silent_screen_ticks == 0)
      tell("the screen that drives is silent: the accelerator is released");
  }
  if (seat_.car) {
    // The device's clock is simulated time, so that a slow machine does not see a stale driver.
    const auto reading = seat_.car->poll(device_from_drive_s_ + state_.time_s());
    if (reading.is_stale) ++state_.diagnostics.input_stale_ticks;
    was_fresh_ = was_fresh_ || !reading.is_stale;
    is_stale_ = was_fresh_ && reading.is_stale;
    record.input = reading.input;
    watch_switches(reading.switches);
    record.report = reading.report;
    if (const auto error = seat_.car->take_error()) tell(describe(*error));
    if (reading.is_connected && !car_was_there_ && state_.diagnostics.input_stale_ticks > 0)
      tell("the car's device is there");
    car_was_there_ = reading.is_connected;
  }
  return record;
}

bool LiveDrive::driver_is_ready(const std::optional<DriverInput>& controls, double waited_s) {
  if (controls) held_ = *controls;
  show_instruments(held_);
  if (controls || seat_.is_driven_by_a_device() || model_->motion) return true;
  if (!seat_.car) return false;
  device_from_drive_s_ = waited_s - state_.time_s();
  const auto reading = seat_.car->poll(waited_s);
  car_was_there_ = reading.is_connected;
  if (const auto error = seat_.car->take_error()) tell(describe(*error));
  if (!reading.is_connected || !reading.report) return false;
  if (!found_) found_ = reading.input;
  return is_moved(reading.input, *found_);
}

void LiveDrive::tell(const std::string& what) {
  const auto said = limit_.take(printable(what), state_.time_s());
  if (!said) return;
  messages_.push_back("car: " + *said);
  if (log_) log_->record_message("car", *said);
}

void LiveDrive::cut_actuators(const std::string& why) {
  if (cut_why_) return;
  cut_why_ = why;
  guard_.trip(true);
  if (log_) log_->record_message("actuators_cut", "why=" + printable(why));
  if (has_actuators())
    tell(fmt::format("fan, shaker and wheel force are cut, for {}; re-arm them, or pause the drive and go on", why));
}

void LiveDrive::watch_switches(const car_io::CarSwitches& switches) {
  if (switches.emergency_stop && !stop_is_pressed_) {
    is_stopped_ = true;
    guard_.stop();
    cut_why_ = "the emergency stop was pressed";
    if (log_) log_->record_message("emergency_stop", "pressed=1");
    tell(has_actuators()
             ? "EMERGENCY STOP: fan, shaker and wheel force are at 0 until it is released and somebody re-arms them"
             : "EMERGENCY STOP: it stands until it is released and somebody re-arms");
  } else if (!switches.emergency_stop && stop_is_pressed_) {
    if (log_) log_->record_message("emergency_stop", "pressed=0");
    tell("the emergency stop is released; the actuators wait to be re-armed");
  }
  stop_is_pressed_ = switches.emergency_stop;
  rearm_held_ticks_ = switches.rearm ? std::min(rearm_held_ticks_ + 1, rearm_held_for_ticks + 1) : 0;
  if (rearm_held_ticks_ == rearm_held_for_ticks && cut_why_) rearm_actuators("button");
}

std::optional<std::string> LiveDrive::rearm_actuators(const std::string& by) {
  if (!seat_.has_actuators() && !cut_why_) return "this drive moves no actuators";
  if (stop_is_pressed_) return "the emergency stop is still pressed";
  if (is_stale_) return "the controls are still silent";
  if (seat_.is_bus_lost()) return "the CAN bus is still lost";
  is_stopped_ = false;
  cut_why_.reset();
  guard_.rearm();
  guard_.share = 0.0;
  resting_ticks_ = rest_after_rearming_ticks;
  if (log_) log_->record_message("actuators_rearmed", "by=" + printable(by));
  tell("fan, shaker and wheel force are re-armed");
  return std::nullopt;
}

std::string LiveDrive::alarm() const {
  if (!is_stopped_) return {};
  return stop_is_pressed_ ? "Emergency stop" : "Emergency stop: released, waits to be re-armed";
}

/// Cuts the actuators if the controls, the bus or a device has stopped since the last tick.
void LiveDrive::watch_faults() {
  if (is_stale_) cut_actuators("the controls have stopped");
  if (seat_.is_bus_lost()) cut_actuators("the CAN bus is lost");
  // The device has reported the cut itself.
  if (!cut_why_ && resting_ticks_ == 0 && seat_.has_cut_itself()) {
    cut_why_ = "the simulation was silent";
    guard_.trip(true);
  }
}

/// Adds the vibrations of ground, bumps and blows that the shaker plays beside engine and wheels.
void LiveDrive::feel(const Snapshot& before, car_io::CarMotion& motion) {
  constexpr double dies_in_s = 0.09, tick_s = 1.0 / simulation::tick_rate_hz;
  const Snapshot& now = newest_->snapshot();
  const auto ground = audio::feel_ground(model_->roads, now, felt_at_, model_->car.body.wheelbase_m);
  motion.roughness = std::sqrt(ground.unevenness_m3 / audio::class_a_m3);
  motion.on_line = ground.on_line;
  const auto heard = audio::felt(now, before);
  const double left = std::exp(-tick_s / dies_in_s);
  bump_ = std::max(bump_ * left, std::min(heard.bump_mps, 1.0));
  blow_ = std::max(blow_ * left, std::min(heard.blow_mps / 3.0, 1.0));
  motion.bump = bump_;
  motion.blow = blow_;
}

void LiveDrive::move_actuators(const Snapshot& before) {
  watch_faults();
  constexpr double tick_s = 1.0 / simulation::tick_rate_hz;
  if (!seat_.has_actuators()) {
    guard_.pass({}, tick_s);  // Ramps the share that limits a shaker driven by sound.
    return;
  }
  auto motion = car_motion(*model_, state_);
  feel(before, motion);
  motion.steering_torque_nm = car_io::wheel_torque_nm(wheel_torque_,
                                                      {.column_torque_nm = motion.steering_torque_nm,
                                                       .wheel_rad = state_.input.steering_wheel_rad,
                                                       .speed_mps = motion.speed_mps,
                                                       .lock_rad = seat_.steering_lock_rad},
                                                      seat_.actuators.steering_full_nm, tick_s);
  const bool rests = resting_ticks_ > 0;
  if (rests) --resting_ticks_;
  const auto passed = rests ? car_io::Actuators{} : guard_.pass(car_io::actuators_for(motion, seat_.actuators), tick_s);
  const auto done = dose_.pass(passed, seat_.actuators, tick_s);
  if (const auto message = dose_.take_message()) tell(*message);
  if (log_ && logging::is_sample_due(state_.tick, simulation::tick_rate_hz))
    log_->record_actuators(
        {state_.tick, done.fan, done.vibration, done.vibration_hz, done.steering, cut_why_.has_value()});
  actuate(done);
}

void LiveDrive::actuate(const car_io::Actuators& actuators) {
  for (const auto& device : seat_.devices)
    if (const auto error = device->actuate(state_.tick, actuators)) tell(describe(*error));
}

void LiveDrive::show_instruments(const DriverInput& input) {
  const bool is_lost = seat_.car && (!car_was_there_ || is_stale_);
  for (const auto& device : seat_.devices) {
    if (!device->shows()) continue;
    if (const auto error =
            device->show(car_io::instruments_of(newest_->snapshot(), input, car_motion(*model_, state_), is_lost)))
      tell(describe(*error));
  }
}

/// Keeps no state if another program moves the traffic.
void LiveDrive::keep_state() {
  if (auto bytes = simulation::save_state(*model_, state_)) log_->record_state({state_.tick, std::move(*bytes)});
}

/// Ends the drive on a full disk: without its log, a drive is worthless for evaluation.
std::optional<Error> LiveDrive::take_error() {
  auto error = log_ ? log_->take_error() : std::nullopt;
  if (error) end_ = logging::DriveEnd::log_failed;
  return error;
}

Expected<void> LiveDrive::command(const simulation::OperatorCommand& command) {
  auto done = simulation::apply_operator_command(*model_, command, state_, events_);
  if (done && log_) log_->record_command(state_.tick + 1, command);
  if (done && !log_) unlogged_.push_back(command);
  return done;
}

void LiveDrive::stand_still() {
  // Controls are polled in a pause too, since somebody may press the emergency stop.
  if (seat_.car) watch_switches(seat_.car->poll(device_from_drive_s_ + state_.time_s()).switches);
  if (!seat_.has_actuators()) return;
  if (!is_stopped_) {
    guard_.rearm();
    cut_why_.reset();
  }
  actuate({});
}

void LiveDrive::log_unfinished() {
  if (log_) log_->record_events(simulation::unfinished_crashes(state_));
}

Expected<std::shared_ptr<const TakenSnapshot>> LiveDrive::next(const std::optional<DriverInput>& controls) {
  if (end_) return std::shared_ptr<const TakenSnapshot>();
  for (const auto& device : seat_.devices) device->see(newest_->snapshot(), state_.gone);
  logging::InputRecord input = read_input(controls);
  for (const auto& device : seat_.devices) {
    device->add_to(input.input);
    if (const auto message = device->take_message()) tell(*message);
  }
  if (instructor_brake_ > 0.0) {
    if (!(input.input.brake >= instructor_brake_)) input.input.brake = instructor_brake_;
    input.input.accelerator = 0.0;
  }
  std::vector<simulation::Event> events = std::exchange(events_, {});
  const auto before = newest_;
  newest_ = memory_.share(simulation::server_step(*model_, input.input, state_, events, memory_.spare()));
  move_actuators(before->snapshot());
  show_instruments(input.input);
  for (const auto& event : events) {
    if (event.kind == "traffic")
      messages_.push_back("the road holds another number of vehicles than the swarm was asked for: " + event.detail);
    if (auto line = scene_line_of(event.kind, event.detail)) scene_lines_.push_back(std::move(*line));
  }
  word_.take(newest_->snapshot(), events);
  if (auto error = state_.traffic->take_error()) {
    if (log_) log_->record_message("traffic", describe(*error));
    end_ = logging::DriveEnd::traffic_lost;
    return tl::unexpected(std::move(*error));
  }
  if (log_) {
    log_->record_input(std::move(input));
    log_->record_tick(newest_, events);
    if (state_.tick % saved_state_ticks == 0) keep_state();
    if (auto warning = log_->take_warning()) messages_.push_back(std::move(*warning));
  }
  end_ = natural_end(*model_, state_);
  // Who has not parted yet will not be waited for: the driver reads of it now.
  if (end_) word_.take(newest_->snapshot(), simulation::unfinished_crashes(state_));
  return newest_;
}

}  // namespace septet::server
