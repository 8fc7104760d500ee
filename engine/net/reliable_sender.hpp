#pragma once
/// The sending half of a reliable lane: queue, fragments, acknowledgement, resend, congestion.
///
/// Independent of keys and sockets: a channel asks it to fill packets and reports their fate.

#include <cstdint>
#include <deque>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/net/received_packets.hpp"
#include "engine/net/round_trip.hpp"
#include "engine/net/secure_channel.hpp"

namespace septet::net {

struct ReliableSenderLimits {
  std::size_t max_datagram_bytes = 1200;
  std::size_t max_message_bytes = 0;  ///< The other end's limit.
  std::size_t max_queue_bytes = 0;
  std::size_t window_bytes = 0;      ///< The other end's out-of-order window.
  std::size_t max_flight_bytes = 0;  ///< The other end's receive buffer.
};

class ReliableSender {
 public:
  explicit ReliableSender(const ReliableSenderLimits& limits);

  SendResult enqueue(SharedBytes message);

  /// True if there is something to send now.
  bool wants_to_send() const;
  /// Writes frames into at most `room` bytes and appends the fragments' numbers to `fragments`; writes nothing if none
  /// fits.
  void fill(ByteWriter& writer, std::size_t room, std::vector<std::uint64_t>& fragments);
  /// Records that the packet with these fragments was sent.
  void packet_sent(std::uint64_t number, double now_s, std::size_t bytes, std::vector<std::uint64_t> fragments);
  /// False: it acknowledges a packet that was never sent.
  bool acknowledge(const PacketRanges& received, std::uint64_t next_number, double now_s);
  /// Finds packets that count as lost by now.
  void advance_to(double now_s);

  const RoundTrip& round_trip() const { return round_trip_; }
  std::size_t queued_bytes() const { return queued_bytes_; }
  std::uint64_t resent() const { return resent_; }

 private:
  struct Message {
    SharedBytes bytes;
    std::size_t cut = 0;   ///< Bytes already cut into fragments.
    std::size_t open = 0;  ///< Fragments not yet acknowledged.
  };
  struct Fragment {
    std::uint64_t message = 0;
    std::size_t offset = 0, length = 0;
    std::uint64_t position = 0;  ///< Position in the stream of all first sendings.
    bool lost = false, done = false;
  };
  struct Packet {
    std::uint64_t number = 0;
    double sent_s = 0.0;
    std::size_t bytes = 0;
    bool open = true;  ///< Neither acknowledged nor counted as lost.
    std::vector<std::uint64_t> fragments;
  };
  Message& message(std::uint64_t id) { return messages_[id - first_message_]; }
  Fragment& fragment(std::uint64_t id) { return fragments_[id - first_fragment_]; }
  bool has_new() const;
  bool cut_fragment(std::size_t room);
  bool write_fragment(std::uint64_t id, ByteWriter& writer, std::size_t& room);
  void finish(std::uint64_t fragment_id);
  void lose(Packet& packet);
  void find_losses(double now_s);
  void end_round(std::uint64_t next_number);
  void trim();

  ReliableSenderLimits limits_;
  std::deque<Message> messages_;
  std::uint64_t first_message_ = 0;
  std::uint64_t next_cut_ = 0;  ///< First message not wholly cut.
  std::deque<Fragment> fragments_;
  std::uint64_t first_fragment_ = 0;
  std::uint64_t position_ = 0;
  std::deque<std::uint64_t> lost_;
  std::size_t queued_bytes_ = 0;

  std::deque<Packet> packets_;
  std::size_t flight_bytes_ = 0;
  std::uint64_t newest_acknowledged_ = 0;
  bool any_acknowledged_ = false;
  double progress_s_ = 0.0;  ///< Time of the last send into an empty flight, acknowledgement or loss.
  double backoff_ = 1.0;
  RoundTrip round_trip_;

  std::size_t congestion_window_;
  std::size_t smallest_window_;
  bool was_full_ = false;  ///< True if the window has limited sending in this round.
  std::uint64_t round_end_ = 0;
  std::size_t round_acknowledged_ = 0, round_lost_ = 0;
  std::uint64_t resent_ = 0;
};

}  // namespace septet::net
