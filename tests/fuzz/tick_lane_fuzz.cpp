// Hostile bytes against the tick lane's receiver. The first byte chooses between raw datagrams and
// true ticks that are cut, reordered, repeated and altered; whatever comes in, only published
// payloads may come out.

#include <cstdlib>
#include <map>

#include "engine/net/tick_publisher.hpp"
#include "engine/net/tick_receiver.hpp"
#include "tests/engine/net/tick_wire.hpp"

namespace {

using namespace septet;
using namespace septet::net;

void require(bool condition) {
  if (!condition) std::abort();
}

void feed_raw(TickReceiver& receiver, ByteReader& input) {
  while (input.ok() && !input.at_end()) {
    const std::size_t wanted = input.get<std::uint16_t>();
    receiver.accept(input.take(std::min(wanted, input.remaining())));
  }
  require(!receiver.next());
}

void feed_altered(TickReceiver& receiver, const Identity& server, const SessionId& session, ByteReader& input) {
  Recorder wire;
  TickPublisher publisher(wire, server, session, {.max_datagram_bytes = 576u + input.get<std::uint16_t>() % 1000});
  publisher.add_destination({loopback_ip, 1});
  std::map<std::uint64_t, Bytes> published;
  const int ticks = 1 + input.get<std::uint8_t>() % 3;
  for (std::uint64_t tick = 1; tick <= static_cast<std::uint64_t>(ticks); ++tick) {
    published[tick] = Bytes(input.get<std::uint16_t>() % 4000, static_cast<std::byte>(tick));
    publisher.publish(tick, published[tick]);
  }
  while (input.ok() && !input.at_end()) {
    Bytes datagram = wire.datagrams[input.get<std::uint16_t>() % wire.datagrams.size()];
    const std::size_t offset = input.get<std::uint16_t>() % datagram.size();
    datagram[offset] ^= static_cast<std::byte>(input.get<std::uint8_t>());
    datagram.resize(datagram.size() - input.get<std::uint8_t>() % 4);
    receiver.accept(datagram);
    while (const auto tick = receiver.next()) {
      require(published.contains(tick->tick));
      require(published[tick->tick] == tick->payload);
    }
    require(receiver.bytes_held() <= TickReceiver::window * max_tick_bytes);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Identity server = identity_of(1);
  static const SessionId session{1};
  ByteReader input(std::as_bytes(std::span(data, size)));
  TickReceiver receiver(server.public_key());
  receiver.follow(session);
  if (input.get<std::uint8_t>() % 2 == 0)
    feed_raw(receiver, input);
  else
    feed_altered(receiver, server, session, input);
  return 0;
}
