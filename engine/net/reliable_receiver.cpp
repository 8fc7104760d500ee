#include "engine/net/reliable_receiver.hpp"

#include <algorithm>

namespace septet::net {

bool ReliableReceiver::accept(const Frame& frame, std::vector<Bytes>& completed) {
  if (frame.message < next_) return true;  // Delivered already: a redundant resend.
  if (frame.message - next_ > window_bytes_ / fragment_weight + 1) return false;
  if (frame.message_bytes > max_message_bytes_) return false;

  const auto [entry, is_first] = incoming_.try_emplace(frame.message);
  Incoming& incoming = entry->second;
  if (is_first) {
    if (bytes_held_ + frame.message_bytes > window_bytes_ + 2 * max_message_bytes_) return false;
    bytes_held_ += frame.message_bytes;
    incoming.bytes.resize(frame.message_bytes);
    incoming.missing = frame.message_bytes;
  } else if (incoming.bytes.size() != frame.message_bytes) {
    return false;
  }
  if (!add(incoming, frame.offset, frame.bytes)) return false;

  for (auto first = incoming_.begin(); first != incoming_.end() && first->first == next_ && first->second.missing == 0;
       first = incoming_.erase(first), ++next_) {
    bytes_held_ -= first->second.bytes.size();
    completed.push_back(std::move(first->second.bytes));
  }
  return true;
}

/// Copies a fragment into place; a repeated one is a no-op, an overlapping one an error.
bool ReliableReceiver::add(Incoming& incoming, std::size_t offset, std::span<const std::byte> bytes) {
  if (bytes.empty()) return incoming.bytes.empty();
  const std::size_t end = offset + bytes.size();
  auto after = incoming.runs.upper_bound(offset);
  auto before = after == incoming.runs.begin() ? incoming.runs.end() : std::prev(after);
  if (before != incoming.runs.end() && before->second > offset) return before->second >= end;
  if (after != incoming.runs.end() && after->first < end) return false;

  std::copy(bytes.begin(), bytes.end(), incoming.bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  incoming.missing -= bytes.size();
  if (before == incoming.runs.end() || before->second != offset) before = incoming.runs.emplace(offset, end).first;
  before->second = end;
  if (after != incoming.runs.end() && after->first == end) {
    before->second = after->second;
    incoming.runs.erase(after);
  }
  return true;
}

}  // namespace septet::net
