#pragma once
/// A CAN bus: SocketCAN behind an interface that a simulated bus implements, too.
///
/// Threads: one at a time. Errors: an interface that is down or gone returns an Error from every call; close the bus
/// and open it again.

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

/// A controller's notice about its bus.
struct CanNotice {
  Error told;           ///< For a person.
  bool is_off = false;  ///< It has left the bus (bus-off) and sends nothing; false: it is there again.
};

class CanBus {
 public:
  virtual ~CanBus() = default;
  /// Never waits. Returns false if the queue is full and the frame is dropped (no other node is on the bus, or it is
  /// overloaded).
  virtual Expected<bool> send(const CanFrame& frame) = 0;
  /// Next pending frame; empty: none. Never waits.
  virtual Expected<std::optional<CanFrame>> receive() = 0;
  /// The controller's last notice since the previous call (bus-off, restarted).
  virtual std::optional<CanNotice> take_notice() = 0;
};

using OpenCanBus = std::function<Expected<std::unique_ptr<CanBus>>()>;

/// The interface must exist, be up, and support CAN FD if needed.
Expected<std::unique_ptr<CanBus>> open_socket_can(const std::string& interface, bool needs_fd);

/// A socket that speaks in Linux' can_frame and canfd_frame, which it takes over and closes.
std::unique_ptr<CanBus> can_bus_of_socket(int socket, std::string name);

}  // namespace septet::car_io
