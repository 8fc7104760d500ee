#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "tests/engine/net/tick_fixtures.hpp"

namespace septet::net {
namespace {

TEST_CASE("a tick of any size arrives whole and no datagram exceeds the limit") {
  for (const std::size_t size : {0u, 1u, 1073u, 1074u, 4000u, 10000u, 70000u, 262144u}) {
    for (const std::size_t limit : {576u, 1200u, 9000u, 65507u}) {
      const Bytes payload = random_bytes(size, size);
      auto datagrams = datagrams_of(5, payload, {.max_datagram_bytes = limit});
      std::reverse(datagrams.begin(), datagrams.end());
      TickReceiver receiver = following();
      for (const Bytes& datagram : datagrams) {
        REQUIRE(datagram.size() <= limit);
        receiver.accept(datagram);
      }
      const auto tick = receiver.next();
      REQUIRE(tick.has_value());
      CHECK(tick->tick == 5);
      CHECK(tick->payload == payload);
      CHECK(!tick->repaired);
      CHECK(!receiver.next());
      CHECK(receiver.counters().forged == 0);
    }
  }
}

TEST_CASE(
    "at five percent loss with jitter and reordering only ticks that lost both copies are "
    "missing") {
  BadNetwork network({.loss = 0.05, .duplication = 0.02, .latency_s = 0.0005, .jitter_s = 0.020}, 11);
  auto out = network.open(server_address);
  auto in = network.open_group(group, client_address(0));
  TickPublisher publisher(*out, identity_of(1), session_of(1));
  publisher.add_destination(group);
  TickReceiver receiver = following();
  constexpr std::uint64_t ticks = 1200;
  std::set<std::uint64_t> arrived;
  for (std::uint64_t tick = 1; tick <= ticks; ++tick) {
    network.advance_to(static_cast<double>(tick) / 120.0);
    receiver.receive_from(*in);
    while (auto received = receiver.next()) {
      CHECK(received->payload == random_bytes(900, received->tick));
      CHECK(arrived.insert(received->tick).second);
    }
    publisher.publish(tick, random_bytes(900, tick));
  }
  network.advance_to(20.0);
  receiver.receive_from(*in);
  while (auto received = receiver.next()) arrived.insert(received->tick);
  const auto& counters = receiver.counters();
  // Both copies of a tick are lost with probability 0.0025: three of 1200 are expected, twelve are practically
  // impossible.
  CHECK(arrived.size() >= ticks - 12);
  CHECK(arrived.size() + counters.lost + TickReceiver::window >= ticks);
  CHECK(counters.repaired > 20);
  CHECK(counters.forged + counters.malformed + counters.replayed == 0);
}

TEST_CASE("without repetition the same loss costs ticks so repetition is what repairs them") {
  BadNetwork network({.loss = 0.05, .latency_s = 0.0005}, 11);
  auto out = network.open(server_address);
  auto in = network.open_group(group, client_address(0));
  TickPublisher publisher(*out, identity_of(1), session_of(1), {.repeat_previous = false});
  publisher.add_destination(group);
  TickReceiver receiver = following();
  for (std::uint64_t tick = 1; tick <= 1200; ++tick) {
    publisher.publish(tick, random_bytes(900, tick));
    network.advance_to(static_cast<double>(tick) / 120.0);
    receiver.receive_from(*in);
  }
  CHECK(receiver.counters().lost > 30);
  CHECK(receiver.counters().repaired == 0);
}

TEST_CASE("one lost datagram is repaired by the next tick") {
  Recorder recorder;
  TickPublisher publisher(recorder, identity_of(1), session_of(1));
  publisher.add_destination(group);
  publisher.publish(10, random_bytes(3000, 1));
  recorder.datagrams.erase(recorder.datagrams.begin() + 1);
  publisher.publish(12, random_bytes(3000, 2));
  TickReceiver receiver = following();
  for (const Bytes& datagram : recorder.datagrams) receiver.accept(datagram);
  const auto newer = receiver.next(), older = receiver.next();
  REQUIRE(newer.has_value());
  REQUIRE(older.has_value());
  CHECK(newer->tick == 12);
  CHECK(older->tick == 10);
  CHECK(older->repaired);
  CHECK(receiver.counters().repaired == 1);
  CHECK(receiver.counters().lost == 0);
}

TEST_CASE("a datagram with any bit flipped changes nothing and is counted") {
  const Bytes payload = random_bytes(2500, 3);
  const auto datagrams = datagrams_of(5, payload);
  REQUIRE(datagrams.size() == 3);
  TickReceiver receiver = following();
  std::uint64_t offered = 0;
  for (const Bytes& datagram : datagrams)
    for (std::size_t bit = 0; bit < datagram.size() * 8; bit += 7) {
      if (bit / 8 == 4) continue;  // The repetition byte is not signed.
      Bytes forged = datagram;
      forged[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
      receiver.accept(forged);
      ++offered;
    }
  const auto& counters = receiver.counters();
  CHECK(counters.forged + counters.malformed + counters.oversized + counters.other_session == offered);
  CHECK(counters.forged > 0);
  CHECK(counters.malformed > 0);
  CHECK(counters.oversized > 0);
  CHECK(receiver.bytes_held() == 0);
  for (const Bytes& datagram : datagrams) receiver.accept(datagram);
  REQUIRE(receiver.counters().ticks == 1);
  CHECK(receiver.next()->payload == payload);
}

TEST_CASE("a forged fragment cannot poison a tick under reassembly") {
  const Bytes payload = random_bytes(2500, 3);
  const auto good = datagrams_of(5, payload);
  const auto others = datagrams_of(5, random_bytes(2500, 4), {}, 2);
  TickReceiver receiver = following();
  receiver.accept(good[0]);
  for (const Bytes& datagram : others) receiver.accept(datagram);
  Bytes swapped = good[1];
  std::copy(others[1].end() - 500, others[1].end(), swapped.end() - 500);
  receiver.accept(swapped);
  CHECK(receiver.counters().forged == 4);
  receiver.accept(good[1]);
  receiver.accept(good[2]);
  REQUIRE(receiver.counters().ticks == 1);
  CHECK(receiver.next()->payload == payload);
}

TEST_CASE("truncated oversized and random datagrams change nothing and are counted") {
  const auto datagrams = datagrams_of(5, random_bytes(2500, 3));
  TickReceiver receiver = following();
  for (std::size_t size = 0; size < datagrams[0].size(); ++size) receiver.accept(std::span(datagrams[0]).first(size));
  Bytes longer = datagrams[0];
  longer.push_back(std::byte{0});
  receiver.accept(longer);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Bytes noise = random_bytes(seed * 3, seed);
    receiver.accept(noise);
    if (noise.size() > 60) {
      std::copy_n(datagrams[0].begin(), 37, noise.begin());
      receiver.accept(noise);
    }
  }
  const auto& counters = receiver.counters();
  CHECK(counters.malformed + counters.oversized + counters.forged == counters.datagrams);
  CHECK(counters.oversized > 0);
  CHECK(counters.ticks == 0);
  CHECK(receiver.bytes_held() == 0);
}

TEST_CASE("what the socket refuses is counted and what every destination gets counts for each") {
  struct Full final : DatagramSocket {
    bool send(const Address& to, std::span<const std::byte>) override { return to == group; }
    void flush() override {}
    std::optional<ReceivedDatagram> receive() override { return std::nullopt; }
    std::size_t receive_buffer_bytes() const override { return 0; }
  } socket;
  TickPublisher publisher(socket, identity_of(1), session_of(1), {.repeat_previous = false});
  publisher.add_destination(group);
  publisher.add_destination(group);
  publisher.add_destination(client_address(0));
  CHECK(publisher.destinations().size() == 2);
  publisher.publish(1, random_bytes(100, 1));
  CHECK(publisher.counters().datagrams == 1);
  CHECK(publisher.counters().refused == 1);
  publisher.remove_destination(client_address(0));
  publisher.publish(2, random_bytes(100, 1));
  CHECK(publisher.counters().datagrams == 2);
  CHECK(publisher.counters().refused == 1);
}

TEST_CASE("bytes per tick do not depend on the number of receivers of a group") {
  std::vector<std::uint64_t> bytes;
  for (const std::uint32_t receivers : {1u, 7u, 21u}) {
    BadNetwork network({}, 1);
    auto out = network.open(server_address);
    std::vector<std::unique_ptr<DatagramSocket>> sockets;
    for (std::uint32_t n = 0; n < receivers; ++n) sockets.push_back(network.open_group(group, client_address(n)));
    TickPublisher publisher(*out, identity_of(1), session_of(1));
    publisher.add_destination(group);
    for (std::uint64_t tick = 1; tick <= 10; ++tick) publisher.publish(tick, random_bytes(4000, tick));
    network.advance_to(1.0);
    for (auto& socket : sockets) {
      TickReceiver receiver = following();
      receiver.receive_from(*socket);
      CHECK(receiver.counters().ticks == 10);
    }
    bytes.push_back(network.sent_by(server_address).bytes);
    CHECK(publisher.counters().bytes == bytes.back());
  }
  CHECK(bytes[0] == bytes[1]);
  CHECK(bytes[0] == bytes[2]);
}

TEST_CASE("the newest tick can be repeated for a lockstep client that lost it") {
  BadNetwork network({.loss = 1.0}, 1);
  auto out = network.open(server_address);
  auto in = network.open(client_address(0));
  TickPublisher publisher(*out, identity_of(1), session_of(1));
  publisher.add_destination(client_address(0));
  publisher.publish(1, random_bytes(100, 1));
  network.set_faults({});
  publisher.repeat_newest();
  network.advance_to(1.0);
  TickReceiver receiver = following();
  receiver.receive_from(*in);
  REQUIRE(receiver.counters().ticks == 1);
  CHECK(receiver.next()->repaired);
}

}  // namespace
}  // namespace septet::net
