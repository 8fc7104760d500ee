#include "engine/net/crypto.hpp"

#include <sodium.h>

#include <algorithm>

#include "engine/core/check.hpp"

namespace septet::net {
namespace {

void start_sodium() {
  static const int started = sodium_init();
  SEPTET_CHECK(started >= 0, "sodium_init answers {}", started);
}

const unsigned char* raw(std::span<const std::byte> bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

template <std::size_t N>
std::array<std::uint8_t, N> hash(std::initializer_list<std::span<const std::byte>> parts,
                                 std::span<const std::uint8_t> key) {
  crypto_generichash_state state;
  crypto_generichash_init(&state, key.empty() ? nullptr : key.data(), key.size(), N);
  for (const auto part : parts) crypto_generichash_update(&state, raw(part), part.size());
  std::array<std::uint8_t, N> result;
  crypto_generichash_final(&state, result.data(), N);
  return result;
}

std::array<unsigned char, 12> nonce_of(std::uint64_t number) {
  std::array<unsigned char, 12> nonce{};
  for (int i = 0; i < 8; ++i) nonce[4 + i] = static_cast<unsigned char>(number >> (8 * i));
  return nonce;
}

}  // namespace

Identity Identity::generate() { return from_seed(random_key()); }

Identity Identity::from_seed(const std::array<std::uint8_t, 32>& seed) {
  start_sodium();
  Identity identity;
  crypto_sign_seed_keypair(identity.public_key_.data(), identity.secret_key_.bytes().data(), seed.data());
  return identity;
}

SecretKey::SecretKey() {
  start_sodium();
  bytes_ = static_cast<Bytes*>(sodium_malloc(sizeof(Bytes)));
  SEPTET_CHECK(bytes_, "no memory for a key of {} bytes", sizeof(Bytes));
  bytes_->fill(0);
}
SecretKey::SecretKey(const SecretKey& other) : SecretKey() { *bytes_ = *other.bytes_; }
SecretKey& SecretKey::operator=(const SecretKey& other) {
  if (this != &other) *bytes_ = *other.bytes_;
  return *this;
}
SecretKey::~SecretKey() { sodium_free(bytes_); }

SessionId random_session_id() {
  start_sodium();
  SessionId session;
  randombytes_buf(session.data(), session.size());
  return session;
}

Key32 random_key() {
  start_sodium();
  Key32 key;
  randombytes_buf(key.data(), key.size());
  return key;
}

Hash16 hash16(std::initializer_list<std::span<const std::byte>> parts, std::span<const std::uint8_t> key) {
  return hash<16>(parts, key);
}

Key32 hash32(std::initializer_list<std::span<const std::byte>> parts) { return hash<32>(parts, {}); }

KeyPair32 derive_keys(const Key32& key, std::span<const std::byte> input) {
  auto both = hash<64>({input}, key);
  KeyPair32 result;
  std::copy_n(both.begin(), 32, result.first.begin());
  std::copy_n(both.begin() + 32, 32, result.second.begin());
  sodium_memzero(both.data(), both.size());
  return result;
}

Signature sign(std::span<const std::byte> message, const Identity& identity) {
  Signature signature;
  crypto_sign_detached(signature.data(), nullptr, raw(message), message.size(), identity.secret_key().data());
  return signature;
}

bool verify(const Signature& signature, std::span<const std::byte> message, const PublicKey& key) {
  start_sodium();
  return crypto_sign_verify_detached(signature.data(), raw(message), message.size(), key.data()) == 0;
}

void seal(const Key32& key, std::uint64_t number, std::span<const std::byte> associated,
          std::span<const std::byte> text, Bytes& out) {
  const std::size_t begin = out.size();
  out.resize(begin + text.size() + seal_bytes);
  crypto_aead_chacha20poly1305_ietf_encrypt(reinterpret_cast<unsigned char*>(out.data() + begin), nullptr, raw(text),
                                            text.size(), raw(associated), associated.size(), nullptr,
                                            nonce_of(number).data(), key.data());
}

bool open(const Key32& key, std::uint64_t number, std::span<const std::byte> associated,
          std::span<const std::byte> sealed, Bytes& out) {
  if (sealed.size() < seal_bytes) return false;
  out.resize(sealed.size() - seal_bytes);
  return crypto_aead_chacha20poly1305_ietf_decrypt(reinterpret_cast<unsigned char*>(out.data()), nullptr, nullptr,
                                                   raw(sealed), sealed.size(), raw(associated), associated.size(),
                                                   nonce_of(number).data(), key.data()) == 0;
}

ExchangeKeys random_exchange_keys() {
  ExchangeKeys keys{.secret = random_key()};
  crypto_scalarmult_base(keys.public_key.data(), keys.secret.data());
  return keys;
}

ExchangeKeys exchange_keys_of(const Identity& identity) {
  ExchangeKeys keys;
  crypto_sign_ed25519_sk_to_curve25519(keys.secret.data(), identity.secret_key().data());
  crypto_scalarmult_base(keys.public_key.data(), keys.secret.data());
  return keys;
}

std::optional<Key32> exchange_key_of(const PublicKey& key) {
  start_sodium();
  Key32 result;
  if (crypto_sign_ed25519_pk_to_curve25519(result.data(), key.data()) != 0) return std::nullopt;
  return result;
}

std::optional<Key32> shared_secret(const Key32& own_secret, const Key32& their_public_key) {
  Key32 result;
  if (crypto_scalarmult(result.data(), own_secret.data(), their_public_key.data()) != 0) return std::nullopt;
  return result;
}

bool equal_in_constant_time(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace septet::net
