#include "command-line/command/edit/edit_client.hpp"

#include <utility>

#include "program/clock.hpp"

namespace septet::server {

EditClient::EditClient(const editor::EditPlace& place, net::UdpSocket lane, net::UdpSocket tick)
    : lane_(std::move(lane)),
      tick_(std::move(tick)),
      // The server names no group to a client that is no screen.
      link_(lane_, tick_,
            [](const net::Address&, std::uint32_t) -> Expected<std::unique_ptr<net::DatagramSocket>> {
              return failure("an editor hears no group", "the server's welcome", "use the same Septet on both ends");
            },
            {place.name, tick_.local_address().port, {place.server, place.server_key, place.identity, {}}}) {}

Expected<std::unique_ptr<EditClient>> EditClient::open(const editor::EditPlace& place) {
  const net::UdpOptions any{{place.server.ip == net::loopback_ip ? net::loopback_ip : 0, 0}};
  auto lane = net::UdpSocket::open(any);
  if (!lane) return tl::unexpected(lane.error());
  auto tick = net::UdpSocket::open(any);
  if (!tick) return tl::unexpected(tick.error());
  return std::unique_ptr<EditClient>(new EditClient(place, std::move(*lane), std::move(*tick)));
}

void EditClient::pump() { link_.pump(program::monotonic_s()); }

void EditClient::wait(double seconds) const {
  const net::UdpSocket* waiting[] = {&lane_, &tick_};
  net::wait_readable(waiting, seconds);
}

std::vector<EditAnswer> EditClient::take_answers() {
  std::vector<EditAnswer> answers;
  for (const replication::Done& done : link_.replication().take_done()) answers.push_back({done.sequence, done.tick});
  for (replication::Refused& refused : link_.replication().take_refusals()) {
    const std::uint64_t batch = refused.sequence;
    answers.push_back({batch, 0, std::move(refused)});
  }
  return answers;
}

}  // namespace septet::server
