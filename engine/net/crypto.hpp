#pragma once
/// The cryptographic functions that the protocols use, over libsodium, without its headers.

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/net/keys.hpp"

namespace septet::net {

using Hash16 = std::array<std::uint8_t, 16>;
using Key32 = std::array<std::uint8_t, 32>;
using Signature = std::array<std::uint8_t, 64>;
inline constexpr std::size_t seal_bytes = 16;

/// Views any array of bytes as a span of std::byte.
template <std::size_t N>
std::span<const std::byte> as_bytes_of(const std::array<std::uint8_t, N>& array) {
  return std::as_bytes(std::span(array));
}

/// BLAKE2b, 128 bits, over the concatenated parts; keyed if `key` is not empty.
Hash16 hash16(std::initializer_list<std::span<const std::byte>> parts, std::span<const std::uint8_t> key = {});
/// BLAKE2b, 256 bits.
Key32 hash32(std::initializer_list<std::span<const std::byte>> parts);
/// Two keys derived from one key and an input: the halves of BLAKE2b-512.
struct KeyPair32 {
  Key32 first{}, second{};
};
KeyPair32 derive_keys(const Key32& key, std::span<const std::byte> input);

Signature sign(std::span<const std::byte> message, const Identity& identity);
bool verify(const Signature& signature, std::span<const std::byte> message, const PublicKey& key);

/// ChaCha20-Poly1305 (RFC 8439), nonce = 4 zero bytes and `number`. Appends text and tag to `out`.
void seal(const Key32& key, std::uint64_t number, std::span<const std::byte> associated,
          std::span<const std::byte> text, Bytes& out);
/// Opens into `out` (replaced); false if authentication fails.
bool open(const Key32& key, std::uint64_t number, std::span<const std::byte> associated,
          std::span<const std::byte> sealed, Bytes& out);

/// X25519.
struct ExchangeKeys {
  Key32 secret{}, public_key{};
};
ExchangeKeys random_exchange_keys();
ExchangeKeys exchange_keys_of(const Identity& identity);
/// Empty for bytes that are not a point of the curve.
std::optional<Key32> exchange_key_of(const PublicKey& key);
/// Empty for a point of low order.
std::optional<Key32> shared_secret(const Key32& own_secret, const Key32& their_public_key);

Key32 random_key();
bool equal_in_constant_time(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

}  // namespace septet::net
