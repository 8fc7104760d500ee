#include <doctest/doctest.h>

#include "tests/engine/net/tick_fixtures.hpp"

namespace septet::net {
namespace {

TEST_CASE("replayed ticks of this run and of an earlier run are refused") {
  Recorder recorder;
  TickPublisher publisher(recorder, identity_of(1), session_of(2), {.repeat_previous = false});
  publisher.add_destination(group);
  for (std::uint64_t tick = 1; tick <= 20; ++tick) publisher.publish(tick, random_bytes(50, tick));
  TickReceiver receiver = following(2);
  for (const Bytes& datagram : recorder.datagrams) receiver.accept(datagram);
  CHECK(receiver.counters().ticks == 20);
  for (const Bytes& datagram : recorder.datagrams) receiver.accept(datagram);
  CHECK(receiver.counters().ticks == 20);
  CHECK(receiver.counters().replayed == 12);
  CHECK(receiver.counters().duplicates == 8);
  for (const Bytes& datagram : datagrams_of(1000, random_bytes(50, 1), {}, 1, 1)) receiver.accept(datagram);
  CHECK(receiver.counters().other_session == 1);
  CHECK(receiver.counters().ticks == 20);
}

TEST_CASE("before it follows a session a receiver takes nothing") {
  TickReceiver receiver(identity_of(1).public_key());
  for (const Bytes& datagram : datagrams_of(5, random_bytes(50, 1))) receiver.accept(datagram);
  CHECK(receiver.counters().ticks == 0);
  CHECK(receiver.counters().other_session == 1);
}

TEST_CASE("reassembly memory is bounded when no tick is ever complete") {
  Recorder recorder;
  TickPublisher publisher(recorder, identity_of(1), session_of(1), {.repeat_previous = false});
  publisher.add_destination(group);
  TickReceiver receiver = following();
  const Bytes payload = random_bytes(max_tick_bytes, 1);
  std::size_t most = 0;
  for (std::uint64_t tick = 1; tick <= 20; ++tick) {
    recorder.datagrams.clear();
    publisher.publish(tick, payload);
    receiver.accept(recorder.datagrams[0]);
    most = std::max(most, receiver.bytes_held());
  }
  CHECK(most == TickReceiver::window * max_tick_bytes);
  CHECK(receiver.counters().lost == 20 - TickReceiver::window);
}

TEST_CASE("ticks that nobody takes are bounded too and the newest stay") {
  TickReceiver receiver = following();
  Recorder recorder;
  TickPublisher publisher(recorder, identity_of(1), session_of(1), {.repeat_previous = false});
  publisher.add_destination(group);
  for (std::uint64_t tick = 1; tick <= 100; ++tick) publisher.publish(tick, random_bytes(500, tick));
  for (const Bytes& datagram : recorder.datagrams) receiver.accept(datagram);
  CHECK(receiver.bytes_held() == 16 * 500);
  CHECK(receiver.next()->tick == 85);
}

TEST_CASE("a tick is lost when it leaves the window and not before") {
  Recorder recorder;
  TickPublisher publisher(recorder, identity_of(1), session_of(1), {.repeat_previous = false});
  publisher.add_destination(group);
  for (std::uint64_t tick = 1; tick <= TickReceiver::window + 1; ++tick)
    publisher.publish(tick, random_bytes(50, tick));
  TickReceiver receiver = following();
  receiver.accept(recorder.datagrams[0]);
  receiver.accept(recorder.datagrams[TickReceiver::window]);
  CHECK(receiver.counters().lost == 0);  // The first tick left the window complete.
  for (std::size_t late = 1; late < TickReceiver::window; ++late) receiver.accept(recorder.datagrams[late]);
  CHECK(receiver.counters().ticks == TickReceiver::window + 1);
  TickReceiver without_second = following();
  for (std::size_t n = 0; n < TickReceiver::window; ++n)
    if (n != 1) without_second.accept(recorder.datagrams[n]);
  CHECK(without_second.counters().lost == 0);
  publisher.publish(50, random_bytes(50, 1));
  without_second.accept(recorder.datagrams[TickReceiver::window]);
  CHECK(without_second.counters().lost == 0);
  without_second.accept(recorder.datagrams[TickReceiver::window + 1]);
  CHECK(without_second.counters().lost == 1);
  without_second.accept(recorder.datagrams[1]);
  CHECK(without_second.counters().replayed == 1);
}

TEST_CASE("of the same session a receiver follows on and of another one it begins anew") {
  TickReceiver receiver = following(1);
  for (const Bytes& datagram : datagrams_of(5, random_bytes(50, 1))) receiver.accept(datagram);
  CHECK_FALSE(receiver.follow(session_of(1)));
  for (const Bytes& datagram : datagrams_of(5, random_bytes(50, 1))) receiver.accept(datagram);
  CHECK(receiver.counters().ticks == 1);
  CHECK(receiver.counters().duplicates == 1);
  CHECK(receiver.follow(session_of(2)));
  CHECK_FALSE(receiver.next());
  for (const Bytes& datagram : datagrams_of(5, random_bytes(50, 1), {}, 1, 2)) receiver.accept(datagram);
  CHECK(receiver.counters().ticks == 2);
}

}  // namespace
}  // namespace septet::net
