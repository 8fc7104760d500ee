// Hostile bytes against the scene lane. The first byte chooses between strangers' datagrams, from
// which nobody may ever come to be connected, and frames that an authenticated end has sealed,
// which may at worst end the connection.

#include <cstdlib>
#include <deque>

#include "engine/net/channel.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/net/secure_server.hpp"
#include "tests/engine/net/tick_wire.hpp"

namespace {

using namespace septet;
using namespace septet::net;

const Address there{loopback_ip, 2};

class Queue final : public DatagramSocket {
 public:
  bool send(const Address&, std::span<const std::byte>) override { return true; }
  void flush() override {}
  std::optional<ReceivedDatagram> receive() override {
    if (waiting.empty()) return std::nullopt;
    taken = std::move(waiting.front());
    waiting.pop_front();
    return ReceivedDatagram{there, taken};
  }
  std::size_t receive_buffer_bytes() const override { return 1 << 20; }
  std::deque<Bytes> waiting;
  Bytes taken;
};

void require(bool condition) {
  if (!condition) std::abort();
}

std::span<const std::byte> next_part(ByteReader& input) {
  const std::size_t wanted = input.get<std::uint16_t>() % 2048;
  return input.take(std::min(wanted, input.remaining()));
}

void feed_strangers(ByteReader& input) {
  static const Identity server_identity = identity_of(1), client_identity = identity_of(2);
  Queue server_socket, client_socket;
  SecureServer server(server_socket, {server_identity, SessionId{1}, {{client_identity.public_key(), "screen"}}, {}});
  SecureClient client(client_socket, {there, server_identity.public_key(), client_identity, {}});
  double now_s = 1.0;
  require(client.pump(now_s).empty());
  while (input.ok() && !input.at_end()) {
    const auto part = next_part(input);
    server_socket.waiting.emplace_back(part.begin(), part.end());
    client_socket.waiting.emplace_back(part.begin(), part.end());
    now_s += 0.01;
    require(server.pump(now_s).empty());
    require(client.pump(now_s).empty());
  }
  require(server.clients().empty());
}

void feed_sealed(ByteReader& input) {
  const ChannelKeys keys{.sending = {1}, .receiving = {2}};
  ChannelLimits limits;
  limits.max_message_bytes = 100'000;
  limits.window_bytes = 64 * 1024;
  Queue socket;
  const Terms terms = terms_of(limits, socket, there, 1);
  Channel channel({.connection = 9, .peer = there, .keys = keys, .own = terms, .theirs = terms, .limits = limits}, 0.0);
  std::vector<ChannelMessage> messages;
  double now_s = 0.0;
  for (std::uint64_t number = 0; input.ok() && !input.at_end(); ++number) {
    const auto steps = input.get<std::uint8_t>();
    if (steps & 1) channel.send(share(Bytes(steps * 40u)), steps & 2 ? Reliability::reliable : Reliability::unreliable);
    if (steps & 4) channel.advance_to(now_s += 0.005);
    Bytes datagram;
    ByteWriter writer(datagram);
    write_scene_prefix(SceneDatagramKind::data, writer);
    writer.put(std::uint32_t{9});
    writer.put(number);
    const Bytes header = datagram;
    seal(keys.receiving, number, header, next_part(input), datagram);
    const Channel::Verdict verdict = channel.accept({there, datagram}, now_s, messages);
    require(verdict != Channel::Verdict::refused);
    if (verdict != Channel::Verdict::good) return;
    channel.emit(socket, now_s, 64 * 1024);
    messages.clear();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteReader input(std::as_bytes(std::span(data, size)));
  if (input.get<std::uint8_t>() % 2 == 0)
    feed_strangers(input);
  else
    feed_sealed(input);
  return 0;
}
