/// The loop and its attendants, without screens.

#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "sim-server/host/serve.hpp"

namespace septet::server {
namespace {

class Ticks final : public TickSource {
 public:
  explicit Ticks(Tick first = 0) : tick_(first), first_(first) {}
  Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>&) override {
    Snapshot snapshot;
    snapshot.tick = ++tick_;
    snapshot.simulated_time_s = static_cast<double>(tick_) / tick_rate_hz();
    return std::make_shared<const TakenSnapshot>(std::move(snapshot));
  }
  logging::DriveEnd end() const override { return logging::DriveEnd::failed; }
  double tick_rate_hz() const override { return 120.0; }
  std::vector<std::string> take_messages() override {
    return tick_ == first_ + 1 && !std::exchange(has_said_, true) ? std::vector<std::string>{"of the source"}
                                                                  : std::vector<std::string>{};
  }

 private:
  Tick tick_, first_;
  bool has_said_ = false;
};

class StillClock final : public ServeClock {
 public:
  double now_s() const override { return 0.0; }
  void wait(double) override {}
};

/// Writes down all that it is told.
class Diary final : public Attendant {
 public:
  Diary(std::string name, std::vector<std::string>& lines) : name_(std::move(name)), lines_(lines) {}
  void before_tick(const Moment& moment) override {
    lines_.push_back(name_ + (moment.newest ? " before the next" : " before the first"));
  }
  Wishes wishes() override { return wishes_; }
  void after_tick(const std::shared_ptr<const TakenSnapshot>&, double) override { lines_.push_back(name_ + " after"); }
  std::vector<std::string> take_messages() override { return std::exchange(says_, {}); }
  void show(const Progress& progress) override { progress_ = progress; }
  void hear(const Message& message) override {
    lines_.push_back(name_ + " hears " + message.text + (message.is_logged ? ", logged" : ""));
  }

  Wishes wishes_;
  std::vector<std::string> says_;
  Progress progress_;

 private:
  std::string name_;
  std::vector<std::string>& lines_;
};

}  // namespace

TEST_CASE("attendants are called in the order of their list, and all hear the messages of each and of the source") {
  std::vector<std::string> lines;
  auto first = std::make_unique<Diary>("A", lines), second = std::make_unique<Diary>("B", lines);
  second->says_ = {"hello"};
  Attendants attendants;
  attendants.push_back(std::move(first));
  attendants.push_back(std::move(second));
  Ticks ticks;
  StillClock clock;
  CHECK(run_headless(ticks, 1, attendants, clock).end == logging::DriveEnd::time_over);
  CHECK(lines == std::vector<std::string>{"A before the first", "B before the first", "A hears hello", "B hears hello",
                                          "A hears of the source, logged", "B hears of the source, logged", "A after",
                                          "B after", "A before the next", "B before the next"});
}

TEST_CASE("the first end in the attendants' order holds") {
  std::vector<std::string> lines;
  Attendants attendants;
  for (const auto end : {std::optional<logging::DriveEnd>(), std::optional(logging::DriveEnd::interrupted),
                         std::optional(logging::DriveEnd::by_operator)}) {
    auto attendant = std::make_unique<Diary>("", lines);
    attendant->wishes_.end = end;
    attendants.push_back(std::move(attendant));
  }
  Ticks ticks;
  StillClock clock;
  const auto result = run_headless(ticks, 5, attendants, clock);
  CHECK(result.end == logging::DriveEnd::interrupted);
  CHECK(result.ticks == 0);
}

TEST_CASE("the progress of a drive that begins later is in its simulated time, and so is its end") {
  std::vector<std::string> lines;
  for (const Tick first : {0, 1200}) {
    Attendants attendants;
    attendants.push_back(std::make_unique<Diary>("", lines));
    const auto& progress = static_cast<const Diary&>(*attendants.front()).progress_;
    Ticks ticks(first);
    StillClock clock;
    CHECK(run_headless(ticks, 240, attendants, clock).ticks == 240);
    const double begun_s = static_cast<double>(first) / 120.0;
    CHECK(progress.simulated_s == doctest::Approx(begun_s + 2.0));
    CHECK(progress.total_s == doctest::Approx(begun_s + 2.0));
  }
}

}  // namespace septet::server
