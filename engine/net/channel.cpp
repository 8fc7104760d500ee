#include "engine/net/channel.hpp"

#include <algorithm>

namespace septet::net {
namespace {

constexpr std::size_t largest_datagram = 65507;
/// Fits every Ethernet, tunnels included; loopback carries 64 KiB in one piece.
constexpr std::size_t lan_datagram = 1200, loopback_datagram = 16384;
constexpr std::size_t max_unreliable_bytes = 256 * 1024;
constexpr std::size_t max_pongs = 8;
/// Upper bound on the window that the other end announces.
constexpr std::size_t max_window_bytes = 64u << 20;
/// Kind and length of an unreliable frame.
constexpr std::size_t unreliable_overhead = 1 + 3;

std::size_t datagram_limit(const Terms& own, const Terms& theirs) {
  return std::min<std::size_t>({own.max_datagram_bytes, theirs.max_datagram_bytes, largest_datagram});
}

ReliableSenderLimits sender_limits(const Channel::Options& options) {
  return {.max_datagram_bytes = datagram_limit(options.own, options.theirs),
          .max_message_bytes = std::min<std::size_t>(options.theirs.max_message_bytes, 0xffffffffu),
          .max_queue_bytes = options.limits.max_queue_bytes,
          .window_bytes = std::min<std::size_t>(options.theirs.window_bytes, max_window_bytes),
          .max_flight_bytes = std::min<std::size_t>(options.theirs.flight_bytes, max_window_bytes)};
}

void write_data_header(std::uint32_t connection, std::uint64_t number, ByteWriter& writer) {
  write_scene_prefix(SceneDatagramKind::data, writer);
  writer.put(connection);
  writer.put(number);
}

}  // namespace

ChannelCounters& ChannelCounters::operator+=(const ChannelCounters& other) {
  datagrams_sent += other.datagrams_sent;
  bytes_sent += other.bytes_sent;
  datagrams_received += other.datagrams_received;
  bytes_received += other.bytes_received;
  resent += other.resent;
  forged += other.forged;
  replayed += other.replayed;
  malformed += other.malformed;
  unknown += other.unknown;
  not_allowed += other.not_allowed;
  bad_cookies += other.bad_cookies;
  return *this;
}

std::optional<std::uint32_t> connection_of(std::span<const std::byte> datagram) {
  if (datagram.size() < data_header_bytes + seal_bytes) return std::nullopt;
  ByteReader reader(datagram.subspan(scene_prefix_bytes));
  return reader.get<std::uint32_t>();
}

Terms terms_of(const ChannelLimits& limits, const DatagramSocket& socket, const Address& peer, std::size_t sharers) {
  const std::size_t automatic = is_loopback(peer) ? loopback_datagram : lan_datagram;
  const std::size_t datagram = limits.max_datagram_bytes == 0 ? automatic : limits.max_datagram_bytes;
  // Linux counts the memory that a datagram occupies, twice its length for one of 1,200 bytes; a third leaves room to
  // spare.
  const std::size_t flight = socket.receive_buffer_bytes() / 3 / std::max<std::size_t>(sharers, 1);
  return {.max_datagram_bytes = static_cast<std::uint32_t>(std::min(datagram, largest_datagram)),
          .max_message_bytes = limits.max_message_bytes,
          .window_bytes = static_cast<std::uint32_t>(std::min<std::size_t>(limits.window_bytes, 1u << 30)),
          .flight_bytes = static_cast<std::uint32_t>(std::clamp<std::size_t>(flight, 16 * 1024, 1u << 30))};
}

bool are_usable(const Terms& terms) {
  return terms.max_datagram_bytes >= 576 && terms.window_bytes >= 16 * 1024 && terms.flight_bytes >= 4096;
}

Channel::Channel(const Options& options, double now_s)
    : options_(options),
      max_text_bytes_(datagram_limit(options.own, options.theirs) - data_header_bytes - seal_bytes),
      sender_(sender_limits(options)),
      receiver_(options.own.max_message_bytes, options.own.window_bytes),
      heard_s_(now_s) {}

Channel::Verdict Channel::accept(const ReceivedDatagram& received, double now_s,
                                 std::vector<ChannelMessage>& messages) {
  const std::span<const std::byte> datagram = received.bytes;
  // A program that drew or computed for a while reads waiting datagrams late: the system's arrival time counts.
  const double arrived_s = std::min(received.arrived_s.value_or(now_s), now_s);
  ByteReader header(datagram.subspan(scene_prefix_bytes));
  header.get<std::uint32_t>();
  const auto number = header.get<std::uint64_t>();
  if (!received_.is_new(number)) {
    ++counters_.replayed;
    return Verdict::refused;
  }
  if (!open(options_.keys.receiving, number, datagram.first(data_header_bytes), datagram.subspan(data_header_bytes),
            text_)) {
    ++counters_.forged;
    return Verdict::refused;
  }
  received_.add(number);
  heard_s_ = now_s;
  ++counters_.datagrams_received;
  counters_.bytes_received += datagram.size();
  ByteReader reader(text_);
  Frame frame;
  while (read_frame(reader, frame))
    if (const Verdict verdict = take(frame, now_s, arrived_s, messages); verdict != Verdict::good) return verdict;
  if (reader.ok()) return Verdict::good;
  ++counters_.malformed;
  return Verdict::broken;
}

Channel::Verdict Channel::take(const Frame& frame, double now_s, double arrived_s,
                               std::vector<ChannelMessage>& messages) {
  bool kept_protocol = true;
  switch (frame.kind) {
    case FrameKind::acknowledge:
      kept_protocol = sender_.acknowledge(frame.received, next_number_, now_s);
      break;
    case FrameKind::fragment:
      acknowledge_due_ = true;
      completed_.clear();
      kept_protocol = receiver_.accept(frame, completed_);
      for (Bytes& bytes : completed_) messages.push_back({Reliability::reliable, std::move(bytes)});
      break;
    case FrameKind::unreliable:
      messages.push_back({Reliability::unreliable, Bytes(frame.bytes.begin(), frame.bytes.end())});
      break;
    case FrameKind::ping:
      if (pongs_.size() < max_pongs)
        pongs_.push_back({.kind = FrameKind::pong, .sent_s = frame.sent_s, .answered_s = arrived_s});
      break;
    case FrameKind::pong:
      clock_.add(frame.sent_s, frame.answered_s, arrived_s);
      break;
    case FrameKind::goodbye:
      goodbye_.assign(reinterpret_cast<const char*>(frame.bytes.data()), frame.bytes.size());
      return Verdict::goodbye;
  }
  if (kept_protocol) return Verdict::good;
  ++counters_.malformed;
  return Verdict::broken;
}

SendResult Channel::send(SharedBytes message, Reliability reliability) {
  if (reliability == Reliability::reliable) return sender_.enqueue(std::move(message));
  if (message->size() + unreliable_overhead > max_text_bytes_) return SendResult::too_large;
  if (unreliable_bytes_ + message->size() > max_unreliable_bytes) return SendResult::queue_full;
  unreliable_bytes_ += message->size() + unreliable_overhead;
  unreliable_.push_back(std::move(message));
  return SendResult::queued;
}

std::size_t Channel::emit(DatagramSocket& socket, double now_s, std::size_t budget_bytes) {
  std::size_t sent = 0;
  while (true) {
    text_.clear();
    ByteWriter writer(text_);
    const auto room = [&] { return max_text_bytes_ - text_.size(); };
    if (acknowledge_due_) write_frame({.kind = FrameKind::acknowledge, .received = received_.ranges()}, writer);
    if (ping_due_) write_frame({.kind = FrameKind::ping, .sent_s = now_s}, writer);
    std::size_t pongs = 0, unreliable = 0;
    for (; pongs < pongs_.size() && room() >= 17; ++pongs) write_frame(pongs_[pongs], writer);
    for (; unreliable < unreliable_.size() && room() >= unreliable_[unreliable]->size() + unreliable_overhead;
         ++unreliable)
      write_frame({.kind = FrameKind::unreliable, .bytes = *unreliable_[unreliable]}, writer);
    std::vector<std::uint64_t> fragments;
    const std::size_t before = text_.size();
    if (sent < budget_bytes && sender_.wants_to_send()) sender_.fill(writer, room(), fragments);
    if (text_.empty()) return sent;

    const std::uint64_t number = next_number_;
    if (!seal_and_send(socket)) {
      // The system accepts no more: the fragments count as sent and lost, the rest stays due.
      if (!fragments.empty()) sender_.packet_sent(number, now_s, text_.size() - before, std::move(fragments));
      return sent;
    }
    sent += datagram_.size();
    acknowledge_due_ = ping_due_ = false;
    pongs_.erase(pongs_.begin(), pongs_.begin() + static_cast<std::ptrdiff_t>(pongs));
    for (; unreliable > 0; --unreliable) {
      unreliable_bytes_ -= unreliable_.front()->size() + unreliable_overhead;
      unreliable_.pop_front();
    }
    if (!fragments.empty()) sender_.packet_sent(number, now_s, datagram_.size(), std::move(fragments));
  }
}

void Channel::say_goodbye(std::string_view reason, DatagramSocket& socket) {
  text_.clear();
  ByteWriter writer(text_);
  const auto bytes = std::as_bytes(std::span(reason.substr(0, max_goodbye_bytes)));
  write_frame({.kind = FrameKind::goodbye, .bytes = bytes}, writer);
  seal_and_send(socket);
}

bool Channel::seal_and_send(DatagramSocket& socket) {
  datagram_.clear();
  ByteWriter writer(datagram_);
  write_data_header(options_.connection, next_number_, writer);
  std::array<std::byte, data_header_bytes> header;
  std::copy_n(datagram_.begin(), data_header_bytes, header.begin());
  seal(options_.keys.sending, next_number_, header, text_, datagram_);
  // The number is used up even if the datagram is not sent: no two plaintexts are ever sealed with one number.
  ++next_number_;
  if (!socket.send(options_.peer, datagram_)) return false;
  ++counters_.datagrams_sent;
  counters_.bytes_sent += datagram_.size();
  return true;
}

ChannelCounters Channel::counters() const {
  ChannelCounters result = counters_;
  result.resent = sender_.resent();
  return result;
}

}  // namespace septet::net
