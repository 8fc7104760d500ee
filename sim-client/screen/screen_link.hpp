#pragma once
/// A screen's side of both lanes: connects, subscribes, receives ticks and scene, acknowledges, and comes back by itself.
///
/// Knows sockets only through the DatagramSocket seam and time only as an argument, so that tests run several of them on a
/// bad network and simulated clocks. One thread.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/control/control_message.hpp"
#include "engine/net/connection_report.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/net/tick_receiver.hpp"
#include "engine/replication/replication_client.hpp"
#include "engine/scene/store.hpp"
#include "sim-client/frame/tick_history.hpp"

namespace septet::screen {

/// Opens the socket that hears the tick lane's group, when the server has named it.
using OpenGroup = std::function<Expected<std::unique_ptr<net::DatagramSocket>>(const net::Address& group,
                                                                               std::uint32_t interface_ip)>;

struct ScreenLinkOptions {
  std::string screen;           ///< Name in the rig.
  std::uint16_t tick_port = 0;  ///< Of `tick_socket`, told to the server for unicast ticks.
  net::SecureClientOptions lane;
};

class ScreenLink {
 public:
  /// `lane_socket` and `tick_socket` outlive the link.
  ScreenLink(net::DatagramSocket& lane_socket, net::DatagramSocket& tick_socket, OpenGroup open_group,
             ScreenLinkOptions options);

  void pump(double now_s);

  /// Whether the server is there now. Lost: the last ticks stay in the history.
  net::ClientState state() const { return lane_.state(); }
  /// Whether the server has been silent for as long as a driver should not mistake for a standstill. Time in which nobody
  /// pumped hardly counts: a screen that draws for seconds is dropped by the server, and finds it again at once.
  bool server_is_gone() const { return unheard_s_ > gone_after_s; }
  const std::optional<control::Welcome>& welcome() const { return welcome_; }
  /// Counts the server's welcomes: a new one may bring another rig and other times.
  std::uint32_t welcomes() const { return welcomes_; }
  /// Why this screen cannot go on by itself: the group cannot be heard, or the scene not be read.
  const std::optional<Error>& refusal() const { return refusal_; }
  bool finished() const { return finished_; }
  /// What the driver is to read, if this is the screen ahead.
  const control::Notice& notice() const { return notice_; }
  /// Whether somebody looks closely at this screen.
  bool is_looked_at(double now_s) const { return looked_at_until_s_ > now_s; }
  /// What happened to the connection since the last call, for the console.
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

  const frame::TickHistory& history() const { return history_; }
  const scene::Store& scene() const { return scene_.store(); }
  /// Changes whenever `scene()` is another store than before.
  std::uint64_t scene_generation() const { return scene_.generation(); }
  bool scene_arrived() const { return scene_arrived_; }
  /// The server's clock now, once a ping has come back.
  std::optional<double> server_time_s(double now_s) const;

  void send(const control::ControlMessage& message, net::Reliability reliability);
  /// Sends the report that answers Finish.
  void report(control::ScreenReport report);
  bool has_backlog() const { return lane_.has_backlog(); }
  void close() { lane_.close(); }

  const net::TickReceiverCounters& tick_counters() const { return ticks_.counters(); }
  /// Ticks that were refused or could not be read for want of their baseline.
  std::uint64_t refused_ticks() const { return refused_ticks_; }

 private:
  static constexpr double gone_after_s = 1.0;    ///< A living server answers four pings in it.
  static constexpr double longest_step_s = 0.1;  ///< From one pump to the next, as far as it counts as listening.
  static constexpr double refused_for_s = 5.0;
  void on_connected();
  void on_control(std::span<const std::byte> bytes, double now_s);
  void tell_of_forgeries(double now_s);
  void receive_ticks(double now_s);
  void pump_scene();

  ScreenLinkOptions options_;
  net::DatagramSocket& tick_socket_;
  OpenGroup open_group_;
  std::unique_ptr<net::DatagramSocket> group_socket_;
  net::SecureClient lane_;
  net::TickReceiver ticks_;
  frame::TickHistory history_;
  replication::ReplicationClient scene_;
  std::optional<control::Welcome> welcome_;
  std::uint32_t welcomes_ = 0;
  std::optional<Error> refusal_;
  bool finished_ = false;
  control::Notice notice_;
  double looked_at_until_s_ = -1e9;
  std::optional<double> pumped_s_;
  double unheard_s_ = 0.0;  ///< For how long this end has listened and heard nothing.
  bool scene_arrived_ = false;
  bool is_welcome_ = false;  ///< On this connection.
  std::uint64_t refused_ticks_ = 0;
  net::ConnectionReport connection_;
  std::vector<std::string> messages_;
  std::string refused_;  ///< What the server last said against this screen.
  std::uint64_t told_forged_ = 0;
  double told_s_ = 0.0;
};

}  // namespace septet::screen
