#pragma once
/// Identities: one Ed25519 key pair per server and per client, kept in a file that only its owner can read.
///
/// A client pins the server's public key; the server has a list of the clients that it allows. The same pair signs
/// ticks and, mapped to X25519, proves the identity in the scene lane's key exchange. Secrets are wiped on destruction.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/net/rights.hpp"

namespace septet::net {

using PublicKey = std::array<std::uint8_t, 32>;
/// Random number of a server start; signed into every tick, and sent to clients over the scene lane.
using SessionId = std::array<std::uint8_t, 16>;

/// The 64 bytes of a secret key in memory of their own: excluded from core files, not swapped out where the system
/// allows that, between guard pages, and overwritten on destruction.
class SecretKey {
 public:
  using Bytes = std::array<std::uint8_t, 64>;
  SecretKey();
  SecretKey(const SecretKey& other);
  SecretKey& operator=(const SecretKey& other);
  ~SecretKey();
  Bytes& bytes() { return *bytes_; }
  const Bytes& bytes() const { return *bytes_; }

 private:
  Bytes* bytes_;
};

class Identity {
 public:
  /// A fresh pair from the system's random source.
  static Identity generate();
  static Identity from_seed(const std::array<std::uint8_t, 32>& seed);

  const PublicKey& public_key() const { return public_key_; }
  /// Ed25519 secret key as libsodium keeps it (seed, then public key).
  const std::array<std::uint8_t, 64>& secret_key() const { return secret_key_.bytes(); }

 private:
  Identity() = default;
  PublicKey public_key_{};
  SecretKey secret_key_;
};

SessionId random_session_id();

/// Text of 64 hexadecimal digits.
std::string to_text(const PublicKey& key);
Expected<PublicKey> parse_public_key(std::string_view text, std::string_view where);

/// Reads the file; creates it (mode 0600, its folder too) with a fresh identity if it does not exist. Error: a file
/// that other users can read.
Expected<Identity> load_or_create_identity(const std::filesystem::path& file);
Expected<Identity> load_identity(const std::filesystem::path& file);

/// The first word of a file that holds a public key (server.public).
Expected<PublicKey> load_public_key(const std::filesystem::path& file);

struct AllowedClient {
  PublicKey key{};
  std::string name;  ///< Name of the screen in the rig, or "car"; it is also the only role allowed to this key.
  Rights rights{};
};

/// Reads lines `KEY NAME [RIGHTS]`; blank lines and lines that begin with # are skipped. Error: a key or name that stands
/// twice, a word that is no right.
Expected<std::vector<AllowedClient>> load_allowed_clients(const std::filesystem::path& file);

}  // namespace septet::net
