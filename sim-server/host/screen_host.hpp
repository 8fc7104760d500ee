#pragma once
/// The server's side of both lanes: who is there, the scene to those who ask for it, every tick to all of them.
///
/// It never waits for a screen: ticks go out once whatever the number of screens, and what a screen has not taken of the
/// scene costs a bounded queue. In lockstep it is the caller who waits, by asking `all_presented`. Sockets only through the
/// DatagramSocket seam, time only as an argument. One thread.
///
/// Whoever has a key of the list may send anything in any order: a client is what the list calls its key, it can be that screen
/// or that car and nothing else, and what it says concerns itself alone. Its text is made printable and limited in number.

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
#include "engine/scene/store.hpp"
#include "engine/world/taken_snapshot.hpp"
#include "logging/session/drive_end.hpp"
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

/// How many moments are kept of each kind.
inline constexpr std::size_t most_moments = 100;

/// One screen of the rig, connected or not.
struct HostedScreen {
  std::string name;
  std::optional<net::ClientId> client;
  std::uint16_t tick_port = 0;  ///< Where it hears ticks by unicast.
  bool expected = false;        ///< Whoever has the key of this name has connected; the Hello is on its way.
  bool scene_arrived = false;
  Tick presented = 0;
  bool has_presented = false;
  std::uint64_t frames = 0;
  double frame_ms = 0.0;  ///< From picture to picture, of the newest.
  LatencyRecord
      report_to_picture;  ///< From reading the driver's controls to its word that it shows that tick; in real time.
  std::uint64_t lost_baselines = 0;  ///< Ticks that it could not read, for what they differ from was lost on the way.
  std::uint32_t joined = 0;          ///< How often it has connected.
  double joined_s = 0.0;             ///< When it last did.
  std::optional<Tick> joined_at;  ///< The newest tick at that moment; its own ticks come after. None before the first.
  bool left_behind = false;       ///< Lockstep waits for it no more, until it shows a tick.
  std::optional<control::ScreenReport> report;
  std::shared_ptr<const std::string> thumbnail;  ///< The newest, any bytes; null: none has come.
  Tick thumbnail_tick = 0;
  std::shared_ptr<const std::string> large_picture;  ///< The same of what somebody looks at closely; null: nobody does.
  std::optional<double> asked_to_look_s;             ///< When it was last told that somebody does.
  std::vector<double> connected_s, left_s,
      left_behind_s;  ///< When, in simulated time; at most `most_moments` each: the first and the newest.
  std::optional<double> unanswered_since_s;  ///< When the first tick was sent that it has not answered.

  bool live() const { return client.has_value(); }
};

class ScreenHost {
 public:
  /// The sockets and the store outlive the host.
  ScreenHost(net::DatagramSocket& lane_socket, net::DatagramSocket& tick_socket, const scene::Store& store,
             ScreenHostOptions options);

  /// Receives, answers, and sends of the scene what the lanes take now.
  void pump(double now_s);
  bool has_backlog() const { return lane_.has_backlog(); }

  /// Who may connect from now on. Who is connected and no longer on the list is out at once.
  void set_allowed(std::vector<net::AllowedClient> allowed) { lane_.set_allowed(std::move(allowed)); }

  /// Tells of a command that the store has taken.
  void scene_changed(const scene::Command& command) { scene_.applied(command); }

  /// Sends one tick to everybody, as a difference to what all live screens hold. `now_s`: when the tick was begun, by reading the driver's
  /// controls.
  void publish(std::shared_ptr<const TakenSnapshot> taken, double now_s);
  /// Sends the newest tick once more: in lockstep, where someone has not answered.
  void repeat_newest() { publisher_.repeat_newest(); }

  const std::vector<HostedScreen>& screens() const { return screens_; }
  /// Every screen of the rig is connected and holds the whole scene.
  bool all_ready() const { return missing().empty(); }
  /// Which screens are not there, or not whole; and the car, where it is on another machine.
  std::vector<std::string> missing() const;
  /// Every connected screen has shown this tick, or, if it came later, holds the scene and can show the next. So those
  /// that come up have the machine to themselves. Screens that have gone or are left behind do not count.
  bool all_presented(Tick tick) const;
  /// Who has not shown the tick is not waited for again before it shows one.
  void leave_behind(Tick tick);
  /// The same of who has not been heard since then either. Before its first picture a screen may be silent: it takes in the scene.
  void leave_silent_behind(Tick tick, double since_s);
  /// Whether the person at one of the screens has ended the drive, and how.
  std::optional<logging::DriveEnd> end_requested() const { return end_requested_; }
  /// Whether the person at one of the screens wants the world to stand still.
  bool pause_requested() const { return pause_requested_; }
  /// Takes it that this person wants that, until Escape is pressed.
  void stand_until_escape() { pause_requested_ = true; }
  /// The newest controls that a screen with keyboard or gamepad has sent, once.
  std::optional<DriverInput> take_controls();
  /// What the driver is to read, on all screens that are there or will come.
  void give_notice(const control::Notice& notice);
  const control::Notice& notice() const { return notice_; }
  /// At which screens somebody looks closely, by name; called again and again as long as he does.
  void look_at(const std::set<std::string>& names, double now_s);
  /// Shown time begins anew with the next tick: the world has stood still until now.
  void restart_shown_time();
  void finish(const std::string& reason);
  /// Every connected screen has answered Finish with its report.
  bool all_reported() const;

  const net::TickPublisherCounters& tick_counters() const { return publisher_.counters(); }
  net::ChannelCounters lane_counters() const { return lane_.counters(); }
  double playout_delay_s() const { return planner_.delay_s(); }
  std::size_t last_tick_bytes() const { return last_tick_bytes_; }
  /// What happened since the last call, for the log and the console: "screen ahead-2 connected".
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

 private:
  void leave_behind(HostedScreen& screen, Tick tick);
  void on_connected(const net::ServerEvent& event);
  void on_message(const net::ServerEvent& event, double now_s);
  void on_control(net::ClientId client, const control::ControlMessage& message, double now_s);
  void on_hello(net::ClientId client, const control::Hello& hello, double now_s);
  void add_unicast(net::ClientId client, std::uint16_t port);
  void on_car_hello(net::ClientId client, const control::CarHello& hello, double now_s);
  /// Says why, to it and to the operator.
  void refuse(net::ClientId client, const std::string& reason, double now_s);
  /// Of a client: made printable, and not too often.
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
  net::BaselineTracker baselines_;
  replication::ReplicationServer scene_;
  PlayoutPlanner planner_;
  std::vector<HostedScreen> screens_;
  /// By what name the list calls them. Each from its connection to its end by the order of events: some events are of one that has gone.
  std::map<net::ClientId, std::string> clients_;
  std::map<std::string, MessageLimit> limits_;  ///< By the name in the list.
  std::map<net::ClientId, net::Address> unicast_;
  std::deque<std::shared_ptr<const TakenSnapshot>> sent_;  ///< Possible baselines, ascending tick.
  std::deque<std::pair<Tick, double>> begun_s_;            ///< When the newest ticks were begun.
  std::optional<DriverInput> controls_;
  control::Notice notice_;
  std::optional<logging::DriveEnd> end_requested_;
  bool pause_requested_ = false;
  std::optional<net::ClientId> car_client_;
  net::ChannelCounters told_;  ///< What the operator has been told of.
  double told_s_ = 0.0;
  bool is_finishing_ = false;
  std::size_t last_tick_bytes_ = 0;
  std::vector<std::string> messages_;
};

/// The host's screens; none without a host.
const std::vector<HostedScreen>& screens_of(const ScreenHost* host);

}  // namespace septet::server
