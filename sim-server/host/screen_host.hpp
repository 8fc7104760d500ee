#pragma once
/// The server's side of both lanes: connections, the scene for clients that ask for it, and every tick for all screens.
///
/// The host never waits for a screen: each tick is sent once, whatever the number of screens, and scene data that a
/// screen has not taken occupies a bounded queue. In lockstep the caller waits, by asking `all_presented`. Sockets only
/// through the DatagramSocket seam, time only as an argument. One thread.
///
/// Holders of a key in the list may send anything in any order: a client is bound to the name of its key, can be that
/// screen or that car and nothing else, and its messages affect only itself. Its texts are made printable and limited
/// in number. A client whose key has the word `look` or `edit` may watch: it is told the ticks and nothing waits for it.
/// One with `edit` may ask for changes of the scene; the host hands them over and makes none itself.

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/control/control_message.hpp"
#include "engine/core/message_limit.hpp"
#include "engine/net/baseline_tracker.hpp"
#include "engine/net/secure_server.hpp"
#include "engine/net/tick_publisher.hpp"
#include "engine/replication/replication_server.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"
#include "engine/world/taken_snapshot.hpp"
#include "logging/session/drive_end.hpp"
#include "sim-server/host/editor.hpp"
#include "sim-server/host/event_feed.hpp"
#include "sim-server/host/latency_record.hpp"
#include "sim-server/host/playout_planner.hpp"
#include "sim-server/host/remote_car.hpp"

namespace septet::server {

struct ScreenHostOptions {
  net::Identity identity;
  net::SessionId session{};
  std::vector<net::AllowedClient> allowed;
  net::ChannelLimits limits;
  control::Welcome welcome;
  std::vector<std::string> screens;  ///< Names that the rig knows; others are refused.
  std::shared_ptr<RemoteCar> car;    ///< The driver's car where it is on another machine; null: a car is refused.
  std::set<std::string> drivers;     ///< Screens whose keyboard or gamepad may drive.
  double least_playout_delay_s = 2.0 / 120.0;
  std::size_t max_datagram_bytes = 1200;
};

/// A client's batch of changes of the scene: done whole or not at all.
struct SceneRequest {
  net::ClientId client = 0;
  Editor editor;
  replication::ClientBatch batch;
};
/// A line of a client that may operate.
struct OperatorRequest {
  net::ClientId client = 0;
  std::string name;  ///< Of its key.
  std::uint32_t number = 0;
  std::string line;
};
/// Lines that may wait for the next tick.
inline constexpr std::size_t most_operator_lines = 64;
/// Commands of one editor that may wait for the next tick.
inline constexpr std::size_t most_edits = 50'000;

/// Maximum number of moments kept of each kind.
inline constexpr std::size_t most_moments = 100;

/// One screen of the rig, connected or not.
struct HostedScreen {
  std::string name;
  std::optional<net::ClientId> client;
  std::uint16_t tick_port = 0;  ///< Port for ticks by unicast.
  bool expected = false;        ///< A client with this name's key has connected; its Hello is on the way.
  bool scene_arrived = false;
  Tick presented = 0;
  bool has_presented = false;
  std::uint64_t frames = 0;
  double frame_ms = 0.0;  ///< Interval between the newest two pictures.
  LatencyRecord
      report_to_picture;  ///< From reading the driver's controls to its message that it shows that tick; in real time.
  std::uint64_t lost_baselines = 0;  ///< Ticks that could not be decoded because their baseline was lost.
  std::uint32_t joined = 0;          ///< Number of connections.
  double joined_s = 0.0;             ///< Time of the newest connection.
  std::optional<Tick> joined_at;     ///< The newest tick then; its own ticks come after. Empty before the first.
  bool left_behind = false;          ///< Lockstep does not wait for it until it shows a tick.
  std::optional<control::ScreenReport> report;
  std::shared_ptr<const std::string> thumbnail;  ///< The newest, any bytes; null: none yet.
  Tick thumbnail_tick = 0;
  std::shared_ptr<const std::string> large_picture;  ///< For an operator who watches; null: nobody watches.
  std::optional<double> asked_to_look_s;             ///< Time when it was last asked for large pictures.
  std::vector<double> connected_s, left_s,
      left_behind_s;  ///< Simulated times; at most `most_moments` each: the first and the newest.
  std::optional<double> unanswered_since_s;  ///< Time of the first tick sent that it has not acknowledged.

  bool live() const { return client.has_value(); }
};

class ScreenHost {
 public:
  /// The sockets and the store outlive the host.
  ScreenHost(net::DatagramSocket& lane_socket, net::DatagramSocket& tick_socket, const scene::Store& store,
             ScreenHostOptions options);

  /// Receives and handles messages, and sends as much of the scene as the lanes take now.
  void pump(double now_s);
  bool has_backlog() const { return lane_.has_backlog(); }

  /// Sets the clients that may connect. A connected client that is no longer in the list is disconnected at once.
  void set_allowed(std::vector<net::AllowedClient> allowed) {
    options_.allowed = allowed;
    lane_.set_allowed(std::move(allowed));
  }

  /// The batches of scene changes that clients have asked for since the last call, in the order of their arrival. Those of
  /// clients without the right, and those beyond `most_edits` waiting, are refused already.
  std::vector<SceneRequest> take_scene_requests();
  /// The lines that clients have sent since the last call. Those of clients without the right are answered already.
  std::vector<OperatorRequest> take_operator_requests() { return std::exchange(operator_requests_, {}); }
  void answer(const OperatorRequest& request, const std::optional<std::string>& why_not, Tick tick);
  /// True while this client is connected.
  bool has(net::ClientId client) const { return clients_.contains(client); }
  /// The rights of a name in the list; none for a name that is no longer there.
  net::Rights rights_of(const std::string& name) const;
  /// Call after every command that was applied to the store; `from`: the first tick that shows it.
  void scene_changed(const scene::Command& command, Tick from) { scene_.applied(command, from); }
  /// Something happened in the drive: told to the clients that asked for it, with the next pumps.
  void tell_event(control::DriveEvent event) { events_.add(std::move(event)); }
  /// Tells the client that its batch was done, and the first tick that shows it.
  void scene_done(const SceneRequest& request, Tick from) { scene_.done(request.client, request.batch.number, from); }
  /// Tells the client, and the operator, that nothing of a batch was done.
  void refuse_scene(const SceneRequest& request, replication::Refusal refusal, double now_s);
  /// The same for a reason that holds for the whole batch.
  void refuse_scene(const SceneRequest& request, const std::string& why, double now_s);

  /// Sends one tick to all screens, as a difference to a tick that all live screens hold. `now_s`: time when the tick
  /// began, by reading the driver's controls.
  void publish(std::shared_ptr<const TakenSnapshot> taken, double now_s);
  /// The same of a tick that lockstep's screens do not draw: to clients that watch, for which nothing waits.
  void publish_to_watchers(std::shared_ptr<const TakenSnapshot> taken, double now_s);
  /// Sends the newest tick again: in lockstep, if a screen has not acknowledged it.
  void repeat_newest() {
    publisher_.repeat_newest();
    every_tick_.repeat_newest();
  }

  const std::vector<HostedScreen>& screens() const { return screens_; }
  /// True once every screen of the rig, and the car if it is on another machine, is connected, and each screen has the
  /// whole scene.
  bool all_ready() const { return missing().empty(); }
  /// Names of the screens that are not connected or lack part of the scene; and the car, if it is on another machine.
  std::vector<std::string> missing() const;
  /// True if every connected screen has shown this tick or, if it joined later, has the scene and can show the next: so
  /// screens that start up have the machine to themselves. Screens that have gone or are left behind do not count.
  bool all_presented(Tick tick) const;
  /// Leaves behind the screens that have not shown the tick: lockstep waits for each again once it shows one.
  void leave_behind(Tick tick);
  /// Leaves behind the screens that have not shown the tick and have been silent since then. Before its first picture a
  /// screen may be silent, as it loads the scene.
  void leave_silent_behind(Tick tick, double since_s);
  /// End requested by the person at a screen; empty: none.
  std::optional<logging::DriveEnd> end_requested() const { return end_requested_; }
  /// True if the person at a screen wants a pause.
  bool pause_requested() const { return pause_requested_; }
  /// Sets such a request, until Escape is pressed.
  void stand_until_escape() { pause_requested_ = true; }
  /// Returns, once, the newest controls from a screen with keyboard or gamepad.
  std::optional<DriverInput> take_controls();
  /// Sets the text for the driver on all screens, connected now or later.
  void give_notice(const control::Notice& notice);
  const control::Notice& notice() const { return notice_; }
  /// Sets the screens whose large picture is watched, by name; called repeatedly while it is watched.
  void look_at(const std::set<std::string>& names, double now_s);
  /// Restarts shown time with the next tick, after a pause.
  void restart_shown_time();
  void finish(const std::string& reason);
  /// True once every connected screen has replied to Finish with its report.
  bool all_reported() const;

  const net::TickPublisherCounters& tick_counters() const { return publisher_.counters(); }
  net::ChannelCounters lane_counters() const { return lane_.counters(); }
  double playout_delay_s() const { return planner_.delay_s(); }
  std::size_t last_tick_bytes() const { return last_tick_bytes_; }
  /// Returns the messages since the last call, for the log and the console: "screen ahead-2 connected".
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

 private:
  void leave_behind(HostedScreen& screen, Tick tick);
  void on_connected(const net::ServerEvent& event, double now_s);
  void on_message(const net::ServerEvent& event, double now_s);
  void on_operator_line(net::ClientId client, const control::OperatorLine& line);
  void on_scene(const net::ServerEvent& event, double now_s);
  void on_control(net::ClientId client, const control::ControlMessage& message, double now_s);
  void on_hello(net::ClientId client, const control::Hello& hello, double now_s);
  void begin_to_watch(net::ClientId client, const control::Hello& hello, double now_s);
  /// True where the rig has a screen or a car of this name.
  bool is_of_the_rig(const std::string& name) const;
  void add_unicast(net::ClientId client, std::uint16_t port);
  void remove_destination(const net::Address& destination);
  void send_tick(std::shared_ptr<const TakenSnapshot> taken, double now_s, bool is_for_screens);
  void on_car_hello(net::ClientId client, const control::CarHello& hello, double now_s);
  /// Reports the reason to the client and to the operator.
  void refuse(net::ClientId client, const std::string& reason, double now_s);
  /// Adds a message about a client: made printable, and limited in number.
  void tell(net::ClientId client, const std::string& text, double now_s);
  void tell_of_strangers(double now_s);
  void on_disconnected(net::ClientId client, const std::string& reason, double now_s);
  void send_unicast_to_the_deaf(double now_s);
  HostedScreen* screen_of(net::ClientId client);
  double simulated_time_s() const { return sent_.empty() ? 0.0 : sent_.back()->snapshot().simulated_time_s; }
  void send(net::ClientId client, const control::ControlMessage& message);

  ScreenHostOptions options_;
  net::SecureServer lane_;
  net::TickPublisher publisher_;
  net::TickPublisher every_tick_;  ///< In lockstep, to clients that watch.
  net::BaselineTracker baselines_;
  const scene::Store& store_;
  replication::ReplicationServer scene_;
  PlayoutPlanner planner_;
  std::vector<HostedScreen> screens_;
  /// Names of clients in the list, from connection to end in the order of events: some events come from a client that
  /// has gone.
  std::map<net::ClientId, std::string> clients_;
  std::map<std::string, MessageLimit> limits_;  ///< By name in the list.
  std::set<net::ClientId> watchers_;            ///< Told the ticks, and no screens.
  EventFeed events_;
  std::map<std::string, std::uint64_t> refused_changes_;  ///< Batches, by name in the list.
  std::map<net::ClientId, net::Address> unicast_;
  std::deque<std::shared_ptr<const TakenSnapshot>> sent_;  ///< Possible baselines, ascending tick.
  std::deque<std::pair<Tick, double>> begun_s_;            ///< Times when the newest ticks began.
  std::optional<DriverInput> controls_;
  control::Notice notice_;
  std::optional<logging::DriveEnd> end_requested_;
  bool pause_requested_ = false;
  std::optional<net::ClientId> car_client_;
  net::ChannelCounters told_;  ///< Counters already reported to the operator.
  double told_s_ = 0.0;
  bool is_finishing_ = false;
  std::size_t last_tick_bytes_ = 0;
  std::vector<std::string> messages_;
  std::vector<OperatorRequest> operator_requests_;
  std::vector<SceneRequest> scene_requests_;
  std::map<net::ClientId, std::size_t>
      edits_waiting_;  ///< Their commands, by editors: one that floods takes no other's room.
};

/// The host's screens; empty without a host.
const std::vector<HostedScreen>& screens_of(const ScreenHost* host);

}  // namespace septet::server
