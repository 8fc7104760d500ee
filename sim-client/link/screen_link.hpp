#pragma once
/// Screen's side of both lanes: connects, subscribes, receives ticks and scene, acknowledges, and reconnects by itself.
///
/// Reaches sockets only through DatagramSocket, and time only as an argument, so that tests run several of them on a
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
#include "sim-client/link/heard_events.hpp"

namespace septet::screen {

/// Opens the socket of the tick lane's group, once the server has named it.
using OpenGroup = std::function<Expected<std::unique_ptr<net::DatagramSocket>>(const net::Address& group,
                                                                               std::uint32_t interface_ip)>;

struct ScreenLinkOptions {
  std::string screen;           ///< Name in the rig.
  std::uint16_t tick_port = 0;  ///< Port of `tick_socket`, announced to the server for unicast ticks.
  net::SecureClientOptions lane;
};

class ScreenLink {
 public:
  /// `lane_socket` and `tick_socket` must outlive the link.
  ScreenLink(net::DatagramSocket& lane_socket, net::DatagramSocket& tick_socket, OpenGroup open_group,
             ScreenLinkOptions options);

  void pump(double now_s);

  /// State of the connection to the server. Lost: the last ticks stay in the history.
  net::ClientState state() const { return lane_.state(); }
  /// True once the server has been silent longer than a driver should mistake for a standstill. Time without pumping
  /// hardly counts: a screen that draws for seconds is dropped by the server, and finds it again at once.
  bool server_is_gone() const { return unheard_s_ > gone_after_s; }
  const std::optional<control::Welcome>& welcome() const { return welcome_; }
  /// Number of the server's welcomes: a new one may bring another rig and other times.
  std::uint32_t welcomes() const { return welcomes_; }
  /// Reason that this screen cannot go on by itself: the group cannot be heard, or the scene cannot be read.
  const std::optional<Error>& refusal() const { return refusal_; }
  bool finished() const { return finished_; }
  /// Notice to the driver, if this is the screen ahead.
  const control::Notice& notice() const { return notice_; }
  /// True while an operator watches this screen closely.
  bool is_looked_at(double now_s) const { return looked_at_until_s_ > now_s; }
  /// Events of the connection since the last call, for the terminal.
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

  /// Answers to an editor's lines since the last call.
  std::vector<control::OperatorAnswer> take_operator_answers() { return std::exchange(operator_answers_, {}); }

  /// Asks for the drive's events from now on, also after a new connection.
  void hear_events();
  /// True if all events that this tick counts have been heard.
  bool has_events_of(const frame::HistoryTick& tick) const { return events_.has(tick.header.events); }
  HeardEvents& events() { return events_; }

  const frame::TickHistory& history() const { return history_; }
  const scene::Store& scene() const { return scene_.store(); }
  /// By which an editor asks for changes.
  replication::ReplicationClient& replication() { return scene_; }
  const replication::ReplicationClient& replication() const { return scene_; }
  /// Changes whenever `scene()` is a different store.
  std::uint64_t scene_generation() const { return scene_.generation(); }
  bool scene_arrived() const { return scene_arrived_; }
  /// Brings the scene to the tick that is drawn next: later changes are kept back until it is their turn.
  void show_scene(Tick tick);
  /// True in lockstep if the scene is the one that this tick shows: all of it has arrived, and nothing of a later tick, as
  /// at a screen for which the others did not wait; it shows the newer tick then.
  bool has_scene_of(const frame::HistoryTick& tick) const { return scene_.is_at(tick.header.scene_revision); }
  /// Time of the server's clock now; empty until a ping has come back.
  std::optional<double> server_time_s(double now_s) const;

  void send(const control::ControlMessage& message, net::Reliability reliability);
  /// Sends the report that Finish requests.
  void report(control::ScreenReport report);
  bool has_backlog() const { return lane_.has_backlog(); }
  void close() { lane_.close(); }

  const net::TickReceiverCounters& tick_counters() const { return ticks_.counters(); }
  /// Ticks refused, or unreadable for lack of their baseline.
  std::uint64_t refused_ticks() const { return refused_ticks_; }

 private:
  static constexpr double gone_after_s = 1.0;    ///< A living server returns four pings in this time.
  static constexpr double longest_step_s = 0.1;  ///< Longest time between two pumps that counts as listening.
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
  double unheard_s_ = 0.0;  ///< Time for which this end has listened without hearing the server.
  bool scene_arrived_ = false;
  bool is_welcome_ = false;  ///< True once welcomed on this connection.
  std::uint64_t refused_ticks_ = 0;
  net::ConnectionReport connection_;
  std::vector<std::string> messages_;
  std::vector<control::OperatorAnswer> operator_answers_;
  bool hears_events_ = false;
  HeardEvents events_;
  std::string refused_;  ///< Server's last refusal of this screen.
  std::uint64_t told_forged_ = 0;
  double told_s_ = 0.0;
};

}  // namespace septet::screen
