#pragma once
/// A screen that does everything except drawing, in the test's own process: shows the server's messages.

#include "sim-client/link/screen_link.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

class Observer {
 public:
  Observer(const std::string& name, const std::string& port, const net::Identity& identity, const fs::path& keys)
      : lane_(open()),
        tick_(open()),
        link_(lane_, tick_, open_group, options(name, port, identity, keys, tick_.local_address().port)) {}
  screen::ScreenLink& link() { return link_; }
  static double now_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }
  /// Receives until the condition holds.
  bool watch(const std::function<bool()>& condition, std::chrono::milliseconds within = patience) {
    return becomes_true(
        [&] {
          link_.pump(now_s());
          return condition();
        },
        within);
  }
  Tick newest_tick() const { return link_.history().empty() ? 0 : link_.history().newest().snapshot.tick; }

 private:
  static net::UdpSocket open() {
    auto socket = net::UdpSocket::open({.bind = {net::loopback_ip, 0}});
    REQUIRE(socket.has_value());
    return std::move(*socket);
  }
  static Expected<std::unique_ptr<net::DatagramSocket>> open_group(const net::Address& group,
                                                                   std::uint32_t interface_ip) {
    return net::UdpSocket::open_group(group, interface_ip)
        .map([](net::UdpSocket socket) -> std::unique_ptr<net::DatagramSocket> {
          return std::make_unique<net::UdpSocket>(std::move(socket));
        });
  }
  static screen::ScreenLinkOptions options(const std::string& name, const std::string& port,
                                           const net::Identity& identity, const fs::path& keys,
                                           std::uint16_t tick_port) {
    std::string key = text_of(keys / "server.public");
    key.resize(64);
    return {name,
            tick_port,
            {*net::parse_address("127.0.0.1:" + port, "test"), *net::parse_public_key(key, "test"), identity, {}}};
  }

  net::UdpSocket lane_, tick_;
  screen::ScreenLink link_;
};

}  // namespace septet::pipeline
