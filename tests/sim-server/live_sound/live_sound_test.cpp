#include "sim-server/host/live_sound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "sim-server/drive/told_on_page.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::server {
namespace {

/// A loudspeaker on simulated time: it plays a block every 1/120 s while it is well.
struct Loudspeaker {
  std::size_t queued = 0;
  std::uint64_t starved = 0;
  double loudest_pa = 0.0;  ///< Of the last block.
  bool is_there = true, is_connected = true, is_playing = true;
  int opened = 0, closed = 0;

  OpenSoundOutput opener() {
    return [this]() -> Expected<std::unique_ptr<SoundOutput>> {
      if (!is_there) return failure("there is no sound device that can be opened", "the usual one", "connect one");
      ++opened;
      queued = 0;
      return std::make_unique<Output>(*this);
    };
  }
  void play_block() {
    if (!is_playing) return;
    if (queued == 0)
      ++starved;
    else
      --queued;
  }

 private:
  struct Output final : SoundOutput {
    explicit Output(Loudspeaker& of) : speaker(of) {}
    ~Output() override { ++speaker.closed; }
    void put(std::span<const audio::Voice> voices, double) override {
      ++speaker.queued;
      speaker.loudest_pa = 0.0;
      for (const auto& voice : voices)
        for (const float sample : voice.samples)
          speaker.loudest_pa = std::max(speaker.loudest_pa, std::abs(static_cast<double>(sample)));
    }
    std::size_t blocks_ahead() override { return speaker.queued; }
    bool is_connected() override { return speaker.is_connected; }
    std::uint64_t starved() const override { return speaker.starved; }
    const std::string& name() const override { return label; }
    Loudspeaker& speaker;
    std::string label = "test speaker";
  };
};

constexpr double tick_s = 1.0 / 120.0;

/// A second of feeder, device and, where they go on, ticks of a car at 30 m/s.
struct Drive {
  explicit Drive(Loudspeaker& of) : speaker(of), feeder(of.opener(), {}, {}) {}

  void run(double seconds, int ticks_each = 1) {
    const auto count = static_cast<int>(std::lround(seconds / tick_s));
    for (int i = 0; i < count; ++i, now_s += tick_s) {
      for (int t = 0; t < ticks_each; ++t) {
        Snapshot snapshot;
        snapshot.tick = ++tick;
        snapshot.simulated_time_s = static_cast<double>(tick) * tick_s;
        snapshot.driver_car = {.participant = 1, .speed_mps = 30.0, .engine_radps = 300.0, .gear = 4};
        snapshot.participants.push_back({.id = 1, .velocity_mps = Vec3(30.0, 0.0, 0.0), .wheel_spin_radps = 90.0});
        feeder.add(std::make_shared<const TakenSnapshot>(std::move(snapshot)), now_s);
      }
      feeder.pump(now_s);
      speaker.play_block();
    }
  }

  Loudspeaker& speaker;
  SoundFeeder feeder;
  double now_s = 0.0;
  Tick tick = 0;
};

}  // namespace

TEST_CASE("every block that the device plays is of a tick and none is missing") {
  Loudspeaker speaker;
  Drive drive(speaker);
  drive.run(2.0);
  CHECK(drive.feeder.take_message() == "sound: test speaker");
  CHECK_FALSE(drive.feeder.take_message().has_value());
  CHECK(speaker.starved == 0);
  CHECK(speaker.loudest_pa > 0.01);
  const auto counts = drive.feeder.counts();
  CHECK(counts.blocks >= 240);
  CHECK(counts.repeated <= 3);  // To begin with.
  CHECK(counts.left_out == 0);
}

TEST_CASE("ticks that come faster than they are played are left out and the sound stays close behind") {
  Loudspeaker speaker;
  Drive drive(speaker);
  drive.run(1.0, 2);
  CHECK(drive.feeder.counts().left_out > 100);
  CHECK(speaker.queued <= 3);
}

TEST_CASE("a pause fades the sound and the next tick brings it back") {
  Loudspeaker speaker;
  Drive drive(speaker);
  drive.run(1.0);
  drive.run(0.05, 0);
  CHECK(speaker.loudest_pa > 0.01);
  drive.run(2.0, 0);
  CHECK(speaker.loudest_pa < 0.002);
  CHECK(speaker.starved == 0);
  drive.run(0.5);
  CHECK(speaker.loudest_pa > 0.01);
}

TEST_CASE("without a device the drive goes on and that is said once and a device that comes plays") {
  Loudspeaker speaker;
  speaker.is_there = false;
  Drive drive(speaker);
  drive.run(10.0);
  CHECK(drive.feeder.take_message().value().starts_with("no sound: the usual one"));
  CHECK_FALSE(drive.feeder.take_message().has_value());
  speaker.is_there = true;
  drive.run(2.5);
  CHECK(drive.feeder.take_message() == "sound: test speaker");
  CHECK(speaker.loudest_pa > 0.01);
}

TEST_CASE("a device that is pulled out is told and opened again within two seconds or so") {
  Loudspeaker speaker;
  Drive drive(speaker);
  drive.run(1.0);
  drive.feeder.take_message();
  speaker.is_connected = false;
  drive.run(0.15);
  CHECK(drive.feeder.take_message() == "no sound: test speaker: it was disconnected; it is opened again by itself");
  speaker.is_connected = true;
  drive.run(2.1);
  CHECK(drive.feeder.take_message() == "sound: test speaker");
  CHECK(speaker.opened == 2);
}

TEST_CASE("a device whose callback has stopped is noticed within 300 ms although it says that it is there") {
  Loudspeaker speaker;
  Drive drive(speaker);
  drive.run(1.0);
  drive.feeder.take_message();
  speaker.is_playing = false;
  drive.run(0.2);
  CHECK_FALSE(drive.feeder.take_message().has_value());
  drive.run(0.1);
  CHECK(drive.feeder.take_message() ==
        "no sound: test speaker: it plays nothing any more; it is opened again by itself");
  CHECK(drive.feeder.counts().lost == 1);
  speaker.is_playing = true;
  drive.run(2.2);
  CHECK(speaker.opened == 2);
}

TEST_CASE("that a device is lost is known before it is closed, which may hang") {
  Loudspeaker speaker;
  Drive drive(speaker);
  drive.run(1.0);
  speaker.is_playing = false;
  while (drive.feeder.counts().lost == 0) drive.run(tick_s);
  CHECK(drive.now_s < 1.3);
  CHECK(speaker.closed == 0);
  drive.run(tick_s);
  CHECK(speaker.closed == 1);
}

TEST_CASE("a rig that asks for 5.1 has six channels of a device whose settings leave that open") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "played.wav";
  {
    // OpenAL's device that writes a file stands for one; XDG_CONFIG_HOME has the user's settings.
    std::ofstream(folder.path() / "alsoft.conf") << "drivers = wave\n[wave]\nfile = " << file.string() << "\n";
    setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
    const auto open = device_opener({.speakers = rig::Sound::Speakers::surround_51});
    auto output = open();
    REQUIRE(output.has_value());
    const audio::Voice voice{.key = 1};
    (*output)->put({&voice, 1}, 0.0);
  }
  std::ifstream in(file, std::ios::binary);
  std::array<unsigned char, 24> header{};
  REQUIRE(in.read(reinterpret_cast<char*>(header.data()), header.size()));
  CHECK(header[22] + 256 * header[23] == 6);  // Channels of a WAV file.
}

TEST_CASE("a device that lets nobody go on counts as lost while it hangs") {
  struct Gate {
    std::mutex mutex;
    std::condition_variable changed;
    bool is_open = false;
  };
  struct HangingOutput final : SoundOutput {
    explicit HangingOutput(std::shared_ptr<Gate> before) : gate(std::move(before)) {}
    void put(std::span<const audio::Voice>, double) override {
      if (++puts <= 3) return;
      std::unique_lock lock(gate->mutex);
      gate->changed.wait(lock, [&] { return gate->is_open; });
    }
    std::size_t blocks_ahead() override { return 0; }
    bool is_connected() override { return true; }
    std::uint64_t starved() const override { return 0; }
    const std::string& name() const override { return label; }
    std::shared_ptr<Gate> gate;
    int puts = 0;
    std::string label = "hanging speaker";
  };
  const auto gate = std::make_shared<Gate>();
  LiveSound live(SoundFeeder(
      [gate]() -> Expected<std::unique_ptr<SoundOutput>> { return std::make_unique<HangingOutput>(gate); }, {}, {}));
  // As long as it takes: the device hangs at its second feeding.
  while (live.counts().lost == 0) std::this_thread::yield();
  {
    const std::lock_guard lock(gate->mutex);
    gate->is_open = true;
  }
  gate->changed.notify_all();
  while (live.counts().lost != 0) std::this_thread::yield();
}

// Comes after the case of 5.1 channels: OpenAL reads its settings once.
TEST_CASE("the page is told device, fault and remedy apart, so that it can say them in its language") {
  SoundFeeder deviceless(device_opener({.device = "no such device"}), {}, {});
  deviceless.pump(0.0);
  const auto message = deviceless.take_message();
  REQUIRE(message.has_value());
  const auto told = told_on_page({.kind = "screen", .participant = {}, .detail = *message});
  REQUIRE(told.has_value());
  CHECK(told->kind == "no_sound");
  CHECK(told->text == *message);
  REQUIRE(told->values.size() == 3);
  CHECK(told->values[0] == std::pair<std::string, std::string>("device", "no such device"));
  CHECK(told->values[1] == std::pair<std::string, std::string>("why", "there is no sound device that can be opened"));
  CHECK(told->values[2].first == "remedy");
  CHECK(told->values[2].second.starts_with("connect or switch on one"));

  Loudspeaker speaker;
  Drive drive(speaker);
  drive.run(0.1);
  const auto opened =
      told_on_page({.kind = "screen", .participant = {}, .detail = drive.feeder.take_message().value_or("nothing")});
  REQUIRE(opened.has_value());
  CHECK(opened->kind == "sound");
  CHECK(opened->values == std::vector<std::pair<std::string, std::string>>{{"device", "test speaker"}});
}

}  // namespace septet::server
