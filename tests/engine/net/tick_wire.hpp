#pragma once
// The tick lane's end without a network, for tests, the fuzzer and benchmarks: keys from numbers, and a socket that
// keeps the datagrams given to it.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/net/datagram_socket.hpp"
#include "engine/net/keys.hpp"

namespace septet::net {

inline Identity identity_of(std::uint8_t number) { return Identity::from_seed({number}); }

// Keeps a publisher's datagrams.
class Recorder final : public DatagramSocket {
 public:
  bool send(const Address&, std::span<const std::byte> bytes) override {
    datagrams.emplace_back(bytes.begin(), bytes.end());
    return true;
  }
  void flush() override {}
  std::optional<ReceivedDatagram> receive() override { return std::nullopt; }
  std::size_t receive_buffer_bytes() const override { return 0; }
  std::vector<Bytes> datagrams;
};

}  // namespace septet::net
