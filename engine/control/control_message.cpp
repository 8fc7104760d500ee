#include "engine/control/control_message.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

namespace septet::control {
namespace {

constexpr std::size_t max_text = 256;
constexpr std::size_t max_rig_text = 1 << 18;

// One `fields` per message names its members once, for writing and reading alike.
template <class Visitor>
void fields(Hello& m, Visitor& v) {
  v(m.screen);
  v(m.tick_port);
  v(m.protocol);
}
template <class Visitor>
void fields(Welcome& m, Visitor& v) {
  v.text(m.rig, max_rig_text);
  v(m.lockstep);
  v(m.tick_rate_hz);
  v(m.picture_every_ticks);
  v(m.group_ip);
  v(m.group_port);
  v(m.interface_ip);
  v(m.thumbnails);
  v(m.eyes);
  v(m.eyes_name);
}
template <class Visitor>
void fields(Refusal& m, Visitor& v) {
  v(m.reason);
}
template <class Visitor>
void fields(TickArrived& m, Visitor& v) {
  v(m.tick);
  v(m.lateness_s);
  v(m.lost_baseline);
}
template <class Visitor>
void fields(SceneArrived& m, Visitor& v) {
  v(m.revision);
}
template <class Visitor>
void fields(Presented& m, Visitor& v) {
  v(m.tick);
  v(m.frame_ms);
}
template <class Visitor>
void fields(Controls& m, Visitor& v) {
  DriverInput& i = m.input;
  v.within(i.steering_wheel_rad, -50.0, 50.0);
  v.within(i.accelerator, 0.0, 1.0);
  v.within(i.brake, 0.0, 1.0);
  v.within(i.clutch, 0.0, 1.0);
  v.enumeration(i.selector, GearSelector::park, GearSelector::manual);
  v(i.gear);
  v.enumeration(i.indicator, IndicatorStalk::right, IndicatorStalk::left);
  v(i.hazard_lights);
  v(i.horn);
  v(i.low_beam);
  v(i.high_beam);
  v(i.parking_brake);
  v.within(i.gaze_heading_rad, -7.0, 7.0);
  v(i.sequence);
  for (double* part : {&i.head.from_rest_m.x, &i.head.from_rest_m.y, &i.head.from_rest_m.z})
    v.within(*part, -farthest_head_m, farthest_head_m);
  v.within(i.head.turn_rad, -std::numbers::pi, std::numbers::pi);
}
template <class Visitor>
void fields(Finish& m, Visitor& v) {
  v(m.reason);
}
template <class Visitor>
void fields(ScreenReport& m, Visitor& v) {
  v(m.frames);
  v(m.frames_off_tick);
  v(m.datagrams_lost);
  v(m.datagrams_repaired);
  v(m.refused_ticks);
  v(m.frame_ms_p50);
  v(m.frame_ms_p99);
  v(m.submit_ms_p50);
  v(m.submit_ms_p99);
}
template <class Visitor>
void fields(CarHello& m, Visitor& v) {
  v(m.protocol);
}
template <class Visitor>
void fields(CarWelcome& m, Visitor& v) {
  v.text(m.rig, max_rig_text);
}
template <class Visitor>
void fields(CarReport& m, Visitor& v) {
  v(m.number);
  v(m.report);
  v(m.problem);
}
template <class Visitor>
void fields(CarFeedback& m, Visitor& v) {
  v(m.tick);
  v(m.fan);
  v(m.vibration);
  v(m.vibration_hz);
  v(m.steering);
}
template <class Visitor>
void fields(Quit& m, Visitor& v) {
  v.enumeration(m.how, Quit::How::window_closed, Quit::How::restart);
}
template <class Visitor>
void fields(Notice& m, Visitor& v) {
  v(m.text);
  v(m.keys);
  v(m.paused);
}
template <class Visitor>
void fields(Pause& m, Visitor& v) {
  v(m.paused);
}
template <class Visitor>
void fields(Thumbnail& m, Visitor& v) {
  v(m.tick);
  v.text(m.picture, most_thumbnail_bytes);
}
template <class Visitor>
void fields(Look& m, Visitor& v) {
  v(m.closely);
}
template <class Visitor>
void fields(LargePicture& m, Visitor& v) {
  v(m.tick);
  v.text(m.picture, most_picture_bytes);
}

template <class Visitor>
void fields(OperatorLine& m, Visitor& v) {
  v(m.number);
  v.text(m.line, most_operator_line_bytes);
}
template <class Visitor>
void fields(OperatorAnswer& m, Visitor& v) {
  v(m.number);
  v(m.tick);
  v(m.why_not);
}

template <class Visitor>
void fields(HearEvents&, Visitor&) {}
template <class Visitor>
void fields(EventsFrom& m, Visitor& v) {
  v(m.count);
}
template <class Visitor>
void fields(DriveEvent& m, Visitor& v) {
  v(m.number);
  v(m.tick);
  v(m.simulated_time_s);
  v(m.kind);
  v(m.has_participant);
  v(m.participant);
  v.text(m.detail, most_event_detail_bytes);
}

struct Put {
  ByteWriter writer;
  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>)
      writer.put<std::uint8_t>(value);
    else
      writer.put(value);
  }
  void operator()(std::string& value) { text(value, max_text); }
  void text(std::string& value, std::size_t limit) { writer.put_string(std::string_view(value).substr(0, limit)); }
  void within(double& value, double least, double most) { writer.put(std::clamp(value, least, most)); }
  template <class T>
  void enumeration(T& value, T, T) {
    writer.put(static_cast<std::int8_t>(value));
  }
};

struct Get {
  ByteReader& reader;
  template <std::integral T>
  void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      const auto byte = reader.get<std::uint8_t>();
      if (byte > 1) reader.fail();
      value = byte == 1;
    } else {
      value = reader.get<T>();
    }
  }
  void operator()(double& value) {
    value = reader.get_double();
    if (!std::isfinite(value)) reader.fail();
  }
  void operator()(float& value) {
    value = reader.get_float();
    if (!std::isfinite(value)) reader.fail();
  }
  void operator()(std::string& value) { text(value, max_text); }
  void text(std::string& value, std::size_t limit) { value = reader.get_string(limit); }
  void within(double& value, double least, double most) {
    value = reader.get_double();
    if (!(value >= least && value <= most)) reader.fail();
  }
  template <class T>
  void enumeration(T& value, T low, T high) {
    const auto number = reader.get<std::int8_t>();
    if (number < static_cast<std::int8_t>(low) || number > static_cast<std::int8_t>(high)) reader.fail();
    value = static_cast<T>(number);
  }
};

template <std::size_t Index = 0>
bool read_alternative(std::size_t index, ByteReader& reader, ControlMessage& message) {
  if constexpr (Index < std::variant_size_v<ControlMessage>) {
    if (index != Index) return read_alternative<Index + 1>(index, reader, message);
    Get get{reader};
    fields(message.emplace<Index>(), get);
    return reader.ok() && reader.at_end();
  }
  return false;
}

}  // namespace

Bytes encode_control(const ControlMessage& message) {
  Bytes bytes;
  Put put{ByteWriter(bytes)};
  put.writer.put(static_cast<std::uint8_t>(LaneMessage::control));
  put.writer.put(static_cast<std::uint8_t>(message.index()));
  ControlMessage copy = message;
  std::visit([&](auto& alternative) { fields(alternative, put); }, copy);
  return bytes;
}

Expected<ControlMessage> decode_control(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  ControlMessage message;
  if (reader.get<std::uint8_t>() != static_cast<std::uint8_t>(LaneMessage::control) ||
      !read_alternative(reader.get<std::uint8_t>(), reader, message))
    return failure(fmt::format("malformed control message of {} bytes", bytes.size()), "secure lane",
                   "run the same version of Septet on all machines");
  return message;
}

Bytes scene_message(std::span<const std::byte> message) {
  Bytes framed{static_cast<std::byte>(LaneMessage::scene)};
  framed.insert(framed.end(), message.begin(), message.end());
  return framed;
}

std::optional<LaneMessage> lane_of(std::span<const std::byte> bytes) {
  if (bytes.empty() || static_cast<std::uint8_t>(bytes[0]) > static_cast<std::uint8_t>(LaneMessage::control))
    return std::nullopt;
  return static_cast<LaneMessage>(bytes[0]);
}

void put_tick_header(ByteWriter& writer, const TickHeader& header) {
  writer.put(header.published_s);
  writer.put(header.offset_s);
  writer.put(header.next_offset_s);
  writer.put(header.next_from_s);
  writer.put_varint(header.scene_revision);
  writer.put_varint(header.events);
}

TickHeader get_tick_header(ByteReader& reader) {
  TickHeader header;
  header.published_s = reader.get_double();
  header.offset_s = reader.get_double();
  header.next_offset_s = reader.get_double();
  header.next_from_s = reader.get_double();
  header.scene_revision = reader.get_varint();
  header.events = reader.get_varint();
  for (const double value : {header.published_s, header.offset_s, header.next_offset_s, header.next_from_s})
    if (!std::isfinite(value)) reader.fail();
  return header;
}

}  // namespace septet::control
