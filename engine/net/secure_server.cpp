#include "engine/net/secure_server.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/core/check.hpp"
#include "engine/net/channel.hpp"
#include "engine/net/handshake.hpp"

namespace septet::net {
namespace {

constexpr double handshakes_per_s = 50.0;
constexpr double unconfirmed_s = 10.0;
constexpr double refusal_report_s = 1.0, same_refusal_report_s = 30.0;
/// Two pings: a client silent for longer may have been restarted elsewhere, unless it is usually heard more seldom.
constexpr double least_alive_s = 0.5;
/// Number of silences after which a client's usual silence is known; one counts if it is longer than the gaps within
/// one burst of datagrams.
constexpr int known_silences = 4;
constexpr double silence_s = 0.05;
/// Patience with a client whose usual silence is not yet known: it may be drawing its first picture.
constexpr double unknown_alive_s = 5.0;
constexpr double forgets_silences_s = 10.0;
/// Least size of a hello: no reply is longer than its request, so that the server amplifies no traffic.
constexpr std::size_t smallest_hello_bytes = 3 + 32;
/// Bytes that one connection may send before the next one has its turn.
constexpr std::size_t turn_bytes = 64 * 1024;

struct Connection {
  Channel channel;
  AllowedClient client;
  bool confirmed = false;
  double created_s = 0.0;
  Key32 client_ephemeral{};
  Bytes response{};
  std::string drop_reason{};  ///< Set: to be disconnected, for this reason.
  int silences = 0;
  double usual_silence_s = 0.0;  ///< Longest recent silence, decaying: a screen at one picture a second has one second.

  void hear(double now_s, double before_s);
  double alive_s(double timeout_s) const;
};

void Connection::hear(double now_s, double before_s) {
  const double was_silent_s = now_s - before_s;
  usual_silence_s = std::max(was_silent_s, usual_silence_s * std::exp(-was_silent_s / forgets_silences_s));
  if (was_silent_s >= silence_s && silences < known_silences) ++silences;
}

/// Silence up to which the client counts as live.
double Connection::alive_s(double timeout_s) const {
  const double most_s = std::min(timeout_s, unknown_alive_s);
  return silences < known_silences ? most_s
                                   : std::clamp(2.0 * usual_silence_s, least_alive_s, std::max(most_s, least_alive_s));
}

}  // namespace

struct SecureServer::State {
  State(DatagramSocket& its_socket, SecureServerOptions its_options)
      : socket(its_socket), options(std::move(its_options)) {}

  void receive(std::vector<ServerEvent>& events);
  void begin_handshake(const ReceivedDatagram& datagram, std::vector<ServerEvent>& events);
  void take_data(const ReceivedDatagram& datagram, std::vector<ServerEvent>& events);
  void confirm(Connection& connection, std::vector<ServerEvent>& events);
  void mark_the_silent();
  void drop_the_marked(std::vector<ServerEvent>& events);
  void emit();
  const AllowedClient* find_allowed(const PublicKey& key) const;
  std::uint32_t unused_number() const;
  void refuse(const ServerHandshake& handshake, HandshakeRefusal why, const Address& from,
              std::vector<ServerEvent>& events);
  const Connection* living_namesake(const PublicKey& key, const Address& from) const;

  DatagramSocket& socket;
  SecureServerOptions options;
  CookieJar cookies;
  std::map<std::uint32_t, Connection> connections;
  double now_s = 0.0;
  double listened_s = 0.0;  ///< Time of the last receive: later silence is the server's own.
  double handshake_tokens = handshakes_per_s / 5.0;
  double refusal_reported_s = -refusal_report_s;
  PublicKey refusal_reported{};
  std::uint32_t next_turn = 0;  ///< Connection that sends first in the next pump.
  ChannelCounters strangers;    ///< Counters of datagrams without a connection, and of past connections.
  mutable ClientInfo asked;
};

SecureServer::SecureServer(DatagramSocket& socket, SecureServerOptions options)
    : state_(std::make_unique<State>(socket, std::move(options))) {}
SecureServer::~SecureServer() = default;

std::vector<ServerEvent> SecureServer::pump(double now_s) {
  State& state = *state_;
  SEPTET_CHECK(now_s >= state.now_s, "time goes back from {} to {}", state.now_s, now_s);
  state.handshake_tokens =
      std::min(state.handshake_tokens + (now_s - state.now_s) * handshakes_per_s, handshakes_per_s / 5.0);
  state.listened_s = state.now_s;
  state.now_s = now_s;
  std::vector<ServerEvent> events;
  state.receive(events);
  state.mark_the_silent();
  state.drop_the_marked(events);
  state.emit();
  return events;
}

void SecureServer::State::receive(std::vector<ServerEvent>& events) {
  for (std::size_t i = 0; i < max_datagrams_per_pump; ++i) {
    const auto datagram = socket.receive();
    if (!datagram) return;
    const auto kind = scene_datagram_kind(datagram->bytes);
    if (kind == SceneDatagramKind::hello) {
      if (const auto answer = cookies.answer(datagram->bytes, datagram->from, now_s))
        socket.send(datagram->from, *answer);
      else
        ++strangers.malformed;
    } else if (kind == SceneDatagramKind::initiation) {
      begin_handshake(*datagram, events);
    } else if (kind == SceneDatagramKind::data) {
      take_data(*datagram, events);
    } else {
      ++strangers.malformed;
      // Tells the sender the version spoken here, and nothing else.
      if (is_of_other_version(datagram->bytes) && datagram->bytes.size() >= smallest_hello_bytes) {
        Bytes answer;
        ByteWriter writer(answer);
        write_scene_prefix(SceneDatagramKind::refusal, writer);
        socket.send(datagram->from, answer);
      }
    }
  }
}

void SecureServer::State::begin_handshake(const ReceivedDatagram& datagram, std::vector<ServerEvent>& events) {
  if (!cookies.is_good(datagram.bytes, datagram.from, now_s)) {
    ++strangers.bad_cookies;
    return;
  }
  if (handshake_tokens < 1.0) return;
  handshake_tokens -= 1.0;
  const auto handshake = ServerHandshake::accept(datagram.bytes, options.identity);
  if (!handshake) {
    ++strangers.forged;
    return;
  }
  const AllowedClient* client = find_allowed(handshake->client());
  if (!client) return refuse(*handshake, HandshakeRefusal::key_unknown, datagram.from, events);
  if (!are_usable(handshake->client_terms())) {
    ++strangers.malformed;
    return;
  }
  for (auto& [number, connection] : connections) {
    if (connection.client.key != client->key) continue;
    if (connection.client_ephemeral == handshake->client_ephemeral()) {
      // The response was lost, or this is a repetition that opens nothing.
      if (!connection.confirmed && connection.channel.peer() == datagram.from)
        socket.send(datagram.from, connection.response);
      return;
    }
  }
  if (living_namesake(client->key, datagram.from))
    return refuse(*handshake, HandshakeRefusal::key_in_use, datagram.from, events);
  std::erase_if(connections,
                [&](const auto& entry) { return !entry.second.confirmed && entry.second.client.key == client->key; });
  const Terms own = terms_of(options.limits, socket, datagram.from, options.allowed.size());
  const std::uint32_t number = unused_number();
  auto answer = handshake->respond(number, options.session, own);
  if (!answer) {
    ++strangers.forged;
    return;
  }
  socket.send(datagram.from, answer->response);
  const Channel::Options channel{.connection = number,
                                 .peer = datagram.from,
                                 .keys = answer->keys,
                                 .own = own,
                                 .theirs = handshake->client_terms(),
                                 .limits = options.limits};
  connections.emplace(number, Connection{.channel = Channel(channel, now_s),
                                         .client = *client,
                                         .created_s = now_s,
                                         .client_ephemeral = handshake->client_ephemeral(),
                                         .response = std::move(answer->response)});
}

void SecureServer::State::take_data(const ReceivedDatagram& datagram, std::vector<ServerEvent>& events) {
  const auto number = connection_of(datagram.bytes);
  if (!number) {
    ++strangers.malformed;
    return;
  }
  const auto found = connections.find(*number);
  if (found == connections.end() || found->second.channel.peer() != datagram.from) {
    ++strangers.unknown;
    return;
  }
  Connection& connection = found->second;
  if (!connection.drop_reason.empty()) return;
  std::vector<ChannelMessage> messages;
  const double heard_before_s = connection.channel.heard_s();
  const Channel::Verdict verdict = connection.channel.accept(datagram, now_s, messages);
  if (verdict == Channel::Verdict::refused) return;
  connection.hear(now_s, heard_before_s);
  if (!connection.confirmed) confirm(connection, events);
  for (ChannelMessage& message : messages)
    events.push_back({.kind = ServerEvent::Kind::message,
                      .client = *number,
                      .reliability = message.reliability,
                      .bytes = std::move(message.bytes)});
  if (verdict == Channel::Verdict::goodbye) connection.drop_reason = "it said goodbye";
  if (verdict == Channel::Verdict::broken) connection.drop_reason = "it broke the protocol";
}

void SecureServer::State::confirm(Connection& connection, std::vector<ServerEvent>& events) {
  connection.confirmed = true;
  for (auto& [number, other] : connections)
    if (&other != &connection && other.confirmed && other.client.key == connection.client.key)
      other.drop_reason = "the same client has connected anew";
  drop_the_marked(events);
  events.push_back({.kind = ServerEvent::Kind::connected,
                    .client = connection.channel.connection(),
                    .name = connection.client.name});
}

void SecureServer::State::mark_the_silent() {
  std::erase_if(connections, [&](const auto& entry) {
    return !entry.second.confirmed && now_s - entry.second.created_s > unconfirmed_s;
  });
  for (auto& [number, connection] : connections) {
    const double silent_s = now_s - connection.channel.heard_s();
    if (connection.confirmed && connection.drop_reason.empty() && silent_s > options.limits.timeout_s)
      connection.drop_reason = fmt::format("not heard for {:.1f} s", silent_s);
  }
}

void SecureServer::State::drop_the_marked(std::vector<ServerEvent>& events) {
  for (auto entry = connections.begin(); entry != connections.end();) {
    Connection& connection = entry->second;
    if (connection.drop_reason.empty()) {
      ++entry;
      continue;
    }
    if (connection.confirmed) {
      connection.channel.say_goodbye(connection.drop_reason, socket);
      events.push_back(
          {.kind = ServerEvent::Kind::disconnected, .client = entry->first, .reason = connection.drop_reason});
    }
    strangers += connection.channel.counters();
    entry = connections.erase(entry);
  }
}

/// Sends in turns, so that no transfer holds up another; starts where the last pump's budget ended.
void SecureServer::State::emit() {
  std::size_t budget = options.limits.max_bytes_per_pump;
  std::vector<Connection*> turns;
  for (auto entry = connections.lower_bound(next_turn); entry != connections.end(); ++entry)
    turns.push_back(&entry->second);
  for (auto entry = connections.begin(); entry != connections.lower_bound(next_turn); ++entry)
    turns.push_back(&entry->second);
  std::erase_if(turns, [](const Connection* connection) { return !connection->confirmed; });
  for (Connection* connection : turns) connection->channel.advance_to(now_s);
  for (bool is_first = true; !turns.empty(); is_first = false) {
    for (Connection* connection : turns) {
      if (!is_first && budget == 0) break;
      const std::size_t sent = connection->channel.emit(socket, now_s, std::min(turn_bytes, budget));
      budget -= std::min(sent, budget);
      next_turn = connection->channel.connection() + 1;
    }
    if (budget == 0) break;
    std::erase_if(turns, [](const Connection* connection) { return !connection->channel.wants_to_send(); });
  }
  socket.flush();
}

const AllowedClient* SecureServer::State::find_allowed(const PublicKey& key) const {
  const auto found = std::find_if(options.allowed.begin(), options.allowed.end(),
                                  [&](const AllowedClient& client) { return client.key == key; });
  return found == options.allowed.end() ? nullptr : &*found;
}

std::uint32_t SecureServer::State::unused_number() const {
  while (true) {
    const Key32 random = random_key();
    const std::uint32_t number = std::uint32_t{random[0]} | std::uint32_t{random[1]} << 8 |
                                 std::uint32_t{random[2]} << 16 | std::uint32_t{random[3]} << 24;
    if (number != 0 && !connections.contains(number)) return number;
  }
}

/// A connection with this key from another address that was heard while the server listened.
const Connection* SecureServer::State::living_namesake(const PublicKey& key, const Address& from) const {
  for (const auto& [number, connection] : connections)
    if (connection.confirmed && connection.drop_reason.empty() && connection.client.key == key &&
        connection.channel.peer() != from &&
        listened_s - connection.channel.heard_s() < connection.alive_s(options.limits.timeout_s))
      return &connection;
  return nullptr;
}

void SecureServer::State::refuse(const ServerHandshake& handshake, HandshakeRefusal why, const Address& from,
                                 std::vector<ServerEvent>& events) {
  const PublicKey& key = handshake.client();
  if (const auto answer = handshake.refuse(why)) socket.send(from, *answer);
  ++strangers.not_allowed;
  const double since_s = now_s - refusal_reported_s;
  if (since_s < (key == refusal_reported ? same_refusal_report_s : refusal_report_s)) return;
  refusal_reported_s = now_s;
  refusal_reported = key;
  const AllowedClient* client = find_allowed(key);
  const Connection* first = living_namesake(key, from);
  std::string reason = client && first
                           ? fmt::format("a second client with the key of {} at {}; the first one, at {}, is alive",
                                         client->name, to_text(from), to_text(first->channel.peer()))
                           : fmt::format("a client at {} has the key {}, which is not on the list of allowed clients",
                                         to_text(from), to_text(key));
  events.push_back({.kind = ServerEvent::Kind::refused, .reason = std::move(reason)});
}

bool SecureServer::has_backlog() const {
  return std::any_of(state_->connections.begin(), state_->connections.end(),
                     [](const auto& entry) { return entry.second.confirmed && entry.second.channel.wants_to_send(); });
}

SendResult SecureServer::send(ClientId client, SharedBytes message, Reliability reliability) {
  const auto found = state_->connections.find(client);
  if (found == state_->connections.end() || !found->second.confirmed || !found->second.drop_reason.empty())
    return SendResult::not_connected;
  const SendResult result = found->second.channel.send(std::move(message), reliability);
  if (result == SendResult::queue_full && reliability == Reliability::reliable)
    found->second.drop_reason = "it does not keep up: its queue is full";
  return result;
}

SendResult SecureServer::send(ClientId client, std::span<const std::byte> message, Reliability reliability) {
  return send(client, share(Bytes(message.begin(), message.end())), reliability);
}

void SecureServer::disconnect(ClientId client, std::string reason) {
  const auto found = state_->connections.find(client);
  if (found != state_->connections.end() && found->second.confirmed)
    found->second.drop_reason = reason.empty() ? "the server ends the connection" : std::move(reason);
}

void SecureServer::set_allowed(std::vector<AllowedClient> allowed) {
  state_->options.allowed = std::move(allowed);
  std::erase_if(state_->connections, [&](const auto& entry) {
    return !entry.second.confirmed && !state_->find_allowed(entry.second.client.key);
  });
  for (auto& [number, connection] : state_->connections) {
    const AllowedClient* client = state_->find_allowed(connection.client.key);
    if (!client || client->name != connection.client.name) connection.drop_reason = "it is no longer allowed";
  }
}

std::vector<ClientId> SecureServer::clients() const {
  std::vector<ClientId> result;
  for (const auto& [number, connection] : state_->connections)
    if (connection.confirmed && connection.drop_reason.empty()) result.push_back(number);
  return result;
}

const ClientInfo* SecureServer::info(ClientId client) const {
  const auto found = state_->connections.find(client);
  if (found == state_->connections.end() || !found->second.confirmed) return nullptr;
  const Connection& connection = found->second;
  state_->asked = {.key = connection.client.key,
                   .name = connection.client.name,
                   .address = connection.channel.peer(),
                   .heard_s = connection.channel.heard_s(),
                   .round_trip_s = connection.channel.round_trip_s(),
                   .queued_bytes = connection.channel.queued_bytes(),
                   .counters = connection.channel.counters()};
  return &state_->asked;
}

ChannelCounters SecureServer::counters() const {
  ChannelCounters sum = state_->strangers;
  for (const auto& [number, connection] : state_->connections) sum += connection.channel.counters();
  return sum;
}

}  // namespace septet::net
