#pragma once
/// What server, screens and car say to each other besides the scene: who is there, what was shown, what the driver did.
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

/// Of these messages; who speaks another one is refused.
inline constexpr std::uint16_t protocol_version = 4;

/// Screen → server, first of all.
struct Hello {
  std::string screen;           ///< Name in the rig, and of its key in the list of allowed clients.
  std::uint16_t tick_port = 0;  ///< UDP port on which it hears unicast ticks.
  std::uint16_t protocol = protocol_version;
};

/// Server → screen, the answer.
struct Welcome {
  std::string rig;  ///< The rig file's text: a screen needs no file of its own.
  bool lockstep = false;
  double tick_rate_hz = 120.0;
  std::uint32_t picture_every_ticks = 0;  ///< Keep a picture of every n-th tick; 0: none.
  std::uint32_t group_ip = 0;             ///< Multicast group of the tick lane; 0: ticks come to `Hello::tick_port`.
  std::uint16_t group_port = 0;
  std::uint32_t interface_ip = 0;
  bool thumbnails = false;  ///< Somebody looks on: send a small picture with each that is kept.
};

/// Server → screen: this screen cannot take part.
struct Refusal {
  std::string reason;
};

/// Screen → server: a tick has arrived and is kept as a possible baseline.
struct TickArrived {
  Tick tick = 0;
  float lateness_s = 0.0f;     ///< From its publication on the server's clock to its arrival.
  bool lost_baseline = false;  ///< It could not be read for want of its baseline: send a keyframe.
};

/// Screen → server: the scene's content up to this revision of the server's store is here.
struct SceneArrived {
  std::uint64_t revision = 0;
};

/// Screen → server: a frame was shown (in lockstep the server waits for it).
struct Presented {
  Tick tick = 0;
  float frame_ms = 0.0f;
};

/// Screen → server: the driver's controls, from a screen that has a keyboard or gamepad. Pedals outside of 0 to 1 and angles of
/// many turns are refused.
struct Controls {
  DriverInput input;
};

/// Server → screen: the drive is over; the screen answers with its report and leaves.
struct Finish {
  std::string reason;
};

/// Screen → server: what it has seen, for summary.json.
struct ScreenReport {
  std::uint64_t frames = 0;
  std::uint64_t frames_off_tick = 0;  ///< Frames that showed another tick than they should have.
  std::uint64_t datagrams_lost = 0, datagrams_repaired = 0;
  std::uint64_t refused_ticks = 0;                   ///< That arrived and could not be read.
  float frame_ms_p50 = 0.0f, frame_ms_p99 = 0.0f;    ///< From picture to picture.
  float submit_ms_p50 = 0.0f, submit_ms_p99 = 0.0f;  ///< Of that, until the picture was handed to the device.
};

/// septet-car → server, first of all.
struct CarHello {
  std::uint16_t protocol = protocol_version;
};

/// Server → septet-car, the answer.
struct CarWelcome {
  std::string rig;  ///< The rig file's text: it says which device.
};

/// septet-car → server: the device's newest report, again and again, whether there is a newer one or not.
struct CarReport {
  std::uint32_t number = 0;  ///< Counts these messages: one that was overtaken does not count.
  std::string report;        ///< As the device sent it; empty where there is none yet.
  std::string problem;       ///< Why the device is away; empty while it is there.
};

/// Server → septet-car: what fan, shaker and hand wheel shall do, shares of what they can.
struct CarFeedback {
  Tick tick = 0;
  float fan = 0.0f, vibration = 0.0f, vibration_hz = 0.0f;
  float steering = 0.0f;  ///< Positive turns to the left.
};

/// Screen → server: the person at this screen wants the drive to end. It is answered by Finish.
struct Quit {
  enum class How : std::uint8_t { window_closed, escape, restart } how = How::window_closed;
};

/// Server → screen: what the driver is to read on the screen ahead, until the next notice.
struct Notice {
  std::string text;     ///< Empty: nothing.
  bool keys = false;    ///< Also which keys drive, until the first one is pressed.
  bool paused = false;  ///< The person at a screen has paused the drive, and may go on or end it.
  bool operator==(const Notice&) const = default;
};

/// Screen → server: the person at this screen wants the world to stand still, or to go on.
struct Pause {
  bool paused = true;
};

/// Of a thumbnail, and of a large picture; a larger one is refused.
inline constexpr std::size_t most_thumbnail_bytes = 64 * 1024, most_picture_bytes = 512 * 1024;

/// Screen → server: what this screen shows, small, about once a second.
struct Thumbnail {
  Tick tick = 0;
  std::string picture;  ///< Any bytes: nobody here reads them.
};

/// Server → screen: somebody looks closely at this screen. For `looked_at_for_s` from now on it sends a LargePicture every
/// `look_every_s`; whoever goes on looking says so again.
struct Look {
  bool closely = true;  ///< False: no more.
};
inline constexpr double looked_at_for_s = 3.0, look_every_s = 0.2;

/// Screen → server: what this screen shows, large.
struct LargePicture {
  Tick tick = 0;
  std::string picture;  ///< As a thumbnail's.
};

using ControlMessage =
    std::variant<Hello, Welcome, Refusal, TickArrived, SceneArrived, Presented, Controls, Finish, ScreenReport,
                 CarHello, CarWelcome, CarReport, CarFeedback, Quit, Notice, Pause, Thumbnail, Look, LargePicture>;

/// The message with its lane byte.
Bytes encode_control(const ControlMessage& message);
/// `bytes` with the lane byte, as received.
Expected<ControlMessage> decode_control(std::span<const std::byte> bytes);

/// A replication message with its lane byte.
Bytes scene_message(std::span<const std::byte> message);

/// What kind a received message is; nothing for an empty or unknown one.
std::optional<LaneMessage> lane_of(std::span<const std::byte> bytes);

/// What the tick lane carries besides the snapshot: when it was published, and which simulated time to show at which instant.
/// The offset is the server's alone and changes at an announced instant of its clock: were it taken from the ticks that a
/// screen happens to hold, screens would differ by the jitter of publication, and a difference tears the seams.
struct TickHeader {
  double published_s = 0.0;  ///< Server's clock.
  double offset_s = 0.0;     ///< Shown simulated time = server's clock − offset.
  double next_offset_s = 0.0;
  double next_from_s = 0.0;  ///< Server's clock from which the next offset holds.
};
void put_tick_header(ByteWriter& writer, const TickHeader& header);
/// Puts the reader into its failed state where the header makes no sense.
TickHeader get_tick_header(ByteReader& reader);

}  // namespace septet::control
