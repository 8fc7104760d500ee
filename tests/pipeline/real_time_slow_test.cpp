#include <atomic>
#include <thread>

#include "logging/session/recorded_scene.hpp"
#include "logging/session/session_reader.hpp"
#include "tests/pipeline/process_rig.hpp"
#include "tests/pipeline/x_display.hpp"
#include "tests/why_not.hpp"

namespace septet::pipeline {
namespace {

/// Occupies the processors, until it is destroyed.
class BusyMachine {
 public:
  explicit BusyMachine(int loops) {
    for (int i = 0; i < loops; ++i)
      threads_.emplace_back([this] {
        while (!over_) ++turns_;
      });
  }
  ~BusyMachine() { over_ = true; }

 private:
  std::atomic<bool> over_{false};
  std::atomic<long> turns_{0};
  std::vector<std::jthread> threads_;
};

}  // namespace

TEST_CASE(
    "a real-time drive in a window on a busy machine logs its whole world so that it is verified and shown and "
    "filmed") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(1));
  const fs::path rig = folder / "small.toml", out = folder / "out", session = out / "session.sqlite";
  Ended driven;
  {
    const BusyMachine busy(4);
    driven = run("septet", {"drive", "--seconds", "3", "--rig", rig.string(), "--out", out.string()}, folder / "err",
                 display.environment());
  }
  INFO(driven.error);
  REQUIRE(driven.code == 0);
  {
    const auto log = logging::SessionReader::open(session);
    REQUIRE(log.has_value());
    CHECK(log->ended_cleanly());
    scene::Store world;
    const auto restored = logging::restore_scene(*log, world);
    INFO(why_not(restored));
    CHECK(restored.has_value());
    CHECK(log->scene_edits().value().size() > 50'000);  // Ten kilometres of motorway.
    auto snapshots = log->snapshots().value();
    for (Tick tick = 0; tick <= 360; ++tick) {
      const auto snapshot = snapshots.next().value();
      REQUIRE(snapshot.has_value());
      REQUIRE(snapshot->tick == tick);
    }
    const auto inputs = log->inputs().value();
    REQUIRE(inputs.size() == 360);
    CHECK(inputs.front().tick == 1);
    const auto events = log->events();
    REQUIRE(events.has_value());
    for (const auto& event : *events) CHECK(event.kind != "log_gap");
  }
  const Ended verified = run("septet", {"replay", "--verify", session.string()}, folder / "verify.err");
  CHECK_MESSAGE(verified.code == 0, verified.error);
  const Ended shown = run("septet",
                          {"replay", session.string(), "--virtual", "--seconds", "0.2", "--rig", rig.string(), "--out",
                           (folder / "shown").string()},
                          folder / "shown.err");
  CHECK_MESSAGE(shown.code == 0, shown.error);
  CHECK(fs::exists(folder / "shown" / "panorama.png"));
  write_text(folder / "shots.toml", "[[shot]]\nfrom_s = 2\nto_s = 2.04\n");
  const Ended filmed = run("septet",
                           {"film", session.string(), "--shots", (folder / "shots.toml").string(), "--size", "160x120",
                            "--software", "--out", (folder / "film").string()},
                           folder / "film.err");
  CHECK_MESSAGE(filmed.code == 0, filmed.error);
  CHECK(fs::exists(folder / "film" / "000001.png"));
}

}  // namespace septet::pipeline
