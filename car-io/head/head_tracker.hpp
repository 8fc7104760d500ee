#pragma once
/// The head tracker of a rig: its UDP port, read once a tick, and the present pose of the head.
///
/// One thread. Never waits; of a flood it reads a bounded part each tick.

#include <optional>
#include <string>

#include "car-io/head/head_motion.hpp"
#include "engine/core/expected.hpp"
#include "engine/net/udp_socket.hpp"

namespace septet::car_io {

class HeadTracker {
 public:
  /// Error: the address is not this machine's, or the port is taken.
  static Expected<HeadTracker> open(const rig::HeadTracking& tracking);

  /// Writes the head of `dt_s` later into the input: its place and, while the tracker sends, its heading.
  void move(DriverInput& input, double dt_s);
  /// Message for the operator: the tracker has come, or has fallen silent.
  std::optional<std::string> take_message();
  const net::Address& address() const { return socket_.local_address(); }

 private:
  HeadTracker(rig::HeadTracking tracking, net::UdpSocket socket);

  rig::HeadTracking tracking_;
  net::UdpSocket socket_;
  HeadMotion motion_;
  bool was_tracked_ = false;
  std::optional<std::string> message_;
};

}  // namespace septet::car_io
