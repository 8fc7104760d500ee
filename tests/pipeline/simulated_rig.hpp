#pragma once
/// A server and its screens in one process, each on a machine with a clock of its own, on a bad network: both lanes for
/// real, no GPU.

#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/scene/builder.hpp"
#include "sim-client/frame/playout.hpp"
#include "sim-client/link/screen_link.hpp"
#include "sim-server/host/screen_host.hpp"
#include "tests/engine/net/bad_network.hpp"
#include "tests/engine/net/simulated_machine.hpp"

namespace septet {

struct SimulatedRigOptions {
  std::size_t screens = 7;
  net::NetworkFaults faults;
  bool multicast = true;
  std::uint64_t seed = 1;
  std::size_t vehicles = 200;
  double least_playout_delay_s = 2.0 / 120.0;
  std::function<void(scene::SceneBuilder&)> world{};  ///< Content of the scene; some posts if empty.
  std::set<std::size_t> deaf{};                       ///< Screens that the group's datagrams do not reach.
  std::set<std::size_t> watching{};                   ///< Clients that are no screens of the rig, and read all ticks.
  /// Interval at which a screen reads its sockets: at every step, or once a frame as a drawing one.
  double screen_pump_s = 0.0;
  bool real_time = true;  ///< True: a tick is published whenever one is due; false: the host's driver publishes.
};

inline constexpr double rig_tick_s = 1.0 / 120.0;

/// Vehicles that drive circles: every pose is known at every time.
inline Snapshot circling_vehicles(Tick tick, std::size_t vehicles) {
  Snapshot snapshot;
  snapshot.tick = tick;
  snapshot.simulated_time_s = static_cast<double>(tick) * rig_tick_s;
  for (std::size_t i = 0; i < vehicles; ++i) {
    const double radius = 40.0 + 3.0 * static_cast<double>(i), rate = 25.0 / radius,
                 angle = rate * snapshot.simulated_time_s;
    Participant p;
    p.id = static_cast<ParticipantId>(i + 1);
    p.world_from_vehicle = {Vec3(radius * std::sin(angle), -radius * std::cos(angle), 0.0),
                            orientation_from_angles(angle, 0.0, 0.0)};
    p.velocity_mps = Vec3(std::cos(angle), std::sin(angle), 0.0) * 25.0;
    p.acceleration_mps2 = Vec3(-std::sin(angle), std::cos(angle), 0.0) * (25.0 * rate);
    p.angular_velocity_radps = Vec3(0.0, 0.0, rate);
    snapshot.participants.push_back(p);
  }
  return snapshot;
}

class SimulatedRig {
 public:
  struct Screen {
    std::string name;
    net::Identity identity;
    std::unique_ptr<net::SimulatedMachine> machine;
    double next_pump_s = 0.0;  ///< In true time.
    std::unique_ptr<net::DatagramSocket> lane_socket, tick_socket;
    std::unique_ptr<screen::ScreenLink> link;
    bool hung = false;
  };

  explicit SimulatedRig(const SimulatedRigOptions& options)
      : options_(options), network_(options.faults, options.seed) {
    scene::SceneBuilder builder(store_);
    if (options.world)
      options.world(builder);
    else
      for (int i = 0; i < 40; ++i) builder.add_object("post " + std::to_string(i), {});
    for (std::size_t i = 0; i < options.screens; ++i)
      screens_.push_back({.name = "screen-" + std::to_string(i),
                          .identity = net::Identity::generate(),
                          .machine = net::machine_of_its_own(network_, ip_of(i), server_address_.ip, random_),
                          .next_pump_s = random_.uniform(0.0, options.screen_pump_s)});
    start_server();
    for (std::size_t i = 0; i < options.screens; ++i) start_screen(i);
  }

  void start_server() {
    host_.reset();
    server_lane_ = server_machine_->open(server_address_.port);
    server_tick_ = server_machine_->open(4999);
    server::ScreenHostOptions options{.identity = server_identity_,
                                      .session = net::random_session_id(),
                                      .least_playout_delay_s = options_.least_playout_delay_s};
    for (std::size_t i = 0; i < screens_.size(); ++i) {
      const Screen& screen = screens_[i];
      const bool watches = options_.watching.contains(i);
      options.allowed.push_back({screen.identity.public_key(), screen.name, {.may_look = watches}});
      if (watches) continue;
      options.screens.push_back(screen.name);
      options.drivers.insert(screen.name);
    }
    options.welcome.rig = "rig";
    options.welcome.lockstep = !options_.real_time;
    if (options_.multicast) {
      options.welcome.group_ip = group_.ip;
      options.welcome.group_port = group_.port;
    }
    // A server that was away does not catch up on missed ticks.
    next_tick_ = static_cast<Tick>(std::ceil((server_clock_s() - begun_s_) / rig_tick_s));
    host_ = std::make_unique<server::ScreenHost>(*server_lane_, *server_tick_, store_, std::move(options));
  }
  void stop_server() {
    host_.reset();
    server_lane_.reset();
    server_tick_.reset();
  }

  void start_screen(std::size_t i) {
    Screen& screen = screens_[i];
    stop_screen(i);
    const auto port = static_cast<std::uint16_t>(20000 + 10 * starts_++);
    screen.lane_socket = screen.machine->open(port);
    screen.tick_socket = screen.machine->open(static_cast<std::uint16_t>(port + 1));
    const bool deaf = options_.deaf.contains(i);
    auto open_group = [machine = screen.machine.get(), port, deaf](
                          const net::Address& group, std::uint32_t) -> Expected<std::unique_ptr<net::DatagramSocket>> {
      const net::Address heard = deaf ? net::Address{group.ip + 1, group.port} : group;
      return machine->open_group(heard, static_cast<std::uint16_t>(port + 2));
    };
    screen::ScreenLinkOptions options{screen.name,
                                      static_cast<std::uint16_t>(port + 1),
                                      {server_address_, server_identity_.public_key(), screen.identity, {}}};
    screen.link =
        std::make_unique<screen::ScreenLink>(*screen.lane_socket, *screen.tick_socket, open_group, std::move(options));
  }
  void stop_screen(std::size_t i) {
    screens_[i].link.reset();
    screens_[i].lane_socket.reset();
    screens_[i].tick_socket.reset();
  }

  /// One step of true time: the server publishes if a tick is due, all are pumped.
  void advance(double step_s) {
    now_s_ += step_s;
    network_.advance_to(now_s_);
    if (host_) {
      const double server_s = server_clock_s();
      host_->pump(server_s);
      while (options_.real_time && begun_s_ + static_cast<double>(next_tick_) * rig_tick_s <= server_s) {
        host_->publish(std::make_shared<const TakenSnapshot>(circling_vehicles(next_tick_, options_.vehicles)),
                       server_s);
        ++next_tick_;
      }
    }
    for (auto& screen : screens_) {
      if (!screen.link || screen.hung || screen.next_pump_s > now_s_) continue;
      screen.link->pump(screen.machine->clock_s(now_s_));
      screen.next_pump_s = std::max(screen.next_pump_s + options_.screen_pump_s, now_s_);
    }
  }
  void advance_1ms() { advance(0.001); }
  void run_for(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 1000.0 + 0.5); ++i) advance_1ms();
  }

  /// Number of the frame due by a screen's own estimate of the server's clock.
  std::optional<std::int64_t> frame_due(std::size_t i) const {
    const auto& link = screens_[i].link;
    const auto server_s = link ? link->server_time_s(screens_[i].machine->clock_s(now_s_)) : std::nullopt;
    if (!server_s) return std::nullopt;
    return frame::frame_number(*server_s);
  }

  /// A screen's present playout, if it has any.
  std::optional<frame::PlayedOut> shown(std::size_t i) const {
    const auto& link = screens_[i].link;
    if (!link || link->history().empty()) return std::nullopt;
    const auto server_s = link->server_time_s(screens_[i].machine->clock_s(now_s_));
    if (!server_s) return std::nullopt;
    return frame::show(link->history(), *frame::playout_time_s(link->history(), frame::frame_number(*server_s)),
                       rig_tick_s);
  }

  /// A screen's lateness against the server's intent, in true time, for frames from now on: the intended instant of a
  /// frame is when the server's own clock reaches half a frame's time before the frame's instant.
  std::optional<double> lateness_s(std::size_t i) const {
    const auto number = frame_due(i);
    const auto seen = shown(i);
    if (!number || !seen || !seen->on_tick) return std::nullopt;
    const auto& newest = screens_[i].link->history().newest().header;
    const double instant_s = static_cast<double>(*number) / frame::frame_rate_hz;
    const double offset_s = instant_s >= newest.next_from_s ? newest.next_offset_s : newest.offset_s;
    return server_clock_s() - (seen->snapshot.simulated_time_s + offset_s - 0.5 / frame::frame_rate_hz);
  }

  double now_s() const { return now_s_; }  ///< True time.
  double server_clock_s() const { return server_machine_->clock_s(now_s_); }
  net::SimulatedMachine& server_machine() { return *server_machine_; }
  server::ScreenHost& host() { return *host_; }
  bool has_server() const { return host_ != nullptr; }
  Screen& screen(std::size_t i) { return screens_[i]; }
  std::size_t size() const { return screens_.size(); }
  net::BadNetwork& network() { return network_; }
  const scene::Store& store() const { return store_; }
  /// A valid change of the world. `from`: the first tick that shows it.
  void change(const scene::Command& command, Tick from) {
    if (const auto done = store_.apply(command); !done) throw std::runtime_error(describe(done.error()));
    host_->scene_changed(command, from);
  }
  net::Address lane_address() const { return server_address_; }
  net::Address tick_address() const { return {server_address_.ip, 4999}; }
  net::Address group() const { return group_; }
  Tick next_tick() const { return next_tick_; }

 private:
  static std::uint32_t ip_of(std::size_t screen) { return 0x0a000100 + static_cast<std::uint32_t>(screen); }

  SimulatedRigOptions options_;
  net::BadNetwork network_;
  Random random_{23};
  net::Address server_address_{0x0a000001, 4750};
  std::unique_ptr<net::SimulatedMachine> server_machine_ =
      net::machine_of_its_own(network_, server_address_.ip, server_address_.ip, random_);
  const double begun_s_ = server_machine_->clock_s(0.0);  ///< When the server's clock was at tick 0.
  net::Address group_{0xef4d4d4d, 4751};
  net::Identity server_identity_ = net::Identity::generate();
  scene::Store store_;
  std::unique_ptr<net::DatagramSocket> server_lane_, server_tick_;
  std::vector<Screen> screens_;
  std::unique_ptr<server::ScreenHost> host_;
  double now_s_ = 0.0;
  Tick next_tick_ = 0;
  int starts_ = 0;
};

}  // namespace septet
