#pragma once
/// A CAN bus: SocketCAN behind a seam that a simulated bus fills, too.
///
/// Threads: one at a time. Errors: an interface that is down or gone returns an Error from every call; close the bus and open it anew.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/core/expected.hpp"

namespace septet::car_io {

struct CanFrame {
  std::uint32_t id = 0;
  bool is_extended = false;
  bool is_fd = false;
  std::uint8_t bytes = 0;
  std::array<std::byte, 64> data{};

  std::span<const std::byte> payload() const { return std::span(data).first(bytes); }
  bool operator==(const CanFrame&) const = default;
};

/// What a controller says of its bus.
struct CanNotice {
  Error told;           ///< For a person.
  bool is_off = false;  ///< It has left the bus (bus-off) and sends nothing; otherwise it is there again.
};

class CanBus {
 public:
  virtual ~CanBus() = default;
  /// Never waits. False: the queue is full and the frame is dropped (nobody else is on the bus, or it is overloaded).
  virtual Expected<bool> send(const CanFrame& frame) = 0;
  /// The next frame that waits, or nothing. Never waits.
  virtual Expected<std::optional<CanFrame>> receive() = 0;
  /// What the controller has said of the bus since the last call (bus-off, restarted); of several the last.
  virtual std::optional<CanNotice> take_notice() = 0;
};

using OpenCanBus = std::function<Expected<std::unique_ptr<CanBus>>()>;

/// The interface must be there, up, and fit for CAN FD where that is needed.
Expected<std::unique_ptr<CanBus>> open_socket_can(const std::string& interface, bool needs_fd);

/// A socket that speaks in Linux' can_frame and canfd_frame, which it takes over and closes.
std::unique_ptr<CanBus> can_bus_of_socket(int socket, std::string name);

}  // namespace septet::car_io
