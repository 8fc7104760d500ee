#pragma once
// Shared by the tests of the tick lane: datagrams as a publisher makes them, and a receiver that follows a session.

#include <vector>

#include "engine/net/tick_publisher.hpp"
#include "engine/net/tick_receiver.hpp"
#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {

inline const Address group{0xef070707, 4750};

inline std::vector<Bytes> datagrams_of(std::uint64_t tick, const Bytes& payload,
                                       const TickPublisherOptions& options = {}, std::uint8_t key = 1,
                                       std::uint8_t session = 1) {
  Recorder recorder;
  TickPublisher publisher(recorder, identity_of(key), session_of(session), options);
  publisher.add_destination(group);
  publisher.publish(tick, payload);
  return recorder.datagrams;
}

inline TickReceiver following(std::uint8_t session = 1) {
  TickReceiver receiver(identity_of(1).public_key());
  receiver.follow(session_of(session));
  return receiver;
}

}  // namespace septet::net
