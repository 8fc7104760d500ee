#include "engine/control/control_message.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

namespace septet::control {
namespace {

/// Bytes as pairs of hexadecimal digits; blanks part the fields.
Bytes bytes_of(const std::string& text) {
  Bytes bytes;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ') {
      ++i;
      continue;
    }
    bytes.push_back(static_cast<std::byte>(std::stoi(text.substr(i, 2), nullptr, 16)));
    i += 2;
  }
  return bytes;
}

bool is_refused(const Bytes& bytes) { return !decode_control(bytes).has_value(); }

const DriverInput all_touched{
    -2.0, 0.25, 0.5, 0.75, GearSelector::manual,      3, IndicatorStalk::left, true, true, false,
    true, true, 0.5, 200,  {{0.25, -0.5, 0.125}, 0.5}};
const std::string input_bytes =
    "00000000000000c0 000000000000d03f 000000000000e03f 000000000000e83f 04 03 01 01 01 00 01 01 000000000000e03f c8 "
    "000000000000d03f 000000000000e0bf 000000000000c03f 000000000000e03f";

/// Every message with the bytes that CONTROL.md demands.
std::vector<std::pair<ControlMessage, std::string>> written_messages() {
  return {
      {Hello{"left", 0x1234, 7}, "01 00 04 6c656674 3412 0700"},
      {Welcome{"rig", true, 120.0, 8, 0x0a0b0c0d, 0x4321, 0x7f000001, true, 0x0102, "who"},
       "01 01 03 726967 01 0000000000005e40 08000000 0d0c0b0a 2143 0100007f 01 02010000 03 77686f"},
      {Refusal{"no"}, "01 02 02 6e6f"},
      {TickArrived{0x0102, 1.5f, true}, "01 03 0201000000000000 0000c03f 01"},
      {SceneArrived{9}, "01 04 0900000000000000"},
      {Presented{5, 0.25f}, "01 05 0500000000000000 0000803e"},
      {Controls{all_touched}, "01 06 " + input_bytes},
      {Finish{"end"}, "01 07 03 656e64"},
      {ScreenReport{1, 2, 3, 4, 5, 0.25f, 0.5f, 1.5f, 2.0f},
       "01 08 0100000000000000 0200000000000000 0300000000000000 0400000000000000 0500000000000000 "
       "0000803e 0000003f 0000c03f 00000040"},
      {CarHello{3}, "01 09 0300"},
      {CarWelcome{"rig"}, "01 0a 03 726967"},
      {CarReport{6, "ab", "gone"}, "01 0b 06000000 02 6162 04 676f6e65"},
      {CarFeedback{4, 0.25f, 0.5f, 2.0f, -1.0f}, "01 0c 0400000000000000 0000803e 0000003f 00000040 000080bf"},
      {Quit{Quit::How::escape}, "01 0d 01"},
      {Notice{"go", true, false}, "01 0e 02 676f 01 00"},
      {Pause{true}, "01 0f 01"},
      {Thumbnail{3, std::string("\0\xff", 2)}, "01 10 0300000000000000 02 00ff"},
      {Look{true}, "01 11 01"},
      {LargePicture{3, std::string("\0\xff", 2)}, "01 12 0300000000000000 02 00ff"},
      {OperatorLine{2, "mark"}, "01 13 02000000 04 6d61726b"},
      {OperatorAnswer{2, 7, "no"}, "01 14 02000000 0700000000000000 02 6e6f"},
      {HearEvents{}, "01 15"},
      {EventsFrom{9}, "01 16 0900000000000000"},
      {DriveEvent{3, 5, 0.25, "mark", true, 2, "a=b"},
       "01 17 0300000000000000 0500000000000000 000000000000d03f 04 6d61726b 01 02000000 03 613d62"},
  };
}

}  // namespace

TEST_CASE("every control message has the bytes that its format says and is read as it was written") {
  const auto messages = written_messages();
  REQUIRE(messages.size() == std::variant_size_v<ControlMessage>);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    CAPTURE(i);
    const Bytes expected = bytes_of(messages[i].second);
    CHECK(encode_control(messages[i].first) == expected);
    const auto read = decode_control(expected);
    REQUIRE(read.has_value());
    CHECK(read->index() == i);
    CHECK(encode_control(*read) == expected);
  }
}

TEST_CASE("a control message that is cut short or followed by more is refused") {
  for (const auto& message : written_messages()) {
    CAPTURE(message.second);
    Bytes bytes = bytes_of(message.second);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      CHECK(is_refused(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length))));
    bytes.push_back(std::byte{0});
    CHECK(is_refused(bytes));
  }
  CHECK(is_refused(bytes_of("00 05 0500000000000000 0000803e")));  // A scene message.
  CHECK(is_refused(bytes_of("01 10 00")));                         // A kind that there is not.
  CHECK(is_refused(bytes_of("01 0d 03")));                         // A flag is 0 or 1.
}

TEST_CASE("texts are read up to their limits and written no longer than that") {
  const auto text_of = [](const ControlMessage& message) { return std::get<Refusal>(message).reason; };
  CHECK(text_of(*decode_control(encode_control(Refusal{std::string(256, 'x')}))).size() == 256);
  CHECK(text_of(*decode_control(encode_control(Refusal{std::string(257, 'x')}))).size() == 256);
  Bytes longer = bytes_of("01 02 8102");
  longer.resize(longer.size() + 257, std::byte{'x'});
  CHECK(is_refused(longer));
  const std::string rig(256 * 1024, 'r');
  CHECK(std::get<Welcome>(*decode_control(encode_control(Welcome{.rig = rig}))).rig == rig);
  CHECK(std::get<CarWelcome>(*decode_control(encode_control(CarWelcome{rig}))).rig == rig);
  Bytes too_long{std::byte{1}, std::byte{10}};
  ByteWriter(too_long).put_string(rig + "r");
  CHECK(is_refused(too_long));
}

TEST_CASE("controls that no driver can give are refused and never sent") {
  const auto written = [](const DriverInput& input) { return encode_control(Controls{input}); };
  // Each in turn at its bounds, beyond them, and as no number.
  struct Bound {
    double DriverInput::*value;
    std::size_t at;
    double least, most;
  };
  for (const Bound& bound :
       {Bound{&DriverInput::steering_wheel_rad, 2, -50.0, 50.0}, Bound{&DriverInput::accelerator, 10, 0.0, 1.0},
        Bound{&DriverInput::brake, 18, 0.0, 1.0}, Bound{&DriverInput::clutch, 26, 0.0, 1.0},
        Bound{&DriverInput::gaze_heading_rad, 42, -7.0, 7.0}}) {
    CAPTURE(bound.at);
    const auto with = [&](double number) {
      Bytes bytes = written({}), eight;
      ByteWriter(eight).put(number);
      std::copy(eight.begin(), eight.end(), bytes.begin() + static_cast<std::ptrdiff_t>(bound.at));
      return bytes;
    };
    CHECK_FALSE(is_refused(with(bound.least)));
    CHECK_FALSE(is_refused(with(bound.most)));
    CHECK(is_refused(with(bound.least - 1e-6)));
    CHECK(is_refused(with(bound.most + 1e-6)));
    CHECK(is_refused(with(std::nan(""))));
    DriverInput input;
    input.*bound.value = bound.most + 9.0;
    CHECK(written(input) == with(bound.most));
    input.*bound.value = bound.least - 9.0;
    CHECK(written(input) == with(bound.least));
  }
  const auto with_byte = [&](std::size_t at, int value) {
    Bytes bytes = written({});
    bytes[at] = static_cast<std::byte>(value);
    return bytes;
  };
  CHECK_FALSE(is_refused(with_byte(34, 4)));
  CHECK(is_refused(with_byte(34, 5)));  // No such position of the selector.
  CHECK(is_refused(with_byte(34, 0xff)));
  CHECK_FALSE(is_refused(with_byte(36, 0xff)));
  CHECK(is_refused(with_byte(36, 2)));  // Nor of the stalk.
  CHECK(is_refused(with_byte(36, 0xfe)));
}

TEST_CASE("a number that is none is refused wherever it stands") {
  CHECK(is_refused(encode_control(Presented{1, NAN})));
  CHECK(is_refused(encode_control(TickArrived{1, INFINITY, false})));
  CHECK(is_refused(encode_control(Welcome{.tick_rate_hz = std::nan("")})));
  CHECK(is_refused(encode_control(CarFeedback{1, 0.0f, 0.0f, 0.0f, NAN})));
}

TEST_CASE("the first byte tells control messages from those of the scene") {
  CHECK(lane_of(encode_control(Quit{})) == LaneMessage::control);
  const Bytes scene = scene_message(bytes_of("aa bb"));
  CHECK(scene == bytes_of("00 aa bb"));
  CHECK(lane_of(scene) == LaneMessage::scene);
  CHECK_FALSE(lane_of(bytes_of("02 00")).has_value());
  CHECK_FALSE(lane_of({}).has_value());
}

TEST_CASE("a tick's header is four times, a revision and a count in their order and no time may be no number") {
  Bytes bytes;
  ByteWriter writer(bytes);
  put_tick_header(writer, {0.25, 0.5, 0.75, 1.0, 300, 7});
  CHECK(bytes == bytes_of("000000000000d03f 000000000000e03f 000000000000e83f 000000000000f03f ac02 07"));
  ByteReader reader(bytes);
  const TickHeader header = get_tick_header(reader);
  CHECK(reader.ok());
  CHECK(header.published_s == 0.25);
  CHECK(header.offset_s == 0.5);
  CHECK(header.next_offset_s == 0.75);
  CHECK(header.next_from_s == 1.0);
  CHECK(header.scene_revision == 300);
  CHECK(header.events == 7);
  for (std::size_t i = 0; i < 4; ++i) {
    Bytes bad = bytes, nan;
    ByteWriter(nan).put(std::nan(""));
    std::copy(nan.begin(), nan.end(), bad.begin() + static_cast<std::ptrdiff_t>(8 * i));
    ByteReader in(bad);
    get_tick_header(in);
    CHECK_FALSE(in.ok());
  }
}

}  // namespace septet::control
