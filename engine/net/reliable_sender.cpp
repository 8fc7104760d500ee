#include "engine/net/reliable_sender.hpp"

#include <algorithm>

#include "engine/core/check.hpp"
#include "engine/net/scene_frames.hpp"

namespace septet::net {
namespace {

/// Smallest fragment worth cutting: a packet's last bytes stay empty rather than carry a sliver of a message.
constexpr std::size_t smallest_piece = 64;
constexpr double longest_backoff_s = 0.25;

}  // namespace

ReliableSender::ReliableSender(const ReliableSenderLimits& limits)
    : limits_(limits),
      congestion_window_(std::min(64 * limits.max_datagram_bytes, limits.max_flight_bytes)),
      smallest_window_(congestion_window_) {}

SendResult ReliableSender::enqueue(SharedBytes bytes) {
  if (bytes->size() > limits_.max_message_bytes) return SendResult::too_large;
  if (queued_bytes_ + bytes->size() + fragment_weight > limits_.max_queue_bytes) return SendResult::queue_full;
  queued_bytes_ += bytes->size() + fragment_weight;
  messages_.push_back({.bytes = std::move(bytes)});
  return SendResult::queued;
}

bool ReliableSender::has_new() const {
  if (next_cut_ == first_message_ + messages_.size()) return false;
  const std::uint64_t base = fragments_.empty() ? position_ : fragments_.front().position;
  return position_ - base < limits_.window_bytes;
}

bool ReliableSender::wants_to_send() const {
  return (!lost_.empty() || has_new()) && flight_bytes_ < congestion_window_;
}

void ReliableSender::fill(ByteWriter& writer, std::size_t room, std::vector<std::uint64_t>& fragments) {
  while (!lost_.empty()) {
    const std::uint64_t id = lost_.front();
    const bool stale = id < first_fragment_ || fragment(id).done;
    if (!stale && !write_fragment(id, writer, room)) return;
    lost_.pop_front();
    if (stale) continue;
    ++resent_;
    fragment(id).lost = false;
    fragments.push_back(id);
  }
  while (has_new() && cut_fragment(room)) {
    const std::uint64_t id = first_fragment_ + fragments_.size() - 1;
    const bool written = write_fragment(id, writer, room);
    SEPTET_CHECK(written, "fragment of {} bytes in {}", fragments_.back().length, room);
    fragments.push_back(id);
  }
}

/// Cuts the next fragment of the queue if a worthwhile one fits into `room`.
bool ReliableSender::cut_fragment(std::size_t room) {
  Message& source = message(next_cut_);
  const std::size_t rest = source.bytes->size() - source.cut;
  const std::size_t overhead =
      fragment_overhead(next_cut_, source.bytes->size(), source.cut, limits_.max_datagram_bytes);
  if (room < overhead + std::min(rest, smallest_piece)) return false;
  const std::size_t length = std::min(rest, room - overhead);
  fragments_.push_back({.message = next_cut_, .offset = source.cut, .length = length, .position = position_});
  position_ += length + fragment_weight;
  source.cut += length;
  ++source.open;
  if (source.cut == source.bytes->size()) ++next_cut_;
  return true;
}

bool ReliableSender::write_fragment(std::uint64_t id, ByteWriter& writer, std::size_t& room) {
  const Fragment& piece = fragment(id);
  const Bytes& source = *message(piece.message).bytes;
  const std::size_t bytes = piece.length + fragment_overhead(piece.message, source.size(), piece.offset, piece.length);
  if (bytes > room) return false;
  write_frame({.kind = FrameKind::fragment,
               .message = piece.message,
               .message_bytes = source.size(),
               .offset = piece.offset,
               .bytes = std::span(source).subspan(piece.offset, piece.length)},
              writer);
  room -= bytes;
  return true;
}

void ReliableSender::packet_sent(std::uint64_t number, double now_s, std::size_t bytes,
                                 std::vector<std::uint64_t> fragments) {
  if (flight_bytes_ == 0) progress_s_ = now_s;
  flight_bytes_ += bytes;
  if (flight_bytes_ >= congestion_window_) was_full_ = true;
  packets_.push_back({number, now_s, bytes, true, std::move(fragments)});
}

bool ReliableSender::acknowledge(const PacketRanges& received, std::uint64_t next_number, double now_s) {
  const std::uint64_t newest = received.ranges[0].last;
  if (newest >= next_number) return false;
  const Packet* latest = nullptr;
  for (std::size_t i = 0; i < received.count; ++i) {
    const auto& range = received.ranges[i];
    auto packet = std::lower_bound(packets_.begin(), packets_.end(), range.first,
                                   [](const Packet& p, std::uint64_t number) { return p.number < number; });
    for (; packet != packets_.end() && packet->number <= range.last; ++packet) {
      if (!packet->open) continue;
      packet->open = false;
      flight_bytes_ -= packet->bytes;
      round_acknowledged_ += packet->bytes;
      for (const std::uint64_t id : packet->fragments) finish(id);
      if (!latest || packet->number > latest->number) latest = &*packet;
    }
  }
  newest_acknowledged_ = any_acknowledged_ ? std::max(newest_acknowledged_, newest) : newest;
  any_acknowledged_ = true;
  if (latest) {
    round_trip_.add(now_s - latest->sent_s);
    progress_s_ = now_s;
    backoff_ = 1.0;
  }
  if (newest >= round_end_) end_round(next_number);
  find_losses(now_s);
  trim();
  return true;
}

void ReliableSender::finish(std::uint64_t fragment_id) {
  if (fragment_id < first_fragment_ || fragment(fragment_id).done) return;
  fragment(fragment_id).done = true;
  --message(fragment(fragment_id).message).open;
}

void ReliableSender::lose(Packet& packet) {
  packet.open = false;
  flight_bytes_ -= packet.bytes;
  round_lost_ += packet.bytes;
  for (const std::uint64_t id : packet.fragments) {
    if (id < first_fragment_ || fragment(id).done || fragment(id).lost) continue;
    fragment(id).lost = true;
    lost_.push_back(id);
  }
}

void ReliableSender::find_losses(double now_s) {
  if (!any_acknowledged_) return;
  const double sent_by_s = now_s - round_trip_.reordering_s();
  for (Packet& packet : packets_) {
    if (packet.number >= newest_acknowledged_) break;
    if (packet.open && packet.sent_s <= sent_by_s) lose(packet);
  }
}

void ReliableSender::advance_to(double now_s) {
  find_losses(now_s);
  if (flight_bytes_ > 0) {
    const double patience_s =
        std::min(round_trip_.resend_s() * backoff_, std::max(longest_backoff_s, round_trip_.resend_s()));
    if (now_s - progress_s_ >= patience_s) {
      for (Packet& packet : packets_)
        if (packet.open) lose(packet);
      progress_s_ = now_s;
      backoff_ *= 2.0;
      congestion_window_ = smallest_window_;
    }
  }
  trim();
}

/// Once per round trip: double the window that was used, or cut it when too much was lost to be mere noise.
void ReliableSender::end_round(std::uint64_t next_number) {
  round_end_ = next_number;
  if (round_lost_ * 10 > round_acknowledged_ + round_lost_)
    congestion_window_ = std::max(congestion_window_ / 3 * 2, smallest_window_);
  else if (was_full_)
    congestion_window_ = std::min(congestion_window_ * 2, limits_.max_flight_bytes);
  round_acknowledged_ = round_lost_ = 0;
  was_full_ = false;
}

void ReliableSender::trim() {
  while (!packets_.empty() && !packets_.front().open) packets_.pop_front();
  while (!fragments_.empty() && fragments_.front().done) {
    fragments_.pop_front();
    ++first_fragment_;
  }
  while (!messages_.empty() && first_message_ < next_cut_ && messages_.front().open == 0) {
    queued_bytes_ -= messages_.front().bytes->size() + fragment_weight;
    messages_.pop_front();
    ++first_message_;
  }
}

}  // namespace septet::net
