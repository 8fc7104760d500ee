#include "engine/net/tick_receiver.hpp"

#include <algorithm>

#include "engine/net/tick_datagram.hpp"
#include "engine/net/tick_publisher.hpp"

namespace septet::net {
namespace {

constexpr std::size_t max_complete = 16;

}  // namespace

bool TickReceiver::follow(const SessionId& session) {
  if (session_ == session) return false;
  session_ = session;
  first_sequence_.reset();
  newest_sequence_ = 0;
  assemblies_.clear();
  complete_.clear();
  return true;
}

void TickReceiver::accept(std::span<const std::byte> bytes) {
  ++counters_.datagrams;
  TickDatagram datagram;
  switch (read_tick_datagram(bytes, datagram)) {
    case TickDatagramFault::malformed:
      ++counters_.malformed;
      return;
    case TickDatagramFault::oversized:
      ++counters_.oversized;
      return;
    case TickDatagramFault::none:
      break;
  }
  const TickHeader& header = datagram.header;
  if (!session_ || header.session != *session_) {
    ++counters_.other_session;
    return;
  }
  if (header.sequence + window <= newest_sequence_ && header.sequence < newest_sequence_) {
    ++counters_.replayed;
    return;
  }
  Assembly* assembly = find(header.sequence);
  if (assembly && header == assembly->header && assembly->have[datagram.index]) {
    ++counters_.duplicates;
    return;
  }
  const bool authentic =
      assembly ? header == assembly->header && root_of(datagram) == header.root
               : root_of(datagram) == header.root && verify(datagram.signature, signed_text(header), server_);
  if (!authentic) {
    ++counters_.forged;
    return;
  }
  if (!assembly) assembly = &start(header);
  std::copy(datagram.fragment.begin(), datagram.fragment.end(),
            assembly->payload.begin() + std::ptrdiff_t{datagram.index} * header.fragment_bytes);
  assembly->have[datagram.index] = true;
  assembly->repaired = assembly->repaired || datagram.repetition;
  if (--assembly->missing == 0) complete(*assembly);
}

void TickReceiver::receive_from(DatagramSocket& socket) {
  while (const auto datagram = socket.receive()) accept(datagram->bytes);
}

TickReceiver::Assembly* TickReceiver::find(std::uint64_t sequence) {
  for (Assembly& assembly : assemblies_)
    if (assembly.header.sequence == sequence) return &assembly;
  return nullptr;
}

TickReceiver::Assembly& TickReceiver::start(const TickHeader& header) {
  if (!first_sequence_) first_sequence_ = newest_sequence_ = header.sequence;
  if (header.sequence > newest_sequence_) move_window(header.sequence);
  const auto place = std::find_if(assemblies_.begin(), assemblies_.end(),
                                  [&](const Assembly& other) { return other.header.sequence > header.sequence; });
  Assembly& assembly = *assemblies_.emplace(place);
  assembly.header = header;
  assembly.payload.resize(header.payload_bytes);
  assembly.have.resize(header.fragments);
  assembly.missing = header.fragments;
  return assembly;
}

void TickReceiver::move_window(std::uint64_t newest) {
  // Sequences in [begin_before, begin_after) leave the window; those that never came whole are lost.
  const auto begin_of = [&](std::uint64_t last) {
    return std::max(last >= window ? last - window + 1 : 1, *first_sequence_);
  };
  const std::uint64_t begin_before = begin_of(newest_sequence_), begin_after = begin_of(newest);
  std::uint64_t whole = 0;
  while (!assemblies_.empty() && assemblies_.front().header.sequence + window <= newest) {
    const Assembly& leaving = assemblies_.front();
    if (leaving.missing == 0 && leaving.header.sequence >= begin_before) ++whole;
    assemblies_.pop_front();
  }
  counters_.lost += begin_after - begin_before - whole;
  newest_sequence_ = newest;
}

void TickReceiver::complete(Assembly& assembly) {
  ++counters_.ticks;
  if (assembly.repaired) ++counters_.repaired;
  complete_.push_back({assembly.header.tick, std::move(assembly.payload), assembly.repaired});
  if (complete_.size() > max_complete) complete_.pop_front();
}

std::optional<ReceivedTick> TickReceiver::next() {
  if (complete_.empty()) return std::nullopt;
  ReceivedTick tick = std::move(complete_.front());
  complete_.pop_front();
  return tick;
}

std::size_t TickReceiver::bytes_held() const {
  std::size_t bytes = 0;
  for (const Assembly& assembly : assemblies_)
    if (assembly.missing > 0) bytes += assembly.payload.size();
  for (const ReceivedTick& tick : complete_) bytes += tick.payload.size();
  return bytes;
}

}  // namespace septet::net
