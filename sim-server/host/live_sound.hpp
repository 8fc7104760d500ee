#pragma once
/// The sound of a drive in real time: ticks in, blocks of sound to a device out, one block per tick.
///
/// If a tick is late, the previous one is played again; without ticks for 100 ms (a pause, a server that hangs) the
/// sound fades. Ticks faster than the device plays are dropped inaudibly, since the synthesis carries its own state
/// from block to block. A device that is missing, lost, or claims to be there but plays nothing is reported once and
/// reopened every two seconds; the drive goes on without sound. A library or a driver that hangs, even on close, delays
/// neither the report that the sound is lost nor the end of the drive.
///
/// `SoundFeeder` has no thread and no clock; `LiveSound` runs one in a thread of its own. OpenAL has one current
/// context per process.

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/audio/soundtrack.hpp"
#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"
#include "engine/world/taken_snapshot.hpp"

namespace septet::server {

/// Output of sound: an audio::SoundStage on a device, or a test.
class SoundOutput {
 public:
  virtual ~SoundOutput() = default;
  virtual void put(std::span<const audio::Voice> voices, double tunnel) = 0;
  virtual std::size_t blocks_ahead() = 0;
  virtual bool is_connected() = 0;
  virtual std::uint64_t starved() const = 0;
  virtual const std::string& name() const = 0;
};
using OpenSoundOutput = std::function<Expected<std::unique_ptr<SoundOutput>>()>;

OpenSoundOutput device_opener(const rig::Sound& sound);

class SoundFeeder {
 public:
  /// `roads`: for vibrations and noise of the ground; null: a good road without lines. They must outlive the feeder
  /// unless the pointer owns them.
  SoundFeeder(OpenSoundOutput open, const audio::CarSound& car, std::vector<audio::EchoBox> boxes,
              std::shared_ptr<const road::RoadNetwork> roads = nullptr);

  /// `low_share`: permitted share of the sound's low frequencies, from the next block on (OwnCar::low_share).
  void add(std::shared_ptr<const TakenSnapshot> tick, double now_s, double low_share = 1.0);
  /// Keeps the device fed; call it every few milliseconds.
  void pump(double now_s);
  /// Returns a message for a person since the last call.
  std::optional<std::string> take_message();

  struct Counts {
    std::uint64_t blocks = 0, repeated = 0, left_out = 0, starved = 0, lost = 0;
  };
  Counts counts() const;
  bool has_output() const { return output_ != nullptr; }

 private:
  bool is_open(double now_s);
  void lose(double now_s, const std::string& why);
  void feed(double now_s);
  void tell(std::string text);

  OpenSoundOutput open_;
  audio::State state_;
  std::vector<audio::EchoBox> boxes_;
  std::shared_ptr<const road::RoadNetwork> roads_;
  std::optional<road::RoadPosition> place_;
  std::unique_ptr<SoundOutput> output_;
  std::unique_ptr<SoundOutput>
      closing_;  ///< Lost; closed by the next pump, so that a close that hangs does not delay the report of the loss.
  std::optional<double> next_try_s_, came_s_;
  double low_share_ = 1.0;
  double played_s_ = 0.0;  ///< Time when the device last took a block from its queue.
  std::size_t ahead_ = 0;  ///< Blocks in its queue when it was last looked at.
  double checked_s_ = 0.0;
  std::deque<std::shared_ptr<const TakenSnapshot>> waiting_;
  struct HeardTick {
    std::shared_ptr<const TakenSnapshot> tick;
    std::optional<Snapshot> decoded;
    const Snapshot& snapshot() const { return decoded ? *decoded : tick->snapshot(); }
  };
  HeardTick before_;
  audio::Heard heard_;
  std::vector<audio::Voice> voices_;
  Counts counts_;
  std::deque<std::string> messages_;
  std::string last_told_;
};

class LiveSound {
 public:
  explicit LiveSound(SoundFeeder feeder);
  /// Waits until the device is closed, but at most three seconds if that hangs.
  ~LiveSound();
  LiveSound(const LiveSound&) = delete;
  LiveSound& operator=(const LiveSound&) = delete;
  void add(std::shared_ptr<const TakenSnapshot> tick, double low_share = 1.0);
  std::optional<std::string> take_message();
  /// A device that blocks the thread for 250 ms counts as lost, too.
  SoundFeeder::Counts counts() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace septet::server
