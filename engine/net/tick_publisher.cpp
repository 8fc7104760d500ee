#include "engine/net/tick_publisher.hpp"

#include <algorithm>

#include "engine/core/check.hpp"
#include "engine/net/tick_datagram.hpp"

namespace septet::net {
namespace {

/// The path of leaf `index` from the leaves' level upwards.
void take_path(const std::vector<std::vector<Hash16>>& tree, TickDatagram& datagram) {
  datagram.path_length = 0;
  std::size_t index = datagram.index;
  for (std::size_t level = 0; level + 1 < tree.size(); ++level, index /= 2)
    if ((index ^ 1) < tree[level].size()) datagram.path[datagram.path_length++] = tree[level][index ^ 1];
}

}  // namespace

TickPublisher::TickPublisher(DatagramSocket& socket, const Identity& server, const SessionId& session,
                             const TickPublisherOptions& options)
    : socket_(socket), server_(server), session_(session), options_(options) {
  SEPTET_CHECK(options.max_datagram_bytes >= smallest_max_datagram_bytes &&
                   options.max_datagram_bytes <= largest_max_datagram_bytes,
               "datagram limit of {} bytes", options.max_datagram_bytes);
}

TickPublisher::TickPublisher(DatagramSocket& socket, const Identity& server, const SessionId& session,
                             const TickPublisherOptions& options, const TickPublisher& numbered_with)
    : TickPublisher(socket, server, session, options) {
  sequence_ = numbered_with.sequence_;
}

void TickPublisher::add_destination(const Address& destination) {
  if (std::find(destinations_.begin(), destinations_.end(), destination) == destinations_.end())
    destinations_.push_back(destination);
}

void TickPublisher::remove_destination(const Address& destination) { std::erase(destinations_, destination); }

void TickPublisher::publish(std::uint64_t tick, std::span<const std::byte> payload) {
  SEPTET_CHECK(payload.size() <= max_tick_bytes, "tick {} of {} bytes", tick, payload.size());
  SEPTET_CHECK(!newest_tick_ || tick > *newest_tick_, "tick {} after {}", tick, *newest_tick_);
  newest_tick_ = tick;

  const std::size_t fragment_bytes = choose_fragment_bytes(payload.size(), options_.max_datagram_bytes);
  std::vector<std::span<const std::byte>> fragments;
  for (std::size_t offset = 0; offset == 0 || offset < payload.size(); offset += fragment_bytes)
    fragments.push_back(payload.subspan(offset, std::min(fragment_bytes, payload.size() - offset)));
  const auto tree = build_tree(fragments);

  TickDatagram datagram;
  datagram.header = {.session = session_,
                     .sequence = ++*sequence_,
                     .tick = tick,
                     .payload_bytes = static_cast<std::uint32_t>(payload.size()),
                     .fragments = static_cast<std::uint16_t>(fragments.size()),
                     .fragment_bytes = static_cast<std::uint16_t>(fragment_bytes),
                     .root = tree.back().front()};
  datagram.signature = sign(signed_text(datagram.header), server_);

  std::swap(newest_, previous_);
  newest_.resize(fragments.size());
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    datagram.index = static_cast<std::uint16_t>(i);
    datagram.fragment = fragments[i];
    take_path(tree, datagram);
    newest_[i].clear();
    write_tick_datagram(datagram, newest_[i]);
  }
  ++counters_.ticks;
  send(newest_, false);
  if (options_.repeat_previous) send(previous_, true);
  socket_.flush();
}

void TickPublisher::repeat_newest() {
  send(newest_, true);
  socket_.flush();
}

void TickPublisher::send(std::vector<Bytes>& datagrams, bool repetition) {
  for (Bytes& datagram : datagrams) {
    datagram[repetition_offset] = static_cast<std::byte>(repetition);
    for (const Address& destination : destinations_) {
      if (!socket_.send(destination, datagram)) {
        ++counters_.refused;
        continue;
      }
      ++counters_.datagrams;
      counters_.bytes += datagram.size();
    }
  }
}

}  // namespace septet::net
