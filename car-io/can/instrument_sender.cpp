#include "car-io/can/instrument_sender.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include "car-io/can/signal_codec.hpp"

namespace septet::car_io {
namespace {

/// Sent frames: with these signals, and with this identifier under any selection.
struct SentCounts {
  std::uint8_t of_selection = 0, of_message = 0;
};

CanFrame frame_of(const SentMessage& sent, const Instruments& instruments, SentCounts counts) {
  CanFrame frame{sent.message.id, sent.message.is_extended, sent.message.is_fd, sent.message.bytes, {}};
  const auto data = std::span(frame.data).first(frame.bytes);
  for (const SentSignal& signal : sent.signals) {
    double value = 0.0;
    const std::uint8_t count = signal.signal.selected_by ? counts.of_selection : counts.of_message;
    if (const auto* constant = std::get_if<double>(&signal.carries))
      value = *constant;
    else if (const auto* instrument = std::get_if<double Instruments::*>(&signal.carries))
      value = instruments.**instrument;
    else
      value = signal.signal.bits < 8 ? count & ((1u << signal.signal.bits) - 1u) : count;
    dbc::encode(signal.signal, value, data);
  }
  return frame;
}

/// Instruments without news of the car's motion: a pause, or a server that hangs.
constexpr Instruments resting{.ignition = 1.0};

}  // namespace

InstrumentSender::InstrumentSender(OpenCanBus open, CanPlan plan, InstrumentSenderOptions options)
    : open_(std::move(open)),
      plan_(std::move(plan)),
      options_(options),
      due_s_(plan_.sent.size()),
      sent_of_(plan_.sent.size()) {}

void InstrumentSender::set(const Instruments& instruments, double now_s) {
  newest_ = instruments;
  set_at_s_ = now_s;
}

void InstrumentSender::tell(Error error) {
  if (error.what == last_reason_) return;
  last_reason_ = error.what;
  constexpr std::size_t most_waiting = 16;
  if (errors_.size() < most_waiting) errors_.push_back(std::move(error));
}

std::optional<Error> InstrumentSender::take_error() {
  if (errors_.empty()) return std::nullopt;
  Error first = std::move(errors_.front());
  errors_.erase(errors_.begin());
  return first;
}

bool InstrumentSender::is_open(double now_s) {
  if (bus_) return true;
  if (next_try_s_ && now_s < *next_try_s_) return false;
  next_try_s_ = now_s + options_.retry_s;
  auto opened = open_();
  if (!opened) {
    tell(std::move(opened.error()));
    return false;
  }
  bus_ = std::move(*opened);
  if (counts_.lost > 0) tell({"the instruments are sent again", "CAN bus", "nothing to do"});
  return true;
}

void InstrumentSender::lose(const Error& error, double now_s) {
  bus_.reset();
  is_off_ = is_stuck_ = false;
  full_since_s_.reset();
  ++counts_.lost;
  next_try_s_ = now_s + options_.retry_s;
  tell(error);
}

void InstrumentSender::send(std::size_t message, const Instruments& instruments, double now_s) {
  SentCounts counts{.of_selection = sent_of_[message]};
  const auto& ours = plan_.sent[message].message;
  for (std::size_t i = 0; i < plan_.sent.size(); ++i)
    if (plan_.sent[i].message.id == ours.id && plan_.sent[i].message.is_extended == ours.is_extended)
      counts.of_message = static_cast<std::uint8_t>(counts.of_message + sent_of_[i]);
  const auto sent = bus_->send(frame_of(plan_.sent[message], instruments, counts));
  if (!sent) return lose(sent.error(), now_s);
  if (*sent) {
    ++counts_.sent;
    ++sent_of_[message];
    // A controller that leaves the bus takes frames until its queue is full; a later accepted frame means that it is
    // back.
    if (full_since_s_) is_off_ = false;
    is_stuck_ = false;
    full_since_s_.reset();
    if (std::exchange(is_full_, false)) tell({"the instruments' frames leave again", "CAN bus", "nothing to do"});
    return;
  }
  ++counts_.dropped;
  if (!full_since_s_) full_since_s_ = now_s;
  is_stuck_ = now_s - *full_since_s_ >= options_.stuck_after_s;
  if (!std::exchange(is_full_, true))
    tell({"its queue is full and the instruments' frames are dropped", "CAN bus",
          "check that a cluster with power is connected, the bit rate, and both 120 ohm resistors"});
}

double InstrumentSender::pump(double now_s) {
  const bool is_silent = !set_at_s_ || now_s - *set_at_s_ > options_.silent_after_s;
  double next_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plan_.sent.size(); ++i) {
    const double period_s = plan_.sent[i].period_s;
    if (!due_s_[i] || now_s >= *due_s_[i]) {
      due_s_[i] = std::max(due_s_[i].value_or(now_s) + period_s, now_s);
      if (is_open(now_s)) send(i, is_silent ? resting : newest_, now_s);
    }
    next_s = std::min(next_s, *due_s_[i]);
  }
  if (bus_) {
    // Frames of others fill the socket unless they are drained; the controller's notices are among them.
    constexpr int most_taken = 1000;
    for (int i = 0; i < most_taken; ++i) {
      const auto received = bus_->receive();
      if (!received) {
        lose(received.error(), now_s);
        break;
      }
      if (!*received) break;
    }
    if (auto notice = bus_ ? bus_->take_notice() : std::nullopt) {
      is_off_ = notice->is_off;
      if (is_off_) full_since_s_.reset();  // An earlier refusal tells nothing about its return.
      tell(std::move(notice->told));
    }
  }
  return next_s;
}

void InstrumentSender::finish(double now_s) {
  for (std::size_t i = 0; i < plan_.sent.size(); ++i)
    if (bus_) send(i, {}, now_s);
}

struct InstrumentThread::State {
  explicit State(InstrumentSender taken) : sender(std::move(taken)) {}

  static double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  void run() {
    std::unique_lock lock(mutex);
    while (!stopping) {
      const double wait_s = std::clamp(sender.pump(now_s()) - now_s(), 0.0005, 0.1);
      changed.wait_for(lock, std::chrono::duration<double>(wait_s), [&] { return stopping; });
    }
    sender.finish(now_s());
  }

  std::mutex mutex;
  std::condition_variable changed;
  bool stopping = false;
  InstrumentSender sender;
  std::thread thread;
};

InstrumentThread::InstrumentThread(InstrumentSender sender) : state_(std::make_unique<State>(std::move(sender))) {
  state_->thread = std::thread([state = state_.get()] { state->run(); });
}

InstrumentThread::~InstrumentThread() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  state_->thread.join();
}

void InstrumentThread::set(const Instruments& instruments) {
  const std::lock_guard lock(state_->mutex);
  state_->sender.set(instruments, State::now_s());
}

bool InstrumentThread::is_lost() const {
  const std::lock_guard lock(state_->mutex);
  return state_->sender.is_lost();
}

std::optional<Error> InstrumentThread::take_error() {
  const std::lock_guard lock(state_->mutex);
  return state_->sender.take_error();
}

}  // namespace septet::car_io
