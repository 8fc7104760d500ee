#include <doctest/doctest.h>

#include "engine/net/received_packets.hpp"
#include "engine/net/reliable_receiver.hpp"
#include "engine/net/scene_frames.hpp"
#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

Frame fragment(std::uint64_t message, std::size_t total, std::size_t offset, const Bytes& bytes) {
  return {.kind = FrameKind::fragment, .message = message, .message_bytes = total, .offset = offset, .bytes = bytes};
}

TEST_CASE("fragments in any order make the message and later messages wait for earlier ones") {
  ReliableReceiver receiver(1000, 1000);
  std::vector<Bytes> completed;
  const Bytes a = bytes_of("abc"), b = bytes_of("def"), c = bytes_of("gh");
  CHECK(receiver.accept(fragment(1, 3, 0, a), completed));
  CHECK(receiver.accept(fragment(0, 8, 6, c), completed));
  CHECK(receiver.accept(fragment(0, 8, 0, a), completed));
  CHECK(receiver.accept(fragment(0, 8, 0, a), completed));
  CHECK(completed.empty());
  CHECK(receiver.accept(fragment(0, 8, 3, b), completed));
  REQUIRE(completed.size() == 2);
  CHECK(text_of(completed[0]) == "abcdefgh");
  CHECK(text_of(completed[1]) == "abc");
  CHECK(receiver.bytes_held() == 0);
  CHECK(receiver.accept(fragment(0, 8, 3, b), completed));
  CHECK(completed.size() == 2);
}

TEST_CASE("overlaps contradictions and excess are refused") {
  const Bytes a = bytes_of("abc");
  const auto second_is_refused = [&](const Frame& first, const Frame& second) {
    ReliableReceiver receiver(1000, 1000);
    std::vector<Bytes> completed;
    return receiver.accept(first, completed) && !receiver.accept(second, completed);
  };
  CHECK(second_is_refused(fragment(0, 9, 2, a), fragment(0, 9, 0, a)));
  CHECK(second_is_refused(fragment(0, 9, 2, a), fragment(0, 9, 4, a)));
  CHECK(second_is_refused(fragment(0, 9, 2, a), fragment(0, 8, 5, a)));
  CHECK(second_is_refused(fragment(0, 9, 2, a), fragment(1, 1001, 0, a)));
  CHECK(second_is_refused(fragment(0, 9, 2, a), fragment(100, 3, 0, a)));
  CHECK(second_is_refused(fragment(0, 9, 2, a), fragment(0, 9, 0, {})));
}

TEST_CASE("as many messages may be under way as a window holds of the smallest and no more") {
  const Bytes a = bytes_of("abc");
  for (const std::uint64_t ahead : {1000u / 32 + 1, 1000u / 32 + 2}) {
    ReliableReceiver receiver(1000, 1000);
    std::vector<Bytes> completed;
    CHECK(receiver.accept(fragment(ahead, 3, 0, a), completed) == (ahead == 1000 / 32 + 1));
  }
  ReliableReceiver receiver(1000, 1000);
  std::vector<Bytes> completed;
  CHECK(receiver.accept(fragment(0, 1000, 0, a), completed));
  CHECK(receiver.bytes_held() == 1000);
  CHECK_FALSE(ReliableReceiver(1000, 1000).accept(fragment(0, 1001, 0, a), completed));
}

TEST_CASE("what an authenticated client can make a receiver hold is bounded") {
  ReliableReceiver receiver(1000, 3200);
  std::vector<Bytes> completed;
  const Bytes a = bytes_of("abc");
  std::uint64_t message = 1;
  while (receiver.accept(fragment(message, 1000, 0, a), completed)) ++message;
  CHECK(receiver.bytes_held() <= 3200 + 2 * 1000);
  CHECK(message > 1);
}

TEST_CASE("every frame reads back as it was written and a cut one is refused") {
  const Bytes payload = random_bytes(300, 1);
  PacketRanges ranges;
  ranges.count = 3;
  ranges.ranges[0] = {1000, 900};
  ranges.ranges[1] = {890, 890};
  ranges.ranges[2] = {5, 0};
  const std::vector<Frame> frames = {{.kind = FrameKind::acknowledge, .received = ranges},
                                     fragment(12, 5000, 700, payload),
                                     {.kind = FrameKind::unreliable, .bytes = payload},
                                     {.kind = FrameKind::ping, .sent_s = 1.5},
                                     {.kind = FrameKind::pong, .sent_s = 1.5, .answered_s = 2.5},
                                     {.kind = FrameKind::goodbye, .bytes = std::span(payload).first(100)}};
  for (const Frame& frame : frames) {
    Bytes bytes;
    ByteWriter writer(bytes);
    write_frame(frame, writer);
    ByteReader reader(bytes);
    Frame read;
    REQUIRE(read_frame(reader, read));
    CHECK(reader.at_end());
    Bytes again;
    ByteWriter rewriter(again);
    write_frame(read, rewriter);
    CHECK(again == bytes);
    for (std::size_t size = 1; size < bytes.size(); ++size) {
      ByteReader cut{std::span<const std::byte>(bytes).first(size)};
      CHECK_FALSE(read_frame(cut, read));
    }
  }
}

TEST_CASE("a packet number is new once and the window moves on") {
  ReceivedPackets packets;
  CHECK(packets.is_new(5));
  packets.add(5);
  CHECK_FALSE(packets.is_new(5));
  packets.add(5 + ReceivedPackets::window - 1);
  CHECK_FALSE(packets.is_new(5));
  CHECK(packets.is_new(6));
  packets.add(5 + ReceivedPackets::window);
  CHECK_FALSE(packets.is_new(5));
  CHECK(packets.is_new(6));
  packets.add(1'000'000'000);
  CHECK_FALSE(packets.is_new(6));
  CHECK(packets.is_new(999'999'999));
}

TEST_CASE("acknowledged ranges are exactly the packets received") {
  Random random(3);
  ReceivedPackets packets;
  std::vector<bool> sent(3000);
  for (std::uint64_t number = 0; number < sent.size(); ++number) {
    sent[number] = random.uniform() < 0.99;
    if (sent[number]) packets.add(number);
  }
  const PacketRanges ranges = packets.ranges();
  std::uint64_t checked = sent.size();
  for (std::size_t i = 0; i < ranges.count; ++i) {
    const auto& range = ranges.ranges[i];
    for (; checked > range.last + 1; --checked) CHECK_FALSE(sent[checked - 1]);
    for (; checked > range.first; --checked) CHECK(sent[checked - 1]);
  }
  CHECK(ranges.count > 10);
}

TEST_CASE("an unbroken run of packets is one range of nearly the whole window") {
  ReceivedPackets packets;
  for (std::uint64_t number = 0; number < 20000; ++number) packets.add(number);
  const PacketRanges ranges = packets.ranges();
  CHECK(ranges.count == 1);
  CHECK(ranges.ranges[0].last == 19999);
  CHECK(ranges.ranges[0].first == 20000 - (ReceivedPackets::window - 64));
}

}  // namespace
}  // namespace septet::net
