// The drive's sound on a sound card of the kernel: its output is heard behind it, and its failures affect no drive.
//
// snd-aloop plays into its own microphone. Its clock is another card's (snd-dummy), which runs while something is
// played there, so that it can be stopped; OpenAL's own thread can be frozen.

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <AL/al.h>
#include <AL/alc.h>
#include <doctest/doctest.h>
#include <fmt/core.h>

#include "tests/pipeline/process_rig.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/usb_car.hpp"

namespace septet::rig_vm {
namespace {

namespace fs = std::filesystem;

/// OpenAL's name of the device that has all of `parts` in it.
std::string device_with(ALCenum list, const std::vector<std::string>& parts) {
  for (const char* name = alcGetString(nullptr, list); name && *name; name += std::string_view(name).size() + 1) {
    bool has_all = true;
    for (const std::string& part : parts) has_all = has_all && std::string_view(name).find(part) != std::string::npos;
    if (has_all) return name;
  }
  return {};
}

/// The clock of the card that the server plays on: runs while this lives.
class Clock {
 public:
  Clock() : device_(alcOpenDevice(device_with(ALC_ALL_DEVICES_SPECIFIER, {"CARD=Dummy", "DEV=0"}).c_str())) {
    REQUIRE(device_ != nullptr);
    context_ = alcCreateContext(device_, nullptr);
    REQUIRE(context_ != nullptr);
  }
  ~Clock() {
    alcDestroyContext(context_);
    alcCloseDevice(device_);
  }
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

 private:
  ALCdevice* device_ = nullptr;
  ALCcontext* context_ = nullptr;
};

/// True if the server's card takes samples.
bool card_plays() {
  const auto played = [] {
    const std::string status = text_of("/proc/asound/Loopback/pcm0p/sub0/status");
    const auto at = status.find("hw_ptr");
    return at == std::string::npos ? std::string() : status.substr(at, status.find('\n', at) - at);
  };
  const std::string before = played();
  sleep_s(0.1);
  return !before.empty() && played() != before;
}

/// A microphone before the loudspeaker.
class Microphone {
 public:
  Microphone() {
    device_ = alcCaptureOpenDevice(device_with(ALC_CAPTURE_DEVICE_SPECIFIER, {"CARD=Loopback", "DEV=1"}).c_str(), 48000,
                                   AL_FORMAT_STEREO16, 48000);
    REQUIRE(device_ != nullptr);
    alcCaptureStart(device_);
  }
  ~Microphone() { alcCaptureCloseDevice(device_); }
  Microphone(const Microphone&) = delete;
  Microphone& operator=(const Microphone&) = delete;
  /// True if anything but silence has come since the last call.
  bool hears() {
    ALCint waiting = 0;
    alcGetIntegerv(device_, ALC_CAPTURE_SAMPLES, 1, &waiting);
    std::vector<short> samples(2 * static_cast<std::size_t>(waiting));
    if (waiting > 0) alcCaptureSamples(device_, samples.data(), waiting);
    for (const short sample : samples)
      if (sample > 30 || sample < -30) return true;
    return false;
  }

 private:
  ALCdevice* device_ = nullptr;
};

/// The thread of OpenAL's that hands samples to the card stands still, and goes on when this ends.
class FrozenMixer {
 public:
  FrozenMixer() {
    command("mkdir -p /tmp/freezer && mount -t cgroup -o freezer none /tmp/freezer && mkdir /tmp/freezer/frozen");
    // The card says which thread has opened it. That one then began the mixer, by the next number that it has.
    const std::string status = text_of("/proc/asound/Loopback/pcm0p/sub0/status");
    const auto at = status.find("owner_pid");
    REQUIRE(at != std::string::npos);
    const int opener = std::stoi(status.substr(status.find(':', at) + 1));
    int mixer = 0;
    for (const auto& thread : fs::directory_iterator(fmt::format("/proc/{}/task", opener)))
      if (const int id = std::stoi(thread.path().filename().string()); id > opener && (mixer == 0 || id < mixer))
        mixer = id;
    id_ = mixer > 0 ? std::to_string(mixer) : "";
    REQUIRE_FALSE(id_.empty());
    const std::string process = text_of(fmt::format("/proc/{}/status", opener));
    program_ = std::to_string(std::stoi(process.substr(process.find("Tgid:") + 5)));
    std::ofstream("/tmp/freezer/frozen/tasks") << id_;
    std::ofstream("/tmp/freezer/frozen/freezer.state") << "FROZEN";
    REQUIRE(becomes_true([] { return text_of("/tmp/freezer/frozen/freezer.state") == "FROZEN\n"; }));
  }
  ~FrozenMixer() {
    std::ofstream("/tmp/freezer/frozen/freezer.state") << "THAWED";
    last_command("sleep 1; rmdir /tmp/freezer/frozen; umount /tmp/freezer");
  }
  FrozenMixer(const FrozenMixer&) = delete;
  FrozenMixer& operator=(const FrozenMixer&) = delete;

  /// True if only the thread that cannot end is left of its program.
  bool is_alone() const { return text_of("/proc/" + program_ + "/stat").find(") Z ") != std::string::npos; }

 private:
  std::string id_, program_;
};

/// A server whose car is on USB and whose sound is on the card.
struct Drive {
  /// `clock`: the card's own; empty: the kernel's.
  explicit Drive(const char* clock) {
    std::ofstream("/proc/asound/Loopback/timer_source") << clock << '\n';
    device.plug();
    pipeline::write_text(
        folder / "rig.toml",
        pipeline::small_rig(1, "",
                            "source = \"hid\"\nserial = \"VM-1\"\n[car.actuators]\n"
                            "fan_full_speed_mps = 20\nfan_least = 0.2\n[sound]\nvolume_db = "
                            "20\ndevice = \"" +
                                device_with(ALC_ALL_DEVICES_SPECIFIER, {"CARD=Loopback", "DEV=0"}) + '"'));
    server = std::make_unique<program::ChildProcess>(pipeline::start(
        "septet-server",
        {"--rig", (folder / "rig.toml").string(), "--keys", pipeline::make_keys(folder / "keys", "a").string(), "--out",
         (folder / "out").string(), "--any-port", "--start-now", "--wait-for-screens", "2", "--seconds", "600",
         "--scenario", "/source/tests/conformance/data/scenarios/xosc/velodrome.xosc"},
        folder / "server.err"));
    DriverInput input;
    input.accelerator = 1.0;
    device.set(input);
  }
  std::string said() const { return text_of(folder / "server.err"); }
  bool moves() { return device.actuators().fan > 0.2 && device.actuators().vibration > 0.0; }
  bool is_at_rest() { return device.actuators().fan == 0.0 && device.actuators().vibration == 0.0; }
  double time_to_rest() {
    const double since_s = now_s();
    CHECK(becomes_true([&] { return is_at_rest(); }));
    return now_s() - since_s;
  }
  void rearm() {
    DriverInput input;
    input.accelerator = 1.0;
    device.set(input, {.rearm = true});
    sleep_s(1.5);
    device.set(input);
  }

  TemporaryFolder folder;
  UsbCar device{UsbCar::Kind::hid};
  std::unique_ptr<program::ChildProcess> server;
};

}  // namespace

TEST_SUITE_BEGIN("sound");

TEST_CASE("a sound card whose clock stops brings fan and shaker to rest and plays again when it goes on") {
  auto clock = std::make_unique<Clock>();
  Drive drive("hw:Dummy.0.0");
  CHECK(becomes_true([&] { return drive.moves() && card_plays(); }, 60.0));
  INFO(drive.said());
  REQUIRE(drive.moves());
  clock.reset();
  const double rest_s = drive.time_to_rest();
  measured("clock of the sound card stopped to fan and shaker at rest", 1000.0 * rest_s, "ms");
  CHECK(rest_s < 0.55);
  CHECK_FALSE(card_plays());
  // Sticky, also when the card plays again.
  sleep_s(2.0);
  clock = std::make_unique<Clock>();
  CHECK(becomes_true([&] { return card_plays(); }));
  sleep_s(1.0);
  CHECK(drive.is_at_rest());
  drive.rearm();
  CHECK(becomes_true([&] { return drive.moves(); }));
  drive.server->send_signal(SIGTERM);
  CHECK(pipeline::exit_code(*drive.server) == 3);
  CHECK(drive.is_at_rest());
  CHECK(drive.said().find("plays nothing any more") != std::string::npos);
}

TEST_CASE("a sound library that hangs brings fan and shaker to rest and does not hold up the end of the drive") {
  Drive drive("");
  {
    Microphone microphone;
    CHECK(becomes_true([&] { return drive.moves() && microphone.hears(); }, 60.0));
  }
  INFO(drive.said());
  {
    const FrozenMixer mixer;
    const double rest_s = drive.time_to_rest();
    measured("thread of the sound library frozen to fan and shaker at rest", 1000.0 * rest_s, "ms");
    CHECK(rest_s < 0.55);
    sleep_s(3.0);
    CHECK(drive.is_at_rest());
    const double told_s = now_s();
    drive.server->send_signal(SIGTERM);
    CHECK(becomes_true([&] { return mixer.is_alone(); }));
    measured("end of a drive whose sound hangs", now_s() - told_s, "s");
    CHECK(now_s() - told_s < 6.0);
  }
  CHECK(pipeline::exit_code(*drive.server) == 3);
  CHECK(drive.is_at_rest());
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
