#include <csignal>

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "sim-client/frame/playout.hpp"
#include "tests/pipeline/observer.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

/// Counts the frames that a screen shows in time: those for whose instant it has the ticks when their turn comes, and
/// that show the world half a frame further on at least: one that goes slowly shows fewer. What the screen is not asked
/// for in time, since no processor was given to it, it loses.
class FrameCount {
 public:
  explicit FrameCount(Observer& observer) : observer_(observer) {}

  void look() {
    const double now_s = Observer::now_s();
    auto& link = observer_.link();
    link.pump(now_s);
    const auto server_s = link.server_time_s(now_s);
    if (!server_s || !link.welcome() || link.history().empty()) return;
    const auto number = frame::frame_number(*server_s);
    if (std::exchange(number_, number) == number) return;
    const double instant_s = *frame::playout_time_s(link.history(), number);
    if (instant_s < counted_s_ + 0.5 / frame::frame_rate_hz) return;
    if (!frame::show(link.history(), instant_s, 1.0 / link.welcome()->tick_rate_hz).on_tick) return;
    counted_s_ = instant_s;
    ++shown_;
  }
  int shown() const { return shown_; }

 private:
  Observer& observer_;
  std::int64_t number_ = 0;
  double counted_s_ = 0.0;  ///< Time shown by the last counted frame.
  int shown_ = 0;
};

enum class Fault { killed, hung, slow };

/// The signal that a screen gets again and again while a fault lasts. A slow one runs for a tenth of the time.
int signal_of(Fault fault, double since_s) {
  if (fault == Fault::killed) return SIGKILL;
  return fault == Fault::slow && std::fmod(since_s, 0.05) < 0.005 ? SIGCONT : SIGSTOP;
}

/// Length of a fault, and of the calm before it. Shorter than the server's time to notice a lost screen.
constexpr double window_s = 1.5;
constexpr int least_frames = 12;         ///< Of 90 in a calm: not reached by a machine that is too busy.
constexpr double accepted_share = 0.15;  ///< Of the frames in the calm before, that may be lost.
constexpr std::size_t least_faults = 3, most_faults = 15;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// A server, its screen a, which has the faults, and b, which is the test's own.
class RealTimeRig {
 public:
  RealTimeRig() {
    write_text(folder_ / "small.toml", small_rig(2));
    make_keys(keys_, "ab");
    server_.emplace(start("septet-server",
                          {"--rig", (folder_ / "small.toml").string(), "--keys", keys_.string(), "--out",
                           (folder_ / "out").string(), "--wait-for-screens", "0", "--any-port"},
                          folder_ / "server.err"));
    port_ = ready_port(*server_, folder_ / "server.err");
    b_.emplace("b", port_, *net::load_identity(keys_ / "b.key"), keys_);
    frames_.emplace(*b_);
    start_a();
    REQUIRE(until([&] { return frames_->shown() > 0; }));
  }

  /// The share of its frames that b loses while a has a fault: of as many as it showed in as long a time before.
  double lost_share(Fault fault) {
    const int calm = calm_frames();
    const auto struck = Clock::now();
    const int before = frames_->shown();
    until([&] {
      a_->send_signal(signal_of(fault, seconds_since(struck)));
      return seconds_since(struck) >= window_s;
    });
    const int shown = frames_->shown() - before;
    restore_a(fault);
    return 1.0 - static_cast<double>(shown) / calm;
  }

  /// Ends the drive in order.
  nlohmann::json summary() {
    server_->send_signal(SIGTERM);
    // Until the server has gone it waits for its screens' reports.
    REQUIRE(until([&] { return server_->poll().has_value(); }));
    return nlohmann::json::parse(text_of(folder_ / "out" / "summary.json"));
  }

 private:
  /// Of a window in which the machine has time for frames.
  int calm_frames() {
    const auto asked = Clock::now();
    int frames = 0;
    do {
      REQUIRE(Clock::now() - asked < patience);
      const auto begun = Clock::now();
      const int before = frames_->shown();
      until([&] { return seconds_since(begun) >= window_s; });
      frames = frames_->shown() - before;
    } while (frames < least_frames);
    return frames;
  }
  /// Looks a thousand times a second until the condition holds.
  bool until(const std::function<bool()>& condition) {
    const auto end = Clock::now() + patience;
    while (!condition()) {
      if (Clock::now() > end) return false;
      frames_->look();
      std::this_thread::sleep_for(1ms);
    }
    return true;
  }
  long a_shows() const { return newest_picture(pictures_ / "a"); }
  void start_a() {
    fs::remove_all(pictures_ / "a");
    a_.emplace(start_screen("a", port_, keys_, pictures_));
    REQUIRE(until([&] { return a_shows() > 0; }));
  }
  /// Until it draws again.
  void restore_a(Fault fault) {
    if (fault == Fault::killed) {
      REQUIRE(until([&] { return a_->poll().has_value(); }));
      return start_a();
    }
    const long before = a_shows();
    a_->send_signal(SIGCONT);
    REQUIRE(until([&] { return a_shows() > before; }));
  }

  TemporaryFolder folder_;
  fs::path keys_ = folder_ / "keys", pictures_ = folder_ / "pictures";
  std::string port_;
  std::optional<program::ChildProcess> server_, a_;
  std::optional<Observer> b_;
  std::optional<FrameCount> frames_;
};

}  // namespace

/// Other load costs frames before a fault as well as during it, in varying amounts: the median over enough faults is
/// zero, or a gain, since a screen that does not draw leaves its processor to the others. A server that waits for the
/// screen fails with any number.
TEST_CASE("in real time a screen that is killed or hangs or is slow costs the others no frame") {
  RealTimeRig rig;
  struct Kind {
    Fault fault;
    std::string name;
  };
  for (const Kind& kind : {Kind{Fault::killed, "killed"}, Kind{Fault::hung, "hung"}, Kind{Fault::slow, "slow"}}) {
    std::vector<double> lost;
    do {
      lost.push_back(rig.lost_share(kind.fault));
    } while (lost.size() < least_faults || (median(lost) > accepted_share && lost.size() < most_faults));
    MESSAGE("a screen that is ", kind.name, " costs another ", 100.0 * median(lost), " % of its frames, the median of ",
            lost.size(), " times");
    CHECK(median(lost) <= accepted_share);
  }
  const auto summary = rig.summary();
  INFO(summary.dump());
  CHECK(summary.at("screens").at(0).at("connected_s").size() > least_faults);
}

}  // namespace septet::pipeline
