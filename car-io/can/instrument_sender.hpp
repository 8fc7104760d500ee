#pragma once
/// Sends the instruments' messages, each as often as its DBC file says, whatever happens to the bus.
///
/// What was set last is sent; while nobody has set anything for `silent_after_s` the instruments rest (speed 0, no lamp
/// lit, ignition on), and the messages go on: they are the cluster's keep-alive. A full queue drops frames and is told once; an interface
/// that is down or gone is opened again every `retry_s`. A sender that is late sends each message once, and no backlog.
///
/// `InstrumentSender` has no thread and no clock; `InstrumentThread` runs one.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_plan.hpp"

namespace septet::car_io {

struct InstrumentSenderOptions {
  double silent_after_s = 0.2;
  double retry_s = 0.5;
  double stuck_after_s = 0.25;  ///< A queue that is full for so long: nobody acknowledges.
};

class InstrumentSender {
 public:
  InstrumentSender(OpenCanBus open, CanPlan plan, InstrumentSenderOptions options = {});

  void set(const Instruments& instruments, double now_s);
  /// Sends what is due; returns when the next message is.
  double pump(double now_s);
  /// The last word of a drive: everything at rest, ignition off, once each.
  void finish(double now_s);
  /// What a person should know since the last call: a lost interface, a full queue, a controller off the bus, and that it is well again.
  std::optional<Error> take_error();

  struct Counts {
    std::uint64_t sent = 0, dropped = 0,
                  lost = 0;  ///< Frames sent, dropped at a full queue, and times the interface was lost.
  };
  const Counts& counts() const { return counts_; }
  /// Nothing reaches the cluster: the interface was there and is not now, the controller is off the bus, or the queue stays full.
  bool is_lost() const { return (counts_.lost > 0 && !bus_) || is_off_ || is_stuck_; }

 private:
  void send(std::size_t message, const Instruments& instruments, double now_s);
  bool is_open(double now_s);
  void lose(const Error& error, double now_s);
  void tell(Error error);

  OpenCanBus open_;
  CanPlan plan_;
  InstrumentSenderOptions options_;
  std::unique_ptr<CanBus> bus_;
  std::optional<double> next_try_s_;
  std::vector<std::optional<double>> due_s_;  ///< Of each sent message; nothing: at once.
  std::vector<std::uint8_t> sent_of_;         ///< Frames of each, wrapping.
  Instruments newest_;
  std::optional<double> set_at_s_;
  bool is_full_ = false, is_off_ = false, is_stuck_ = false;
  std::optional<double> full_since_s_;
  Counts counts_;
  std::vector<Error> errors_;
  std::string last_reason_;
};

class InstrumentThread {
 public:
  explicit InstrumentThread(InstrumentSender sender);
  ~InstrumentThread();  ///< Sends the last word.
  void set(const Instruments& instruments);
  std::optional<Error> take_error();
  bool is_lost() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::car_io
