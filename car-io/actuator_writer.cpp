#include "car-io/actuator_writer.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "car-io/actuator_guard.hpp"

namespace septet::car_io {
namespace {

using Clock = std::chrono::steady_clock;

/// The device's own watchdog: 25 periods of the reports.
constexpr std::uint16_t watchdog_ms = 250;

Clock::duration duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

struct ActuatorWriter::State {
  State(OpenHidDevice opener, const ActuatorWriterOptions& chosen) : open(std::move(opener)), options(chosen) {
    guard.fall_s = options.silent_after_s;
    guard.rise_s = options.rise_s;
  }

  void run() {
    std::unique_lock lock(mutex);
    for (auto due = Clock::now(); !stopping; due = std::max(due + duration(options.period_s), Clock::now())) {
      if (changed.wait_until(lock, due, [&] { return stopping; })) break;
      const Actuators wanted = guarded();
      lock.unlock();
      auto error = write(wanted);
      lock.lock();
      if (error) problem = std::move(error);
    }
    lock.unlock();
    // The last command is zero, even if a report has just failed.
    for (int tries = 0; tries < 2 && (tries == 0 || !device); ++tries) {
      next_try = {};
      write({});
    }
  }

  /// The full command while it is renewed, then down to nothing.
  Actuators guarded() {
    const auto now = Clock::now();
    const bool is_silent = watch_silence(now);
    if (!is_silent && !options.sticky) guard.rearm();
    return guard.pass(newest, std::chrono::duration<double>(now - std::exchange(guarded_at, now)).count());
  }

  /// True if the command is not renewed, which cuts.
  bool watch_silence(Clock::time_point now) {
    const bool is_silent = now - set_at > duration(options.silent_after_s) && !is_rest(newest);
    if (guard.trip(is_silent) && options.sticky && options.tells_cut)
      problem = Error{fmt::format("fan, shaker and wheel force are cut, for the simulation was silent for {:.0f} ms",
                                  options.silent_after_s * 1000.0),
                      "the car's device", "look why; re-arm them, or pause the drive and go on"};
    return is_silent;
  }

  std::optional<Error> write(const Actuators& actuators) {
    std::optional<Error> fault;
    if (!device) {
      if (Clock::now() < next_try) return std::nullopt;
      next_try = Clock::now() + duration(options.retry_s);
      auto opened = open();
      if (!opened) {
        refusals = 0;  // The device is missing, which is no refusal.
        return std::nullopt;
      }
      device = std::move(*opened);
      fault = set_watchdog();
    }
    auto written = device->write(encode_actuators(actuators, ++sequence));
    if (written && options.has_steering_force) written = device->write(encode_steering(actuators.steering, sequence));
    if (written) {
      refusals = 0;
      // For a present device: one unplugged in between has not replied.
      if (fault && std::exchange(told_of_watchdog, true)) fault.reset();
      return fault;
    }
    device.reset();
    next_try = Clock::now() + duration(options.retry_s);
    // The first failure may be the unplugging; one right after reopening is a refusal.
    if (++refusals != 2) return std::nullopt;
    return Error{"it takes no output reports: " + written.error().what, written.error().where,
                 "check the rig's [car] layout against the device"};
  }

  /// The second safety net, for the case that this program can no longer write zeros: killed, stopped, the machine
  /// gone. Reading it back shows whether the device has accepted it.
  std::optional<Error> set_watchdog() {
    const auto sent = device->send_feature(encode_device_status({.watchdog_ms = watchdog_ms}));
    const auto kept = sent ? device->get_feature(device_report_id, device_report_bytes) : tl::unexpected(sent.error());
    const auto status = kept ? decode_device_status(*kept) : tl::unexpected(kept.error());
    if (status && status->watchdog_ms == watchdog_ms) return std::nullopt;
    const std::string answer = status ? fmt::format("it says {} ms", status->watchdog_ms) : status.error().what;
    return Error{fmt::format("its watchdog does not hold {} ms ({}): fan, shaker and wheel force would go on if this "
                             "program were killed",
                             watchdog_ms, answer),
                 "the car's device",
                 "correct its firmware (feature report 3), and keep a hand on the emergency switch"};
  }

  // Used by the thread alone.
  OpenHidDevice open;
  ActuatorWriterOptions options;
  std::unique_ptr<HidDevice> device;
  Clock::time_point next_try = Clock::now();
  std::uint8_t sequence = 0;
  int refusals = 0;
  bool told_of_watchdog = false;

  // Shared.
  std::mutex mutex;
  std::condition_variable changed;
  bool stopping = false;
  Actuators newest;
  Clock::time_point set_at = Clock::now(), guarded_at = Clock::now();
  ActuatorGuard guard;
  std::optional<Error> problem;
  std::thread thread;
};

ActuatorWriter::ActuatorWriter(OpenHidDevice open, const ActuatorWriterOptions& options) {
  if (!options.layout->has_actuators) return;
  state_ = std::make_unique<State>(std::move(open), options);
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

ActuatorWriter::~ActuatorWriter() {
  if (!state_) return;
  {
    const std::lock_guard lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  state_->thread.join();
}

void ActuatorWriter::set(const Actuators& actuators) {
  if (!state_) return;
  const std::lock_guard lock(state_->mutex);
  const auto now = Clock::now();
  // A program that was stopped and continued may get here before its thread notices the silence.
  if (state_->options.sticky) state_->watch_silence(now);
  state_->newest = actuators;
  state_->set_at = now;
  if (is_rest(actuators)) state_->guard.rearm();
}

void ActuatorWriter::stop() {
  if (!state_) return;
  const std::lock_guard lock(state_->mutex);
  state_->guard.stop();
}

bool ActuatorWriter::is_cut() const {
  if (!state_) return false;
  const std::lock_guard lock(state_->mutex);
  return state_->guard.is_cut;
}

std::optional<Error> ActuatorWriter::take_error() {
  if (!state_) return std::nullopt;
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->problem, std::nullopt);
}

}  // namespace septet::car_io
