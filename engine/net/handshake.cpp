#include "engine/net/handshake.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/core/check.hpp"

namespace septet::net {
namespace {

constexpr std::uint8_t first_byte = 0x53;
constexpr std::uint8_t version = 1;
constexpr double cookie_slot_s = 5.0;
constexpr std::size_t terms_bytes = 20;

template <std::size_t N>
std::array<std::uint8_t, N> take_array(ByteReader& reader) {
  std::array<std::uint8_t, N> array{};
  const auto bytes = reader.take(N);
  if (!bytes.empty()) std::memcpy(array.data(), bytes.data(), N);
  return array;
}

void put_terms(const Terms& terms, ByteWriter& writer) {
  writer.put(terms.max_datagram_bytes);
  writer.put(terms.max_message_bytes);
  writer.put(terms.window_bytes);
  writer.put(terms.flight_bytes);
}

Terms take_terms(ByteReader& reader) {
  Terms terms;
  terms.max_datagram_bytes = reader.get<std::uint32_t>();
  terms.max_message_bytes = reader.get<std::uint64_t>();
  terms.window_bytes = reader.get<std::uint32_t>();
  terms.flight_bytes = reader.get<std::uint32_t>();
  return terms;
}

/// The datagram after its prefix, if it is of this kind and length.
std::optional<ByteReader> body(std::span<const std::byte> datagram, SceneDatagramKind kind, std::size_t bytes) {
  if (scene_datagram_kind(datagram) != kind || datagram.size() != scene_prefix_bytes + bytes) return std::nullopt;
  return ByteReader(datagram.subspan(scene_prefix_bytes));
}

constexpr std::size_t sealed_bytes = 32 + seal_bytes + terms_bytes + seal_bytes;
constexpr std::size_t hello_body = 32;
constexpr std::size_t cookie_body = 16 + 16;
constexpr std::size_t initiation_body = 16 + 32 + sealed_bytes;
constexpr std::size_t response_body = 16 + 32 + 4 + 16 + terms_bytes + seal_bytes;
constexpr std::size_t refusal_body = 16 + 32 + 1 + seal_bytes;

}  // namespace

std::optional<SceneDatagramKind> scene_datagram_kind(std::span<const std::byte> datagram) {
  ByteReader reader(datagram);
  const auto first = reader.get<std::uint8_t>(), its_version = reader.get<std::uint8_t>(),
             kind = reader.get<std::uint8_t>();
  if (!reader.ok() || first != first_byte || its_version != version || kind < 1 || kind > 6) return std::nullopt;
  return static_cast<SceneDatagramKind>(kind);
}

bool is_of_other_version(std::span<const std::byte> datagram) {
  ByteReader reader(datagram);
  const auto first = reader.get<std::uint8_t>(), its_version = reader.get<std::uint8_t>();
  return reader.ok() && first == first_byte && its_version != version;
}

void write_scene_prefix(SceneDatagramKind kind, ByteWriter& writer) {
  writer.put(first_byte);
  writer.put(version);
  writer.put(static_cast<std::uint8_t>(kind));
}

Transcript::Transcript(const PublicKey& server) {
  constexpr std::string_view protocol = "septet scene 1";
  hash_ = chaining_ = hash32({std::as_bytes(std::span(protocol))});
  mix_hash(as_bytes_of(server));
}

void Transcript::mix_hash(std::span<const std::byte> bytes) { hash_ = hash32({as_bytes_of(hash_), bytes}); }

void Transcript::mix_key(const Key32& shared) {
  const KeyPair32 keys = derive_keys(chaining_, as_bytes_of(shared));
  chaining_ = keys.first;
  key_ = keys.second;
}

void Transcript::seal_text(std::span<const std::byte> text, Bytes& out) {
  const std::size_t begin = out.size();
  seal(key_, 0, as_bytes_of(hash_), text, out);
  mix_hash(std::span(out).subspan(begin));
}

bool Transcript::open_text(std::span<const std::byte> sealed, Bytes& out) {
  if (!open(key_, 0, as_bytes_of(hash_), sealed, out)) return false;
  mix_hash(sealed);
  return true;
}

KeyPair32 Transcript::split() const {
  constexpr std::string_view text = "split";
  return derive_keys(chaining_, std::as_bytes(std::span(text)));
}

ClientHandshake::ClientHandshake(const Identity& client, const PublicKey& server)
    : static_(exchange_keys_of(client)), ephemeral_(random_exchange_keys()), transcript_(server) {}

std::optional<ClientHandshake> ClientHandshake::start(const Identity& client, const PublicKey& server,
                                                      const Terms& own) {
  const auto server_exchange = exchange_key_of(server);
  if (!server_exchange) return std::nullopt;
  ClientHandshake handshake(client, server);
  const auto ephemeral_static = shared_secret(handshake.ephemeral_.secret, *server_exchange);
  const auto static_static = shared_secret(handshake.static_.secret, *server_exchange);
  if (!ephemeral_static || !static_static) return std::nullopt;

  Transcript& transcript = handshake.transcript_;
  transcript.mix_hash(as_bytes_of(handshake.ephemeral_.public_key));
  transcript.mix_key(*ephemeral_static);
  transcript.seal_text(as_bytes_of(client.public_key()), handshake.sealed_);
  transcript.mix_key(*static_static);
  Bytes terms;
  ByteWriter writer(terms);
  put_terms(own, writer);
  transcript.seal_text(terms, handshake.sealed_);
  return handshake;
}

Bytes ClientHandshake::hello() const {
  Bytes datagram;
  ByteWriter writer(datagram);
  write_scene_prefix(SceneDatagramKind::hello, writer);
  writer.put_bytes(as_bytes_of(ephemeral_.public_key));
  return datagram;
}

bool ClientHandshake::accept_cookie(std::span<const std::byte> datagram) {
  auto reader = body(datagram, SceneDatagramKind::cookie, cookie_body);
  if (!reader) return false;
  const auto echo = take_array<16>(*reader);
  if (!std::equal(echo.begin(), echo.end(), ephemeral_.public_key.begin())) return false;
  cookie_ = take_array<16>(*reader);
  return true;
}

Bytes ClientHandshake::initiation() const {
  SEPTET_CHECK(cookie_.has_value(), "initiation without a cookie");
  Bytes datagram;
  ByteWriter writer(datagram);
  write_scene_prefix(SceneDatagramKind::initiation, writer);
  writer.put_bytes(as_bytes_of(*cookie_));
  writer.put_bytes(as_bytes_of(ephemeral_.public_key));
  writer.put_bytes(sealed_);
  return datagram;
}

std::optional<ClientHandshake::Connected> ClientHandshake::accept_response(std::span<const std::byte> datagram) const {
  auto reader = body(datagram, SceneDatagramKind::response, response_body);
  Bytes text;
  const auto transcript = reader ? open_answer(*reader, text) : std::nullopt;
  if (!transcript) return std::nullopt;
  ByteReader fields(text);
  Connected result;
  result.connection = fields.get<std::uint32_t>();
  result.session = take_array<16>(fields);
  result.server = take_terms(fields);
  const KeyPair32 keys = transcript->split();
  result.keys = {.sending = keys.first, .receiving = keys.second};
  return result;
}

std::optional<HandshakeRefusal> ClientHandshake::accept_refusal(std::span<const std::byte> datagram) const {
  auto reader = body(datagram, SceneDatagramKind::refusal, refusal_body);
  Bytes text;
  if (!reader || !open_answer(*reader, text)) return std::nullopt;
  const auto reason = std::to_integer<std::uint8_t>(text.front());
  if (reason < 1 || reason > 2) return std::nullopt;
  return static_cast<HandshakeRefusal>(reason);
}

/// Second half of the key exchange, and the text sealed at its end.
std::optional<Transcript> ClientHandshake::open_answer(ByteReader& reader, Bytes& text) const {
  const auto echo = take_array<16>(reader);
  if (!std::equal(echo.begin(), echo.end(), ephemeral_.public_key.begin())) return std::nullopt;
  const auto server_ephemeral = take_array<32>(reader);
  const auto ephemeral_ephemeral = shared_secret(ephemeral_.secret, server_ephemeral);
  const auto static_ephemeral = shared_secret(static_.secret, server_ephemeral);
  if (!ephemeral_ephemeral || !static_ephemeral) return std::nullopt;

  Transcript transcript = transcript_;
  transcript.mix_hash(as_bytes_of(server_ephemeral));
  transcript.mix_key(*ephemeral_ephemeral);
  transcript.mix_key(*static_ephemeral);
  if (!transcript.open_text(reader.take(reader.remaining()), text)) return std::nullopt;
  return transcript;
}

std::optional<Bytes> CookieJar::answer(std::span<const std::byte> hello, const Address& from, double now_s) const {
  auto reader = body(hello, SceneDatagramKind::hello, hello_body);
  if (!reader) return std::nullopt;
  const auto ephemeral = reader->take(32);
  Bytes datagram;
  ByteWriter writer(datagram);
  write_scene_prefix(SceneDatagramKind::cookie, writer);
  writer.put_bytes(ephemeral.first(16));
  writer.put_bytes(as_bytes_of(cookie(from, ephemeral, static_cast<std::uint64_t>(now_s / cookie_slot_s))));
  return datagram;
}

bool CookieJar::is_good(std::span<const std::byte> initiation, const Address& from, double now_s) const {
  auto reader = body(initiation, SceneDatagramKind::initiation, initiation_body);
  if (!reader) return false;
  const auto given = take_array<16>(*reader);
  const auto ephemeral = reader->take(32);
  const auto slot = static_cast<std::uint64_t>(now_s / cookie_slot_s);
  return equal_in_constant_time(given, cookie(from, ephemeral, slot)) ||
         (slot > 0 && equal_in_constant_time(given, cookie(from, ephemeral, slot - 1)));
}

Hash16 CookieJar::cookie(const Address& from, std::span<const std::byte> ephemeral, std::uint64_t slot) const {
  Bytes place;
  ByteWriter writer(place);
  writer.put(from.ip);
  writer.put(from.port);
  writer.put(slot);
  return hash16({place, ephemeral}, secret_);
}

std::optional<ServerHandshake> ServerHandshake::accept(std::span<const std::byte> initiation, const Identity& server) {
  auto reader = body(initiation, SceneDatagramKind::initiation, initiation_body);
  if (!reader) return std::nullopt;
  reader->take(16);
  ServerHandshake handshake(server.public_key());
  handshake.client_ephemeral_ = take_array<32>(*reader);
  const Key32 own_secret = exchange_keys_of(server).secret;
  const auto ephemeral_static = shared_secret(own_secret, handshake.client_ephemeral_);
  if (!ephemeral_static) return std::nullopt;

  Transcript& transcript = handshake.transcript_;
  transcript.mix_hash(as_bytes_of(handshake.client_ephemeral_));
  transcript.mix_key(*ephemeral_static);
  Bytes text;
  if (!transcript.open_text(reader->take(32 + seal_bytes), text)) return std::nullopt;
  ByteReader identity(text);
  handshake.client_ = take_array<32>(identity);
  const auto client_static = exchange_key_of(handshake.client_);
  if (!client_static) return std::nullopt;
  handshake.client_static_ = *client_static;
  const auto static_static = shared_secret(own_secret, *client_static);
  if (!static_static) return std::nullopt;
  transcript.mix_key(*static_static);
  if (!transcript.open_text(reader->take(terms_bytes + seal_bytes), text)) return std::nullopt;
  ByteReader fields(text);
  handshake.client_terms_ = take_terms(fields);
  return handshake;
}

std::optional<ServerHandshake::Connected> ServerHandshake::respond(std::uint32_t connection, const SessionId& session,
                                                                   const Terms& own) const {
  Bytes text;
  ByteWriter fields(text);
  fields.put(connection);
  fields.put_bytes(as_bytes_of(session));
  put_terms(own, fields);

  Connected result;
  const auto transcript = seal_answer(SceneDatagramKind::response, text, result.response);
  if (!transcript) return std::nullopt;
  const KeyPair32 keys = transcript->split();
  result.keys = {.sending = keys.second, .receiving = keys.first};
  return result;
}

std::optional<Bytes> ServerHandshake::refuse(HandshakeRefusal reason) const {
  const std::byte text[] = {static_cast<std::byte>(reason)};
  Bytes datagram;
  if (!seal_answer(SceneDatagramKind::refusal, text, datagram)) return std::nullopt;
  return datagram;
}

/// The second half of the key exchange as a datagram, with `text` sealed at its end.
std::optional<Transcript> ServerHandshake::seal_answer(SceneDatagramKind kind, std::span<const std::byte> text,
                                                       Bytes& datagram) const {
  const ExchangeKeys ephemeral = random_exchange_keys();
  const auto ephemeral_ephemeral = shared_secret(ephemeral.secret, client_ephemeral_);
  const auto static_ephemeral = shared_secret(ephemeral.secret, client_static_);
  if (!ephemeral_ephemeral || !static_ephemeral) return std::nullopt;
  Transcript transcript = transcript_;
  transcript.mix_hash(as_bytes_of(ephemeral.public_key));
  transcript.mix_key(*ephemeral_ephemeral);
  transcript.mix_key(*static_ephemeral);

  ByteWriter writer(datagram);
  write_scene_prefix(kind, writer);
  writer.put_bytes(as_bytes_of(client_ephemeral_).first(16));
  writer.put_bytes(as_bytes_of(ephemeral.public_key));
  transcript.seal_text(text, datagram);
  return transcript;
}

}  // namespace septet::net
