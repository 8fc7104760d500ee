#pragma once
/// The car's side of the secure lane (engine/control/CONTROL.md): the device's reports to the
/// server, the server's feedback to the device.
///
/// Reads the device as the server reads a local one, sends each report unchanged, and gives the reason when there is
/// none. Fan, shaker and hand wheel are moved by a thread of their own, which stops them when the server is silent.
/// Connects and reconnects by itself. Sockets only through DatagramSocket, time only as an argument. One thread.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "car-io/actuator_writer.hpp"
#include "car-io/car_connection.hpp"
#include "engine/control/control_message.hpp"
#include "engine/net/connection_report.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// Opener for the rig's device.
using FindDevice = std::function<OpenHidDevice(const rig::Car&)>;

class CarLink {
 public:
  /// The socket outlives the link.
  CarLink(net::DatagramSocket& socket, const net::SecureClientOptions& lane, FindDevice find_device);

  void pump(double now_s);
  /// Re-arms fan, shaker and wheel force for a person at this machine: acts as the re-arm button, held as long as
  /// needed.
  void rearm(double now_s) { rearm_until_s_ = now_s + 1.3; }

  net::ClientState state() const { return lane_.state(); }
  bool finished() const { return finished_; }
  /// Reason that this car cannot take part: from the server, or its rig's device is missing.
  const std::optional<Error>& refusal() const { return refusal_; }
  bool has_device() const { return connection_ != nullptr; }
  /// Events since the last call, for the terminal.
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }
  void close() { lane_.close(); }

 private:
  void on_control(std::span<const std::byte> bytes);
  void take_rig(const std::string& text);
  void report(double now_s);

  net::SecureClient lane_;
  net::ConnectionReport connection_report_;
  FindDevice find_device_;
  std::unique_ptr<CarConnection> connection_;
  std::unique_ptr<ActuatorWriter> writer_;
  const CarLayout* layout_ = nullptr;
  double rearm_until_s_ = 0.0;
  Bytes newest_;
  std::string problem_;
  bool is_welcome_ = false;  ///< On this connection.
  bool was_connected_ = false;
  std::uint32_t number_ = 0;
  double reported_s_ = -1.0;
  Tick feedback_tick_ = 0;
  bool finished_ = false;
  std::optional<Error> refusal_;
  std::vector<std::string> messages_;
};

}  // namespace septet::car_io
