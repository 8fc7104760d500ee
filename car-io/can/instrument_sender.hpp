#pragma once
/// Sends the instruments' messages, each at its DBC file's rate, in any state of the bus.
///
/// The latest values are sent; without new ones for `silent_after_s` the instruments rest (speed 0, no lamp lit,
/// ignition on), and the messages go on: they are the cluster's keep-alive. A full queue drops frames and is reported
/// once; an interface that is down or gone is opened again every `retry_s`. A late sender sends each message once, and
/// no backlog.
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
  double stuck_after_s = 0.25;  ///< A queue full for this long: no node acknowledges.
};

class InstrumentSender {
 public:
  InstrumentSender(OpenCanBus open, CanPlan plan, InstrumentSenderOptions options = {});

  void set(const Instruments& instruments, double now_s);
  /// Sends due messages; returns the time of the next one.
  double pump(double now_s);
  /// Final messages of a drive: everything at rest, ignition off, once each.
  void finish(double now_s);
  /// Report for a person since the last call: a lost interface, a full queue, a controller off the bus, and the
  /// recovery.
  std::optional<Error> take_error();

  struct Counts {
    std::uint64_t sent = 0, dropped = 0,
                  lost = 0;  ///< Frames sent, dropped at a full queue, and losses of the interface.
  };
  const Counts& counts() const { return counts_; }
  /// The cluster is unreachable: the interface was there and is gone, the controller is off the bus, or the queue stays
  /// full.
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
  std::vector<std::optional<double>> due_s_;  ///< Due time of each sent message; empty: at once.
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
  ~InstrumentThread();  ///< Sends the final messages.
  void set(const Instruments& instruments);
  std::optional<Error> take_error();
  bool is_lost() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::car_io
