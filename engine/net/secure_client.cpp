#include "engine/net/secure_client.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "engine/core/check.hpp"
#include "engine/core/printable.hpp"
#include "engine/net/channel.hpp"
#include "engine/net/handshake.hpp"

namespace septet::net {
namespace {

constexpr double first_retry_s = 0.05, longest_retry_s = 0.25;
/// Retry interval for a server that has been away for long, and for one that has refused us.
constexpr double patient_after_s = 10.0, patient_retry_s = 1.0;
constexpr double refused_retry_s = 0.1, longest_in_use_retry_s = 2.0, longest_unknown_retry_s = 5.0;
/// Time before an obstacle is reported: a single lost handshake is no obstacle.
constexpr double trial_s = 1.5;
/// Lifetime of the server's last refusal: a server that is still there repeats it sooner.
constexpr double remembered_s = 8.0;
constexpr double cookie_life_s = 4.0;
/// Ping intervals: short until the clock is known well, at first and after one was set.
constexpr double first_pings_s = 0.02, later_pings_s = 0.1;
constexpr std::size_t first_pings = 64;

}  // namespace

struct SecureClient::State {
  State(DatagramSocket& its_socket, SecureClientOptions its_options)
      : socket(its_socket), options(std::move(its_options)) {}

  void receive(std::vector<ClientEvent>& events);
  void take_data(const ReceivedDatagram& datagram, std::vector<ClientEvent>& events);
  void connect(const ClientHandshake::Connected& connected, std::vector<ClientEvent>& events);
  void lose(std::string reason, std::vector<ClientEvent>& events, double knock_after_s = 0.0);
  void knock();
  void take_refusal(std::span<const std::byte> datagram);
  /// Time for which a ping has gone unanswered; not the time since the server was heard, as a client that was busy for
  /// seconds sent no pings.
  double silence_s() const { return channel && channel->heard_s() <= pinged_s ? now_s - pinged_s : 0.0; }
  /// Obstacle to the connection; none while the server is heard, which also makes replies to a new handshake unwanted.
  Obstacle obstacle() const;
  bool hears_server() const { return channel && silence_s() <= options.knock_after_s; }

  DatagramSocket& socket;
  SecureClientOptions options;
  double now_s = 0.0;
  ClientState state = ClientState::connecting;
  bool closed = false;
  std::string loss;
  std::optional<Channel> channel;
  SessionId session{};

  std::optional<ClientHandshake> handshake;
  std::optional<double> trying_since_s;  ///< Start of the handshakes so far without success.
  std::optional<double> answered_s;      ///< Time of the last cookie since then.
  bool has_initiated = false;            ///< True if it has sent an initiation since then.
  /// A cookie came for a hello sent after an initiation: the server has read the initiation and did not understand it.
  bool is_not_understood = false;
  Obstacle refusal = Obstacle::none;  ///< The server's last refusal, since then.
  double refused_s = 0.0;             ///< Time of that refusal.
  double cookie_s = 0.0;
  double next_knock_s = 0.0, retry_s = first_retry_s;

  double next_ping_s = 0.0;
  double pinged_s = 0.0;  ///< Time of the first ping since the server was last heard.
  ChannelCounters past;   ///< Counters of earlier connections, and of datagrams that belong to no connection.
  mutable ChannelCounters asked;
  ClockEstimate no_clock;
};

SecureClient::SecureClient(DatagramSocket& socket, SecureClientOptions options)
    : state_(std::make_unique<State>(socket, std::move(options))) {}
SecureClient::~SecureClient() = default;

std::vector<ClientEvent> SecureClient::pump(double now_s) {
  State& state = *state_;
  SEPTET_CHECK(now_s >= state.now_s, "time goes back from {} to {}", state.now_s, now_s);
  state.now_s = now_s;
  std::vector<ClientEvent> events;
  if (state.closed) return events;
  state.receive(events);
  const double timeout_s = state.options.limits.timeout_s;
  if (state.silence_s() > timeout_s) state.lose(fmt::format("the server is not heard for {:.1f} s", timeout_s), events);
  if (!state.hears_server()) state.knock();
  if (state.channel) {
    if (now_s >= state.next_ping_s) {
      state.channel->ping();
      if (state.channel->heard_s() > state.pinged_s) state.pinged_s = now_s;
      const bool is_unsure = state.channel->clock().pings() < first_pings && state.silence_s() < later_pings_s;
      state.next_ping_s = now_s + (is_unsure ? first_pings_s : later_pings_s);
    }
    state.channel->advance_to(now_s);
    state.channel->emit(state.socket, now_s, state.options.limits.max_bytes_per_pump);
  }
  state.socket.flush();
  return events;
}

void SecureClient::State::receive(std::vector<ClientEvent>& events) {
  for (std::size_t i = 0; i < max_datagrams_per_pump; ++i) {
    const auto datagram = socket.receive();
    if (!datagram) return;
    if (datagram->from != options.server) {
      ++past.unknown;
      continue;
    }
    const auto kind = scene_datagram_kind(datagram->bytes);
    if (kind == SceneDatagramKind::data) {
      take_data(*datagram, events);
    } else if (kind == SceneDatagramKind::cookie && handshake) {
      if (handshake->has_cookie() || !handshake->accept_cookie(datagram->bytes)) {
        ++past.bad_cookies;
        continue;
      }
      cookie_s = now_s;
      answered_s = now_s;
      is_not_understood = is_not_understood || has_initiated;
      has_initiated = true;
      if (refusal == Obstacle::other_version) refusal = Obstacle::none;
      socket.send(options.server, handshake->initiation());
    } else if (kind == SceneDatagramKind::response && handshake && !hears_server()) {
      const auto connected = handshake->accept_response(datagram->bytes);
      if (connected && are_usable(connected->server))
        connect(*connected, events);
      else
        ++past.forged;
    } else if (kind == SceneDatagramKind::refusal && handshake && !hears_server()) {
      take_refusal(datagram->bytes);
    } else if (is_of_other_version(datagram->bytes) && handshake && !hears_server()) {
      // A version that we do not know cannot be authenticated; so this changes the reported obstacle and nothing else.
      if (refusal == Obstacle::none) refusal = Obstacle::other_version;
      refused_s = now_s;
    } else {
      ++past.malformed;
    }
  }
}

void SecureClient::State::take_refusal(std::span<const std::byte> datagram) {
  const auto reason = handshake->accept_refusal(datagram);
  if (!reason) {
    ++past.forged;
    return;
  }
  has_initiated = is_not_understood = false;
  const bool in_use = *reason == HandshakeRefusal::key_in_use;
  const Obstacle before = std::exchange(refusal, in_use ? Obstacle::key_in_use : Obstacle::key_unknown);
  refused_s = now_s;
  if (before != refusal) retry_s = refused_retry_s;
  handshake.reset();
  next_knock_s = now_s + retry_s;
  retry_s = std::min(retry_s * 1.5, in_use ? longest_in_use_retry_s : longest_unknown_retry_s);
}

void SecureClient::State::take_data(const ReceivedDatagram& datagram, std::vector<ClientEvent>& events) {
  const auto number = connection_of(datagram.bytes);
  if (!number) {
    ++past.malformed;
    return;
  }
  if (!channel || *number != channel->connection()) {
    ++past.unknown;
    return;
  }
  std::vector<ChannelMessage> messages;
  const Channel::Verdict verdict = channel->accept(datagram, now_s, messages);
  for (ChannelMessage& message : messages)
    events.push_back(
        {.kind = ClientEvent::Kind::message, .reliability = message.reliability, .bytes = std::move(message.bytes)});
  if (verdict == Channel::Verdict::goodbye)
    lose(fmt::format("the server said goodbye: {}", printable(channel->goodbye())), events, longest_retry_s);
  if (verdict == Channel::Verdict::broken) lose("the server broke the protocol", events);
}

void SecureClient::State::connect(const ClientHandshake::Connected& connected, std::vector<ClientEvent>& events) {
  if (channel) lose("the server has been started anew, or had lost this connection", events);
  const Channel::Options channel_options{.connection = connected.connection,
                                         .peer = options.server,
                                         .keys = connected.keys,
                                         .own = terms_of(options.limits, socket, options.server, 1),
                                         .theirs = connected.server,
                                         .limits = options.limits};
  channel.emplace(channel_options, now_s);
  session = connected.session;
  handshake.reset();
  retry_s = first_retry_s;
  trying_since_s.reset();
  answered_s.reset();
  has_initiated = is_not_understood = false;
  refusal = Obstacle::none;
  state = ClientState::connected;
  pinged_s = -1.0;
  next_ping_s = now_s;  // The first ping also confirms the connection to the server.
  events.push_back({.kind = ClientEvent::Kind::connected});
}

void SecureClient::State::lose(std::string reason, std::vector<ClientEvent>& events, double knock_after_s) {
  past += channel->counters();
  channel.reset();
  state = ClientState::lost;
  loss = reason;
  next_knock_s = now_s + knock_after_s;
  events.push_back({.kind = ClientEvent::Kind::lost, .reason = std::move(reason)});
}

/// Sends hello or initiation, repeatedly, a little slower each time.
void SecureClient::State::knock() {
  if (now_s < next_knock_s) return;
  if (!trying_since_s) trying_since_s = now_s;
  const bool stale = handshake && handshake->has_cookie() && now_s - cookie_s > cookie_life_s;
  if (!handshake || stale)
    handshake = ClientHandshake::start(options.identity, options.server_key,
                                       terms_of(options.limits, socket, options.server, 1));
  if (!handshake) return;  // The pinned key is invalid; no server can have it.
  socket.send(options.server, handshake->has_cookie() ? handshake->initiation() : handshake->hello());
  next_knock_s = now_s + retry_s;
  const bool refused = refusal == Obstacle::key_in_use || refusal == Obstacle::key_unknown;
  const bool patient = now_s - *trying_since_s > patient_after_s;
  if (!refused) retry_s = std::min(retry_s * 1.5, patient ? patient_retry_s : longest_retry_s);
}

Obstacle SecureClient::State::obstacle() const {
  if (hears_server() || !trying_since_s) return Obstacle::none;
  if (refusal != Obstacle::none && now_s - refused_s < remembered_s) return refusal;
  if (now_s - *trying_since_s < trial_s) return Obstacle::none;
  if (!answered_s || now_s - *answered_s >= remembered_s) return Obstacle::no_answer;
  // A busy server replies late; that is not reported.
  return is_not_understood ? Obstacle::other_server_key : Obstacle::none;
}

bool SecureClient::has_backlog() const { return state_->channel && state_->channel->wants_to_send(); }

SendResult SecureClient::send(SharedBytes message, Reliability reliability) {
  if (!state_->channel || state_->closed) return SendResult::not_connected;
  return state_->channel->send(std::move(message), reliability);
}

SendResult SecureClient::send(std::span<const std::byte> message, Reliability reliability) {
  return send(share(Bytes(message.begin(), message.end())), reliability);
}

void SecureClient::close() {
  if (state_->channel) state_->channel->say_goodbye("closing", state_->socket);
  state_->socket.flush();
  state_->closed = true;
  state_->channel.reset();
  state_->state = ClientState::lost;
}

void SecureClient::leave_for(double seconds) {
  State& state = *state_;
  if (!state.channel || state.closed) return;
  state.channel->say_goodbye("leaving", state.socket);
  state.socket.flush();
  state.past += state.channel->counters();
  state.channel.reset();
  state.state = ClientState::lost;
  state.loss = "this end has left";
  state.next_knock_s = state.now_s + seconds;
}

Obstacle SecureClient::obstacle() const { return state_->obstacle(); }
const std::string& SecureClient::loss() const { return state_->loss; }
ClientState SecureClient::state() const { return state_->state; }
double SecureClient::silence_s() const { return state_->silence_s(); }
const SessionId& SecureClient::session() const { return state_->session; }
const ClockEstimate& SecureClient::clock() const {
  return state_->channel ? state_->channel->clock() : state_->no_clock;
}
double SecureClient::round_trip_s() const { return state_->channel ? state_->channel->round_trip_s() : 0.0; }

const ChannelCounters& SecureClient::counters() const {
  state_->asked = state_->past;
  if (state_->channel) state_->asked += state_->channel->counters();
  return state_->asked;
}

}  // namespace septet::net
