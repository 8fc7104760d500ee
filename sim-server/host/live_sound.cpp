#include "sim-server/host/live_sound.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <fmt/core.h>

#include "engine/audio/sound_stage.hpp"

namespace septet::server {
namespace {

// One block is one tick, 8.3 ms.
constexpr std::size_t blocks_kept_ahead = 3;
constexpr std::size_t most_waiting = 6;
constexpr double silent_after_s = 0.1;
constexpr double stalled_after_s = 0.25;
constexpr double retry_s = 2.0, check_every_s = 0.1;
constexpr std::chrono::seconds closing_takes_at_most{3};

class StageOutput final : public SoundOutput {
 public:
  explicit StageOutput(audio::SoundStage stage) : stage_(std::move(stage)) {}
  void put(std::span<const audio::Voice> voices, double tunnel) override { stage_.put(voices, tunnel); }
  std::size_t blocks_ahead() override { return stage_.blocks_ahead(); }
  bool is_connected() override { return stage_.is_connected(); }
  std::uint64_t starved() const override { return stage_.starved(); }
  const std::string& name() const override { return stage_.name(); }

 private:
  audio::SoundStage stage_;
};

void say_nothing(const char*, int, const char*, int, const char*, ...) {}

/// Silences the libraries' own error output: Septet reports a missing device once, ALSA and OpenAL would print a page
/// at every try. ALSA is loaded by OpenAL, not linked. Called before the thread that plays starts.
void quiet_sound_libraries() {
  setenv("ALSOFT_LOGLEVEL", "0", 0);
  void* alsa = dlopen("libasound.so.2", RTLD_NOW);  // Kept loaded: the handler belongs to it.
  using Handler = void (*)(const char*, int, const char*, int, const char*, ...);
  if (void* set = alsa ? dlsym(alsa, "snd_lib_error_set_handler") : nullptr)
    reinterpret_cast<int (*)(Handler)>(set)(say_nothing);
}

/// Requests six channels from OpenAL 1.19, by the only means it has: a settings file, read after those of the machine
/// and of the user, before its first device is opened. The file is in memory, so that nothing is left behind. A user's
/// own ALSOFT_CONF takes precedence.
void ask_for_six_channels() {
  static constexpr std::string_view settings = "channels = surround51\n";
  const int file = memfd_create("septet-alsoft.conf", 0);  // Kept open: OpenAL opens it by its number.
  if (file < 0 || ::write(file, settings.data(), settings.size()) != static_cast<ssize_t>(settings.size())) return;
  setenv("ALSOFT_CONF", fmt::format("/proc/self/fd/{}", file).c_str(), 0);
}

}  // namespace

OpenSoundOutput device_opener(const rig::Sound& sound) {
  quiet_sound_libraries();
  using Speakers = rig::Sound::Speakers;
  if (sound.speakers == Speakers::surround_51) ask_for_six_channels();
  const audio::StageOptions options{
      .speakers = sound.speakers == Speakers::surround_51 ? audio::Speakers::surround_51 : audio::Speakers::stereo,
      .headphones = sound.speakers == Speakers::headphones,
      .volume_db = sound.volume_db};
  return [options, device = sound.device]() -> Expected<std::unique_ptr<SoundOutput>> {
    auto stage = audio::SoundStage::open_device(options, device);
    if (!stage) return tl::unexpected(stage.error());
    return std::make_unique<StageOutput>(std::move(*stage));
  };
}

SoundFeeder::SoundFeeder(OpenSoundOutput open, const audio::CarSound& car, std::vector<audio::EchoBox> boxes,
                         std::shared_ptr<const road::RoadNetwork> roads)
    : open_(std::move(open)),
      state_(audio::start(car, Random(1))),
      boxes_(std::move(boxes)),
      roads_(std::move(roads)) {}

void SoundFeeder::tell(std::string text) {
  if (text == last_told_) return;
  last_told_ = text;
  if (messages_.size() < 16) messages_.push_back(std::move(text));
}

std::optional<std::string> SoundFeeder::take_message() {
  if (messages_.empty()) return std::nullopt;
  std::string text = std::move(messages_.front());
  messages_.pop_front();
  return text;
}

SoundFeeder::Counts SoundFeeder::counts() const {
  Counts counts = counts_;
  if (output_) counts.starved += output_->starved();
  return counts;
}

void SoundFeeder::add(std::shared_ptr<const TakenSnapshot> tick, double now_s, double low_share) {
  came_s_ = now_s;
  low_share_ = low_share;
  waiting_.push_back(std::move(tick));
  for (; waiting_.size() > most_waiting; waiting_.pop_front()) ++counts_.left_out;
}

bool SoundFeeder::is_open(double now_s) {
  if (output_) return true;
  if (next_try_s_ && now_s < *next_try_s_) return false;
  next_try_s_ = now_s + retry_s;
  auto opened = open_();
  if (!opened) {
    tell("no sound: " + describe(opened.error()));
    return false;
  }
  output_ = std::move(*opened);
  played_s_ = checked_s_ = now_s;
  ahead_ = 0;
  tell("sound: " + output_->name());
  return true;
}

void SoundFeeder::lose(double now_s, const std::string& why) {
  counts_.starved += output_->starved();
  ++counts_.lost;
  tell("no sound: " + describe(Error{why, output_->name(), "it is opened again by itself"}));
  closing_ = std::move(output_);
  next_try_s_ = now_s + retry_s;
}

void SoundFeeder::feed(double now_s) {
  if (!waiting_.empty()) {
    HeardTick now{std::move(waiting_.front()), {}};
    waiting_.pop_front();
    // Ticks from a log have their participants as integers.
    if (now.tick->snapshot().participants.empty()) now.decoded = from_wire(now.tick->wire());
    // After a gap, no events are derived from the step between two ticks.
    const bool follows = before_.tick && now.snapshot().tick == before_.snapshot().tick + 1;
    const auto ground =
        roads_ ? audio::feel_ground(*roads_, now.snapshot(), place_, state_.car.wheelbase_m) : audio::GroundFeel{};
    heard_ = audio::hear(now.snapshot(), follows ? &before_.snapshot() : nullptr, state_.car, boxes_, ground);
    before_ = std::move(now);
  } else {
    ++counts_.repeated;
    if (!came_s_ || now_s - *came_s_ > silent_after_s) heard_ = {};
    heard_.car.blow_mps = heard_.car.bump_mps = 0.0;
    heard_.car.pieces = 0;
    for (auto& other : heard_.others) other.blow_mps = 0.0;
  }
  heard_.car.low_share = low_share_;
  audio::render(state_, heard_, voices_);
  output_->put(voices_, heard_.car.tunnel);
  ++counts_.blocks;
}

void SoundFeeder::pump(double now_s) {
  closing_.reset();
  if (!is_open(now_s)) return waiting_.clear();
  if (now_s - checked_s_ > check_every_s) {
    checked_s_ = now_s;
    if (!output_->is_connected()) return lose(now_s, "it was disconnected");
  }
  std::size_t ahead = output_->blocks_ahead();
  if (ahead < ahead_ || ahead == 0) played_s_ = now_s;
  if (now_s - played_s_ > stalled_after_s) return lose(now_s, "it plays nothing any more");
  for (; ahead < blocks_kept_ahead; ++ahead) feed(now_s);
  ahead_ = ahead;
}

struct LiveSound::State {
  explicit State(SoundFeeder taken) : feeder(std::move(taken)) {}

  static double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  void run() {
    std::unique_lock lock(mutex);
    std::deque<std::shared_ptr<const TakenSnapshot>> taken;
    while (!stopping) {
      taken.swap(arrived);
      const double share = low_share;
      // Unlocked, since opening a device may take seconds and `add` must not wait.
      lock.unlock();
      for (auto& tick : taken) feeder->add(std::move(tick), now_s(), share);
      taken.clear();
      feeder->pump(now_s());
      auto message = feeder->take_message();
      lock.lock();
      counts = feeder->counts();
      playing_at_s = feeder->has_output() ? std::optional(now_s()) : std::nullopt;
      if (message) messages.push_back(std::move(*message));
      changed.wait_for(lock, std::chrono::milliseconds(4), [&] { return stopping; });
    }
    playing_at_s.reset();
    lock.unlock();
    feeder.reset();
    lock.lock();
    has_ended = true;
    changed.notify_all();
  }

  std::optional<SoundFeeder> feeder;  ///< Used by the thread alone.
  mutable std::mutex mutex;
  std::condition_variable changed;
  bool stopping = false, has_ended = false;
  std::deque<std::shared_ptr<const TakenSnapshot>> arrived;
  double low_share = 1.0;
  std::deque<std::string> messages;
  SoundFeeder::Counts counts;
  std::optional<double> playing_at_s;  ///< Time of the thread's newest cycle with a device.
};

LiveSound::LiveSound(SoundFeeder feeder) : state_(std::make_shared<State>(std::move(feeder))) {
  // The thread shares ownership of its state: if the device hangs, it outlives this object.
  std::thread([state = state_] { state->run(); }).detach();
}

LiveSound::~LiveSound() {
  std::unique_lock lock(state_->mutex);
  state_->stopping = true;
  state_->changed.notify_all();
  state_->changed.wait_for(lock, closing_takes_at_most, [&] { return state_->has_ended; });
}

void LiveSound::add(std::shared_ptr<const TakenSnapshot> tick, double low_share) {
  const std::lock_guard lock(state_->mutex);
  state_->low_share = low_share;
  state_->arrived.push_back(std::move(tick));
  if (state_->arrived.size() > most_waiting) state_->arrived.pop_front();
}

std::optional<std::string> LiveSound::take_message() {
  const std::lock_guard lock(state_->mutex);
  if (state_->messages.empty()) return std::nullopt;
  std::string text = std::move(state_->messages.front());
  state_->messages.pop_front();
  return text;
}

SoundFeeder::Counts LiveSound::counts() const {
  const std::lock_guard lock(state_->mutex);
  SoundFeeder::Counts counts = state_->counts;
  if (state_->playing_at_s && State::now_s() - *state_->playing_at_s > stalled_after_s) ++counts.lost;
  return counts;
}

}  // namespace septet::server
