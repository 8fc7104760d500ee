#pragma once
/// The scene lane's handshake (PROTOCOL.md, "Handshake"): a cookie, then a key exchange after Noise's pattern IK.
///
/// Pure functions of datagrams and keys: no socket, no clock. The caller decides when to send and which clients to
/// allow.

#include <cstdint>
#include <optional>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/net/address.hpp"
#include "engine/net/crypto.hpp"
#include "engine/net/keys.hpp"

namespace septet::net {

enum class SceneDatagramKind : std::uint8_t { hello = 1, cookie, initiation, response, data, refusal };

inline constexpr std::size_t scene_prefix_bytes = 3;
/// Kind of a datagram of the scene lane; empty if it does not begin like one.
std::optional<SceneDatagramKind> scene_datagram_kind(std::span<const std::byte> datagram);
/// True if it begins like one, but of another version of the protocol.
bool is_of_other_version(std::span<const std::byte> datagram);
/// Appends the scene lane's three-byte prefix.
void write_scene_prefix(SceneDatagramKind kind, ByteWriter& writer);

/// Limits that an end announces for receiving.
struct Terms {
  std::uint32_t max_datagram_bytes = 0;
  std::uint64_t max_message_bytes = 0;
  std::uint32_t window_bytes = 0;
  std::uint32_t flight_bytes = 0;

  bool operator==(const Terms&) const = default;
};

struct ChannelKeys {
  Key32 sending{}, receiving{};
};

/// Reason for which a server refuses a client whose initiation it could read. Numbers as on the wire.
enum class HandshakeRefusal : std::uint8_t {
  key_unknown = 1,  ///< The client's key is not on the list.
  key_in_use = 2,   ///< Another client with this key is connected and live.
};

/// Chaining key and transcript hash of Noise's symmetric state.
class Transcript {
 public:
  explicit Transcript(const PublicKey& server);
  void mix_hash(std::span<const std::byte> bytes);
  void mix_key(const Key32& shared);
  void seal_text(std::span<const std::byte> text, Bytes& out);
  bool open_text(std::span<const std::byte> sealed, Bytes& out);
  /// Keys from client to server, then from server to client.
  KeyPair32 split() const;

 private:
  Key32 chaining_{}, hash_{}, key_{};
};

class ClientHandshake {
 public:
  /// Empty if the server's key is not a point of the curve.
  static std::optional<ClientHandshake> start(const Identity& client, const PublicKey& server, const Terms& own);

  Bytes hello() const;
  /// False: it does not belong to this hello.
  bool accept_cookie(std::span<const std::byte> datagram);
  bool has_cookie() const { return cookie_.has_value(); }
  /// Requires the cookie.
  Bytes initiation() const;

  struct Connected {
    std::uint32_t connection = 0;
    SessionId session{};
    Terms server;
    ChannelKeys keys;
  };
  /// Empty: not from the pinned server, or not for this handshake.
  std::optional<Connected> accept_response(std::span<const std::byte> datagram) const;
  /// Empty: not from the pinned server, or not for this handshake.
  std::optional<HandshakeRefusal> accept_refusal(std::span<const std::byte> datagram) const;

 private:
  ClientHandshake(const Identity& client, const PublicKey& server);
  std::optional<Transcript> open_answer(ByteReader& reader, Bytes& text) const;
  ExchangeKeys static_, ephemeral_;
  Transcript transcript_;
  Bytes sealed_;  ///< Ciphertext of the initiation: identity and terms.
  std::optional<Hash16> cookie_;
};

/// Makes and checks cookies; keeps no state per client.
class CookieJar {
 public:
  CookieJar() : secret_(random_key()) {}
  /// The reply to a hello; empty if it is not one.
  std::optional<Bytes> answer(std::span<const std::byte> hello, const Address& from, double now_s) const;
  bool is_good(std::span<const std::byte> initiation, const Address& from, double now_s) const;

 private:
  Hash16 cookie(const Address& from, std::span<const std::byte> ephemeral, std::uint64_t slot) const;
  Key32 secret_;
};

/// The server's half, from a read initiation to the response.
class ServerHandshake {
 public:
  /// Empty: malformed, or not sealed for this server. Costs two scalar multiplications.
  static std::optional<ServerHandshake> accept(std::span<const std::byte> initiation, const Identity& server);

  const PublicKey& client() const { return client_; }
  const Terms& client_terms() const { return client_terms_; }
  const Key32& client_ephemeral() const { return client_ephemeral_; }

  struct Connected {
    Bytes response;
    ChannelKeys keys;
  };
  /// Empty if the client's ephemeral key is of low order.
  std::optional<Connected> respond(std::uint32_t connection, const SessionId& session, const Terms& own) const;
  /// A refusal, sealed like a response, so that no third party can turn a client away.
  std::optional<Bytes> refuse(HandshakeRefusal reason) const;

 private:
  std::optional<Transcript> seal_answer(SceneDatagramKind kind, std::span<const std::byte> text, Bytes& datagram) const;
  explicit ServerHandshake(const PublicKey& server) : transcript_(server) {}
  PublicKey client_{};
  Key32 client_static_{}, client_ephemeral_{};
  Terms client_terms_;
  Transcript transcript_;
};

}  // namespace septet::net
