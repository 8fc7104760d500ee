#pragma once
/// Clients of a screen host that execute a script of bytes: they hold keys of the list, and are otherwise untrusted.
/// They also act while the server is reading, as datagrams do that pile up before a busy server.
///
/// Every byte string is a script. At its end the host has received every call that the server makes.

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/builder.hpp"
#include "sim-server/host/screen_host.hpp"
#include "tests/engine/net/tick_wire.hpp"

namespace septet::server {

/// Meaning of a script's bytes; each is followed by the number of a client.
enum class ScriptStep : std::uint8_t {
  end_of_pump,  ///< The server has read everything pending and works; then u8 × 10 ms pass.
  pump,         ///< The client receives, replies, sends.
  restart,      ///< The client restarts: at the same address, or (u8 odd) at another one.
  hello,        ///< Hello under the name numbered u8.
  control,      ///< A control message: u8 length, kind and fields.
  replication,  ///< A scene message: u8 length, bytes.
  scene_hello,  ///< A valid hello of the scene.
  raw,          ///< Any message: u8 length, bytes.
  unreliable,   ///< The same, unreliable.
  datagram,     ///< A datagram outside of any connection: u8 length, bytes.
  goodbye,      ///< The client closes its connection.
  revoke,       ///< The client's key is taken off the list, or (u8 odd) all are on it again.
  count
};

/// A script from steps and numbers.
template <class... Parts>
Bytes script(Parts... parts) {
  return {static_cast<std::byte>(parts)...};
}

/// The client sends this message and the host reads it and publishes a tick.
inline Bytes says(int client, const control::ControlMessage& message) {
  const Bytes bytes = control::encode_control(message);
  Bytes steps = script(ScriptStep::control, client, bytes.size() - 1);
  steps.insert(steps.end(), bytes.begin() + 1, bytes.end());
  for (const std::byte part : script(ScriptStep::pump, client, ScriptStep::end_of_pump, client, 0))
    steps.push_back(part);
  return steps;
}

constexpr int a = 0, b = 1, car = 2;  ///< Clients.

class ClientScript {
 public:
  static constexpr std::size_t clients = 4;  ///< Screens a and b, the car, and another holder of a's key.

  ClientScript() {
    scene::SceneBuilder builder(store_);
    for (int i = 0; i < 3; ++i) builder.add_object("post", {});
    ScreenHostOptions options{.identity = server_identity(), .session = {1}, .allowed = list(clients)};
    options.screens = {"a", "b"};
    options.drivers = {"a"};
    options.car = std::make_shared<RemoteCar>();
    options.welcome.rig = "rig";
    sockets_[server_address] = &server_socket_;
    host_ = std::make_unique<ScreenHost>(server_socket_, tick_socket_, store_, std::move(options));
    for (std::size_t who = 0; who < clients; ++who) restart(who, false);
  }

  ScreenHost& host() { return *host_; }
  /// Controls that have reached the car so far.
  const std::vector<DriverInput>& controls() const { return controls_; }

  /// Handshake and Hello under the own names: the scripts begin with screens and car connected.
  void connect_all() {
    for (int turn = 0; turn < 4; ++turn) {
      for (std::size_t who = 0; who < 3; ++who) clients_[who]->pump(now_s_);
      pump_host();
    }
    for (std::size_t who = 0; who < 2; ++who) send(who, control::encode_control(control::Hello{name_of(who), 5000}));
    send(2, control::encode_control(control::CarHello{}));
    for (std::size_t who = 0; who < 3; ++who) clients_[who]->pump(now_s_);
    pump_host();
  }

  void play(std::span<const std::byte> script) {
    ByteReader reader(script);
    while (reader.ok() && !reader.at_end()) {
      script_ = &reader;
      pump_host();
      script_ = nullptr;
      publish();
      (void)host_->all_presented(tick_);
      (void)host_->all_ready();
      (void)host_->all_reported();
      host_->leave_behind(tick_);
      if (const auto controls = host_->take_controls()) controls_.push_back(*controls);
      (void)host_->take_messages();
    }
    host_->finish("the script is over");
    pump_host();
  }

 private:
  using Waiting = std::deque<std::pair<net::Address, Bytes>>;

  struct Socket final : net::DatagramSocket {
    Socket(ClientScript& owner, net::Address own_address) : script(owner), own(own_address) {}
    bool send(const net::Address& to, std::span<const std::byte> bytes) override {
      // A bounded queue, as every socket's; datagrams to unknown addresses are lost.
      if (const auto found = script.sockets_.find(to);
          found != script.sockets_.end() && found->second->waiting.size() < 64)
        found->second->waiting.emplace_back(own, Bytes(bytes.begin(), bytes.end()));
      return true;
    }
    void flush() override {}
    std::optional<net::ReceivedDatagram> receive() override {
      while (waiting.empty() && own == server_address && script.act()) {
      }
      if (waiting.empty()) return std::nullopt;
      taken = std::move(waiting.front());
      waiting.pop_front();
      return net::ReceivedDatagram{taken.first, taken.second};
    }
    std::size_t receive_buffer_bytes() const override { return 1 << 20; }

    ClientScript& script;
    net::Address own;
    Waiting waiting;
    std::pair<net::Address, Bytes> taken;
  };

  static constexpr net::Address server_address{0x0a000001, 4750}, tick_address{0x0a000001, 4751};

  static net::Identity server_identity() { return net::identity_of(1); }
  /// Client 3 has client 0's key.
  static net::Identity client_identity(std::size_t who) {
    return net::identity_of(static_cast<std::uint8_t>(2 + who % 3));
  }
  static std::string name_of(std::size_t who) { return who % 3 == 0 ? "a" : who % 3 == 1 ? "b" : "car"; }
  static std::vector<net::AllowedClient> list(std::size_t without) {
    std::vector<net::AllowedClient> allowed;
    for (std::size_t who = 0; who < 3; ++who)
      if (who != without % 3 || without == clients)
        allowed.push_back({client_identity(who).public_key(), name_of(who)});
    return allowed;
  }

  void restart(std::size_t who, bool elsewhere) {
    clients_[who].reset();
    if (client_sockets_[who]) sockets_.erase(client_sockets_[who]->own);
    const bool moves = elsewhere || !client_sockets_[who];
    const net::Address own{0x0a000100 + static_cast<std::uint32_t>(who),
                           moves ? ++ports_ : client_sockets_[who]->own.port};
    client_sockets_[who] = std::make_unique<Socket>(*this, own);
    sockets_[own] = client_sockets_[who].get();
    clients_[who] = std::make_unique<net::SecureClient>(
        *client_sockets_[who],
        net::SecureClientOptions{server_address, server_identity().public_key(), client_identity(who), {}});
  }

  void send(std::size_t who, Bytes message, net::Reliability reliability = net::Reliability::reliable) {
    clients_[who]->send(net::share(std::move(message)), reliability);
  }

  void pump_host() { host_->pump(now_s_); }

  void publish() {
    Snapshot snapshot;
    snapshot.tick = ++tick_;
    host_->publish(std::make_shared<const TakenSnapshot>(snapshot), now_s_);
  }

  /// The next step of the script; false once the server has read everything.
  bool act() {
    if (!script_ || script_->at_end()) return false;
    ByteReader& script = *script_;
    const auto step =
        static_cast<ScriptStep>(script.get<std::uint8_t>() % static_cast<std::uint8_t>(ScriptStep::count));
    const std::size_t who = script.at_end() ? 0 : script.get<std::uint8_t>() % clients;
    const auto number = [&] { return script.at_end() ? std::uint8_t{0} : script.get<std::uint8_t>(); };
    const auto some = [&](Bytes before = {}) {
      const std::size_t size = std::min<std::size_t>(number(), script.remaining());
      const auto bytes = script.take(size);
      before.insert(before.end(), bytes.begin(), bytes.end());
      return before;
    };
    switch (step) {
      case ScriptStep::end_of_pump:
      case ScriptStep::count:
        now_s_ += 0.01 * number();
        return false;
      case ScriptStep::pump:
        clients_[who]->pump(now_s_);
        break;
      case ScriptStep::restart:
        restart(who, number() % 2 == 1);
        break;
      case ScriptStep::hello:
        send(who, control::encode_control(control::Hello{name_of(number()), 5000}));
        break;
      case ScriptStep::control:
        send(who, some({std::byte{1}}));
        break;
      case ScriptStep::replication:
        send(who, some({std::byte{0}}));
        break;
      case ScriptStep::scene_hello:
        send(who, control::scene_message(replication::encode(replication::Hello{})));
        break;
      case ScriptStep::raw:
        send(who, some());
        break;
      case ScriptStep::unreliable:
        send(who, some(), net::Reliability::unreliable);
        break;
      case ScriptStep::datagram:
        client_sockets_[who]->send(server_address, some());
        break;
      case ScriptStep::goodbye:
        clients_[who]->close();
        break;
      case ScriptStep::revoke:
        host_->set_allowed(list(number() % 2 == 1 ? clients : who));
        break;
    }
    return true;
  }

  std::map<net::Address, Socket*> sockets_;
  Socket server_socket_{*this, server_address}, tick_socket_{*this, tick_address};
  std::array<std::unique_ptr<Socket>, clients> client_sockets_;
  std::array<std::unique_ptr<net::SecureClient>, clients> clients_;
  scene::Store store_;
  std::unique_ptr<ScreenHost> host_;
  std::vector<DriverInput> controls_;
  ByteReader* script_ = nullptr;
  double now_s_ = 1.0;
  Tick tick_ = 0;
  std::uint16_t ports_ = 5000;
};

}  // namespace septet::server
