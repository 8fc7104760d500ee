// The tick lane over a network of the kernel's that loses, delays and reorders (veth, netem).

#include <sched.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/net/keys.hpp"
#include "engine/net/tick_publisher.hpp"
#include "engine/net/tick_receiver.hpp"
#include "engine/net/udp_socket.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/why_not.hpp"

namespace septet::rig_vm {
namespace {

constexpr std::uint32_t server_ip = 0x0a090001, screen_ip = 0x0a090002;  // 10.9.0.1 and .2.
const net::Address group{0xef010203, 4750};                              // 239.1.2.3.

/// A socket of another machine at the other end of a cable: of a thread in a network of its own, where the socket
/// stays.
net::UdpSocket socket_of_screen() {
  std::unique_ptr<net::UdpSocket> socket;
  std::mutex mutex;
  std::condition_variable changed;
  pid_t thread_id = 0;
  bool has_cable = false;
  std::thread screen([&] {
    std::unique_lock lock(mutex);
    REQUIRE(unshare(CLONE_NEWNET) == 0);
    thread_id = gettid();
    changed.notify_all();
    changed.wait(lock, [&] { return has_cable; });
    command("/tools/ip addr add 10.9.0.2/24 dev cable1 && /tools/ip link set cable1 up");
    auto opened = net::UdpSocket::open_group(group, screen_ip);
    REQUIRE_MESSAGE(opened.has_value(), why_not(opened));
    socket = std::make_unique<net::UdpSocket>(std::move(*opened));
  });
  {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return thread_id != 0; });
    command("/tools/ip link add cable0 type veth peer name cable1 && /tools/ip link set cable1 netns " +
            std::to_string(thread_id));
    command("/tools/ip addr add 10.9.0.1/24 dev cable0 && /tools/ip link set cable0 up");
    has_cable = true;
  }
  changed.notify_all();
  screen.join();
  REQUIRE(socket);
  return std::move(*socket);
}

struct Cable {
  ~Cable() { last_command("/tools/ip link del cable0"); }
};

}  // namespace

TEST_SUITE_BEGIN("network");

TEST_CASE("of the ticks that a network loses and reorders nearly all arrive by their repetitions") {
  net::UdpSocket screen = socket_of_screen();
  const Cable cable;
  auto server = net::UdpSocket::open({.bind = {server_ip, 0}});
  REQUIRE(server.has_value());
  REQUIRE(server->set_multicast({.interface_ip = server_ip}));
  const auto identity = net::Identity::generate();
  const auto session = net::random_session_id();
  net::TickPublisher publisher(*server, identity, session);
  publisher.add_destination(group);
  net::TickReceiver receiver(identity.public_key());
  receiver.follow(session);

  const Bytes payload(900, std::byte{7});
  std::uint64_t tick = 0, received = 0, wrong = 0;
  std::map<std::uint64_t, double> sent_at_s;
  std::vector<double> delays_ms;
  const auto run = [&](double seconds) {
    const double begun_s = now_s();
    for (int i = 0; now_s() - begun_s < seconds; ++i) {
      for (const double due_s = begun_s + i / 120.0; now_s() < due_s; sleep_s(0.001)) {
        receiver.receive_from(screen);
        while (const auto next = receiver.next()) {
          ++received;
          wrong += next->payload != payload;
          delays_ms.push_back(1000.0 * (now_s() - sent_at_s[next->tick]));
        }
      }
      sent_at_s[++tick] = now_s();
      publisher.publish(tick, payload);
    }
  };
  run(0.5);
  CHECK(received >= 58);
  CHECK(receiver.counters().lost == 0);

  command("/tools/tc qdisc add dev cable0 root netem delay 20ms 5ms loss 5%");
  delays_ms.clear();
  const auto before = tick;
  run(12.0);
  const auto published = static_cast<double>(tick - before);
  std::ranges::sort(delays_ms);
  const auto late_ms = [&](double share) {
    return delays_ms[static_cast<std::size_t>(share * static_cast<double>(delays_ms.size() - 1))];
  };
  measured("tick lane with 5 % loss and 20 ± 5 ms: ticks lost for good",
           100.0 * static_cast<double>(receiver.counters().lost) / published, "%");
  measured("ticks of which a repetition supplied a datagram",
           100.0 * static_cast<double>(receiver.counters().repaired) / published, "%");
  measured("delay of a tick, p50", late_ms(0.5), "ms");
  measured("delay of a tick, p99", late_ms(0.99), "ms");
  CHECK(wrong == 0);
  // 0.25 % expected: both of two datagrams lost.
  CHECK(static_cast<double>(receiver.counters().lost) < 0.01 * published);
  CHECK(static_cast<double>(receiver.counters().repaired) > 0.02 * published);
  CHECK(late_ms(0.01) > 14.0);
  CHECK(late_ms(0.99) < 40.0);

  // A cable pulled for a second: the lane goes on with later datagrams.
  command("/tools/ip link set cable0 down");
  run(1.0);
  command("/tools/ip link set cable0 up && /tools/tc qdisc del dev cable0 root");
  run(0.3);
  received = 0;
  run(0.5);
  CHECK(received >= 55);
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
