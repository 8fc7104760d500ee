#include "engine/net/reliable_sender.hpp"

#include <doctest/doctest.h>

#include "engine/net/scene_frames.hpp"
#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

// A sender whose packets of 1200 bytes each carry one message of 1000 bytes.
struct Lane {
  ReliableSender sender;
  std::uint64_t next_number = 0;
  Bytes newest;  // The frames of the newest packet.

  explicit Lane(std::size_t max_flight_bytes = 1u << 20, std::size_t max_queue_bytes = 8u << 20)
      : sender({.max_datagram_bytes = 1200,
                .max_message_bytes = 4000,
                .max_queue_bytes = max_queue_bytes,
                .window_bytes = 8u << 20,
                .max_flight_bytes = max_flight_bytes}) {}

  SendResult enqueue(std::uint64_t seed) { return sender.enqueue(share(random_bytes(1000, seed))); }
  // Sends as much as allowed and returns the number of packets.
  std::size_t send(double now_s, std::size_t most = ~std::size_t{0}) {
    std::size_t packets = 0;
    for (; packets < most && sender.wants_to_send(); ++packets) {
      std::vector<std::uint64_t> fragments;
      newest.clear();
      ByteWriter writer(newest);
      sender.fill(writer, 1012, fragments);
      REQUIRE(fragments.size() == 1);
      sender.packet_sent(next_number++, now_s, 1200, fragments);
    }
    return packets;
  }
  bool acknowledge(std::uint64_t first, std::uint64_t last, double now_s) {
    PacketRanges received;
    received.count = 1;
    received.ranges[0] = {last, first};
    return sender.acknowledge(received, next_number, now_s);
  }
  Bytes message_in_newest() const {
    ByteReader reader(newest);
    Frame frame;
    REQUIRE(read_frame(reader, frame));
    return {frame.bytes.begin(), frame.bytes.end()};
  }
};

TEST_CASE("a lost packet is resent once a little over a round trip after it was sent and nothing else is") {
  Lane lane;
  for (std::uint64_t n = 0; n < 30; ++n) lane.enqueue(n);
  // A packet a millisecond; each is acknowledged ten milliseconds later, but for the sixth, which never arrives.
  double resent_s = 0.0;
  for (std::uint64_t ms = 0; ms < 60; ++ms) {
    const double now_s = 0.001 * static_cast<double>(ms);
    if (ms >= 10 && ms - 10 < lane.next_number && ms != 15) lane.acknowledge(ms - 10, ms - 10, now_s);
    lane.sender.advance_to(now_s);
    lane.send(now_s, 1);
    if (lane.sender.resent() > 0 && resent_s == 0.0) {
      resent_s = now_s;
      CHECK(lane.message_in_newest() == random_bytes(1000, 5));
    }
  }
  CHECK(lane.sender.resent() == 1);
  // Sent at 5 ms; at 16 ms its successor is acknowledged, which could be mere reordering still.
  CHECK(resent_s == doctest::Approx(0.017));
  CHECK(lane.sender.queued_bytes() == 0);
}

TEST_CASE("acknowledgements that come out of order resend nothing") {
  Lane lane;
  for (std::uint64_t n = 0; n < 40; ++n) lane.enqueue(n);
  for (std::uint64_t ms = 0; ms < 60; ++ms) {
    const double now_s = 0.001 * static_cast<double>(ms);
    // Acknowledges the second of each pair a millisecond before the first.
    const std::uint64_t number = (ms - 10) ^ 1;
    if (ms >= 10 && number < lane.next_number) lane.acknowledge(number, number, now_s);
    lane.sender.advance_to(now_s);
    lane.send(now_s, 1);
  }
  CHECK(lane.sender.resent() == 0);
  CHECK(lane.sender.queued_bytes() == 0);
}

TEST_CASE("what nobody acknowledges is resent after 50 and 100 and 200 milliseconds and then every 250") {
  Lane lane;
  lane.enqueue(1);
  std::vector<double> sent_s;
  for (int ms = 0; ms <= 1150; ++ms) {
    const double now_s = 0.001 * ms;
    lane.sender.advance_to(now_s);
    if (lane.send(now_s) > 0) sent_s.push_back(now_s);
  }
  const std::vector<double> expected_s = {0.0, 0.05, 0.15, 0.35, 0.6, 0.85, 1.1};
  REQUIRE(sent_s.size() == expected_s.size());
  for (std::size_t i = 0; i < sent_s.size(); ++i) CHECK(std::abs(sent_s[i] - expected_s[i]) < 0.0035);
  // An acknowledgement ends the waiting: the next one is missed after a round trip and four of its deviations.
  CHECK(lane.acknowledge(0, 6, sent_s.back() + 0.01));
  CHECK(lane.sender.queued_bytes() == 0);
  lane.enqueue(2);
  lane.send(1.2);
  lane.sender.advance_to(1.2 + 0.029);
  CHECK(lane.send(1.229) == 0);
  lane.sender.advance_to(1.2 + 0.031);
  CHECK(lane.send(1.231) == 1);
}

TEST_CASE(
    "what may be under way doubles once a round trip while it is used up and never passes the receiver's buffer") {
  Lane lane(200 * 1200);
  for (std::uint64_t n = 0; n < 2000; ++n) lane.enqueue(n);
  CHECK(lane.send(0.00) == 64);
  CHECK(lane.acknowledge(0, 9, 0.01));
  CHECK(lane.send(0.01) == 64 + 10);
  CHECK(lane.acknowledge(0, 63, 0.011));  // Still of the first round.
  CHECK(lane.send(0.011) == 54);
  CHECK(lane.acknowledge(0, lane.next_number - 1, 0.02));
  CHECK(lane.send(0.02) == 200);
  CHECK(lane.acknowledge(0, lane.next_number - 1, 0.03));
  CHECK(lane.send(0.03) == 200);
}

TEST_CASE("what may be under way stays where it is while nobody uses it up") {
  Lane lane;
  for (std::uint64_t n = 0; n < 3; ++n) {
    lane.enqueue(n);
    lane.send(0.01 * static_cast<double>(n));
    CHECK(lane.acknowledge(n, n, 0.01 * static_cast<double>(n) + 0.005));
  }
  for (std::uint64_t n = 0; n < 500; ++n) lane.enqueue(n);
  CHECK(lane.send(1.0) == 64);
}

TEST_CASE("more than a tenth lost in a round cuts by a third what may be under way and less is mere noise") {
  for (const std::uint64_t lost : {20u, 26u}) {
    CAPTURE(lost);
    Lane lane(200 * 1200);
    for (std::uint64_t n = 0; n < 2000; ++n) lane.enqueue(n);
    for (int round = 0; round < 3; ++round) {
      lane.send(0.01 * round);
      CHECK(lane.acknowledge(0, lane.next_number - 1, 0.01 * round + 0.01));
    }
    REQUIRE(lane.send(0.03) == 200);
    const std::uint64_t first = lane.next_number - 200;
    CHECK(lane.acknowledge(first + lost, lane.next_number - 1, 0.04));
    lane.sender.advance_to(0.05);
    CHECK(lane.send(0.05) == 200);
    CHECK(lane.sender.resent() == lost);
    CHECK(lane.acknowledge(first + 200, lane.next_number - 1, 0.06));
    CHECK(lane.send(0.06) == (lost == 20 ? 200 : 134));
  }
}

TEST_CASE("a queue takes exactly what its limit says and has room again for what was acknowledged") {
  Lane lane(1u << 20, 2 * 1032);
  CHECK(lane.sender.enqueue(share(Bytes(4001))) == SendResult::too_large);
  CHECK(lane.enqueue(1) == SendResult::queued);
  CHECK(lane.enqueue(2) == SendResult::queued);
  CHECK(lane.sender.queued_bytes() == 2 * 1032);
  CHECK(lane.enqueue(3) == SendResult::queue_full);
  CHECK(lane.send(0.0) == 2);
  CHECK(lane.acknowledge(0, 0, 0.01));
  CHECK(lane.sender.queued_bytes() == 1032);
  CHECK(lane.enqueue(3) == SendResult::queued);
  CHECK(lane.enqueue(4) == SendResult::queue_full);
}

TEST_CASE("an acknowledgement of what was never sent is refused") {
  Lane lane;
  lane.enqueue(1);
  lane.send(0.0);
  CHECK_FALSE(lane.acknowledge(0, 1, 0.01));
  CHECK(lane.acknowledge(0, 0, 0.01));
}

TEST_CASE("a round trip is smoothed as RFC 6298 says and waited for as RFC 9002 says") {
  RoundTrip round_trip;
  round_trip.add(0.1);
  CHECK(round_trip.smoothed_s() == doctest::Approx(0.1));
  CHECK(round_trip.resend_s() == doctest::Approx(0.1 + 4.0 * 0.05));
  round_trip.add(0.2);
  CHECK(round_trip.smoothed_s() == doctest::Approx(0.1125));
  CHECK(round_trip.resend_s() == doctest::Approx(0.1125 + 4.0 * 0.0625));
  CHECK(round_trip.reordering_s() == doctest::Approx(1.125 * 0.2));
  round_trip.add(0.05);  // The smoothed round trip is longer than the latest one.
  CHECK(round_trip.reordering_s() == doctest::Approx(1.125 * (0.1125 - 0.0625 / 8.0)));
  RoundTrip quick;
  quick.add(1e-5);
  CHECK(quick.reordering_s() == doctest::Approx(0.001));
  CHECK(quick.resend_s() == doctest::Approx(0.002));
}

}  // namespace
}  // namespace septet::net
