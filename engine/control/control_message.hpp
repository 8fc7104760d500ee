#pragma once
/// Messages between server, screens and car besides the scene: joining, frames shown, the driver's controls.
///
/// These share the secure lane with scene commands; the first byte of every message tells which of the two it is
/// (`LaneMessage`). Format: CONTROL.md. A message from outside is decoded whole or refused.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::control {

/// First byte of every message on the secure lane.
enum class LaneMessage : std::uint8_t { scene = 0, control = 1 };

/// Version of these messages; a program of another version is refused.
inline constexpr std::uint16_t protocol_version = 8;

/// Screen → server, first of all.
struct Hello {
  std::string screen;           ///< Name in the rig, and of its key in the list of allowed clients.
  std::uint16_t tick_port = 0;  ///< UDP port on which it hears unicast ticks.
  std::uint16_t protocol = protocol_version;
};

/// Server → screen, the reply.
struct Welcome {
  std::string rig;  ///< The rig file's text: a screen needs no file of its own.
  bool lockstep = false;
  double tick_rate_hz = 120.0;
  std::uint32_t picture_every_ticks = 0;  ///< Keep a picture of every n-th tick; 0: none.
  std::uint32_t group_ip = 0;             ///< Multicast group of the tick lane; 0: ticks come to `Hello::tick_port`.
  std::uint16_t group_port = 0;
  std::uint32_t interface_ip = 0;
  bool thumbnails = false;  ///< The operator watches: send a small picture with each that is kept.
  ParticipantId eyes = 0;  ///< Whose eyes the screens show, in a replay that was asked for somebody's; 0: the driver's.
  std::string eyes_name;   ///< Their number, name and model in words; empty with `eyes` 0.
};

/// Server → screen: this screen cannot take part.
struct Refusal {
  std::string reason;
};

/// Screen → server: a tick has arrived and is kept as a possible baseline.
struct TickArrived {
  Tick tick = 0;
  float lateness_s = 0.0f;     ///< From its publication on the server's clock to its arrival.
  bool lost_baseline = false;  ///< The tick could not be read for want of its baseline: send a keyframe.
};

/// Screen → server: the scene's content has arrived up to this revision of the server's store.
struct SceneArrived {
  std::uint64_t revision = 0;
};

/// Screen → server: a frame was shown (in lockstep the server waits for it).
struct Presented {
  Tick tick = 0;
  float frame_ms = 0.0f;
};

/// Screen → server: the driver's controls, from a screen that has a keyboard or gamepad. Pedals outside of 0 to 1 and
/// angles of many turns are refused.
struct Controls {
  DriverInput input;
};

/// Server → screen: the drive has ended; the screen replies with its report and leaves.
struct Finish {
  std::string reason;
};

/// Screen → server: its measurements, for summary.json.
struct ScreenReport {
  std::uint64_t frames = 0;
  std::uint64_t frames_off_tick = 0;  ///< Frames that showed another tick than they should have.
  std::uint64_t datagrams_lost = 0, datagrams_repaired = 0;
  std::uint64_t refused_ticks = 0;                   ///< Ticks that arrived and could not be read.
  float frame_ms_p50 = 0.0f, frame_ms_p99 = 0.0f;    ///< Interval between pictures.
  float submit_ms_p50 = 0.0f, submit_ms_p99 = 0.0f;  ///< The part of it until the picture was handed to the device.
};

/// septet-car → server, first of all.
struct CarHello {
  std::uint16_t protocol = protocol_version;
};

/// Server → septet-car, the reply.
struct CarWelcome {
  std::string rig;  ///< The rig file's text: it names the device.
};

/// septet-car → server: the device's newest report, repeated whether there is a newer one or not.
struct CarReport {
  std::uint32_t number = 0;  ///< Counts these messages: an overtaken one is dropped.
  std::string report;        ///< As the device sent it; empty before the first one.
  std::string problem;       ///< Reason why the device is away; empty while it is there.
};

/// Server → septet-car: outputs of fan, shaker and hand wheel, shares of their maxima.
struct CarFeedback {
  Tick tick = 0;
  float fan = 0.0f, vibration = 0.0f, vibration_hz = 0.0f;
  float steering = 0.0f;  ///< Positive turns to the left.
};

/// Screen → server: the person at this screen requests the end of the drive. The reply is Finish.
struct Quit {
  enum class How : std::uint8_t { window_closed, escape, restart } how = How::window_closed;
};

/// Server → screen: text for the driver on the screen ahead, until the next notice.
struct Notice {
  std::string text;     ///< Empty: nothing.
  bool keys = false;    ///< Shows also the driving keys, until the first one is pressed.
  bool paused = false;  ///< The person at a screen has paused the drive, and may go on or end it.
  bool operator==(const Notice&) const = default;
};

/// Screen → server: the person at this screen requests a pause of the world, or its end.
struct Pause {
  bool paused = true;
};

/// Bounds of a thumbnail, and of a large picture; a larger one is refused.
inline constexpr std::size_t most_thumbnail_bytes = 64 * 1024, most_picture_bytes = 512 * 1024;

/// Screen → server: this screen's picture, small, about once a second.
struct Thumbnail {
  Tick tick = 0;
  std::string picture;  ///< Any bytes: the server does not decode them.
};

/// Server → screen: an operator watches this screen closely. For `looked_at_for_s` from now on it sends a LargePicture
/// every `look_every_s`; the request is renewed as long as it is watched.
struct Look {
  bool closely = true;  ///< False: stop.
};
inline constexpr double looked_at_for_s = 3.0, look_every_s = 0.2;

/// Screen → server: this screen's picture, large.
struct LargePicture {
  Tick tick = 0;
  std::string picture;  ///< Any bytes, as of a thumbnail.
};

/// Editor → server: a mark, a pause or a command of an operator's (sim-server/attendants/operator_lines.hpp).
struct OperatorLine {
  std::uint32_t number = 0;  ///< Names it in its answer.
  std::string line;
};
inline constexpr std::size_t most_operator_line_bytes = 4096;

/// Server → editor: what became of the line.
struct OperatorAnswer {
  std::uint32_t number = 0;
  Tick tick = 0;        ///< After which it was done.
  std::string why_not;  ///< Empty: done.
};

/// Editor → server: tell the drive's events from now on, as the log has them.
struct HearEvents {};

/// Server → editor, the reply: how many there have been. Those after them are told.
struct EventsFrom {
  std::uint64_t count = 0;
};

/// Server → editor: something happened. The numbers count up by one; a gap: the events between were dropped.
struct DriveEvent {
  std::uint64_t number = 0;  ///< From 1, of the drive.
  Tick tick = 0;
  double simulated_time_s = 0.0;
  std::string kind;  ///< "collision", "lane_change", "mark", …: logging/FORMAT.md.
  bool has_participant = false;
  ParticipantId participant = 0;
  std::string detail;  ///< key=value pairs.
};
inline constexpr std::size_t most_event_detail_bytes = 4096;

using ControlMessage =
    std::variant<Hello, Welcome, Refusal, TickArrived, SceneArrived, Presented, Controls, Finish, ScreenReport,
                 CarHello, CarWelcome, CarReport, CarFeedback, Quit, Notice, Pause, Thumbnail, Look, LargePicture,
                 OperatorLine, OperatorAnswer, HearEvents, EventsFrom, DriveEvent>;

/// The message with its lane byte.
Bytes encode_control(const ControlMessage& message);
/// `bytes` with the lane byte, as received.
Expected<ControlMessage> decode_control(std::span<const std::byte> bytes);

/// A replication message with its lane byte.
Bytes scene_message(std::span<const std::byte> message);

/// Kind of a received message; empty for an empty or unknown one.
std::optional<LaneMessage> lane_of(std::span<const std::byte> bytes);

/// The tick lane's data beside the snapshot: time of publication, and which simulated time to show at which instant.
/// The offset is the server's alone and changes at an announced instant of its clock: were it taken from the ticks that
/// a screen happens to hold, screens would differ by the jitter of publication, and a difference tears the seams.
struct TickHeader {
  double published_s = 0.0;  ///< Server's clock.
  double offset_s = 0.0;     ///< Shown simulated time = server's clock − offset.
  double next_offset_s = 0.0;
  double next_from_s = 0.0;          ///< Server's clock from which the next offset holds.
  std::uint64_t scene_revision = 0;  ///< Of the server's store, as the tick shows it.
  std::uint64_t events = 0;          ///< Of the drive until then: a hearer waits for them before it reads the tick.
};
void put_tick_header(ByteWriter& writer, const TickHeader& header);
/// Puts the reader into its failed state where the header makes no sense.
TickHeader get_tick_header(ByteReader& reader);

}  // namespace septet::control
