#include <csignal>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command.hpp"
#include "sim-server/attendants/edit_turns.hpp"
#include "tests/pipeline/editing_rig.hpp"

namespace septet::pipeline {
namespace {

using scene::Command;
using scene::NodeId;

/// Of the server, in MiB, by a line of its status: "VmRSS:" now, "VmHWM:" at most so far.
double resident_mib(const EditedDrive& drive, const std::string& line) {
  std::istringstream status(text_of(fmt::format("/proc/{}/status", drive.server->process_id())));
  double kib = 0.0;
  for (std::string word; status >> word;)
    if (word == line) status >> kib;
  return kib / 1024.0;
}

/// An editor that says whatever it likes, without the lines' own checks.
class BareEditor {
 public:
  BareEditor(const fs::path& folder, const std::string& name, const std::string& port, const fs::path& keys)
      : observer_(name, port, *net::load_identity(folder / (name + ".key")), keys) {
    REQUIRE(observer_.watch([&] { return observer_.link().scene_arrived() && first_id() != 0; }));
  }
  NodeId first_id() { return observer_.link().replication().own_ids(); }
  const scene::Store& scene() { return observer_.link().scene(); }
  bool is_connected() { return observer_.link().state() == net::ClientState::connected; }
  Tick newest_tick() const { return observer_.newest_tick(); }

  void ask(const std::vector<Command>& batch) {
    REQUIRE(observer_.link().replication().request_batch(batch).has_value());
    ++asked;
  }
  void pump() {
    observer_.link().pump(Observer::now_s());
    auto& replication = observer_.link().replication();
    for (const auto& answer : replication.take_done()) {
      ++done;
      done_ticks.push_back(answer.tick);
    }
    for (auto& refusal : replication.take_refusals()) {
      ++refused;
      if (reasons.size() < 2) reasons.insert(refusal.refusal.failures.front().why);
    }
  }
  bool is_answered() const { return done + refused == asked; }

  std::size_t asked = 0, done = 0, refused = 0;
  std::set<std::string> reasons;
  std::vector<Tick> done_ticks;  ///< Of its batches that were done, in their order.

 private:
  Observer observer_;
};

/// Asks for one small change after another, each when the one before it is answered.
class PatientEditor {
 public:
  PatientEditor(BareEditor& editor) : editor_(editor), post_(editor.first_id()) {
    editor_.ask({scene::NodeCreate{post_, scene::NodeType::object}, scene::NodeNameSet{post_, "desk/post"}});
  }
  void pump() {
    editor_.pump();
    if (!editor_.is_answered()) return;
    if (asked_) slowest_s = std::max(slowest_s, seconds_since(*asked_));
    if (asked_) most_ticks = std::max(most_ticks, editor_.newest_tick() - asked_at_);
    asked_ = Clock::now();
    asked_at_ = editor_.newest_tick();
    editor_.ask({scene::TransformSet{post_, {{1.0 + static_cast<double>(editor_.asked), 0.0, 0.0}}}});
  }
  double slowest_s = 0.0;  ///< Longest time to an answer.
  Tick most_ticks = 0;     ///< Most ticks to an answer.

 private:
  BareEditor& editor_;
  NodeId post_;
  std::optional<Clock::time_point> asked_;
  Tick asked_at_ = 0;
};

}  // namespace

TEST_CASE(
    "an editor that sends wrong references, a million nodes, huge arrays and a flood is told, and neither fills the "
    "server's memory nor has another editor's change refused") {
  EditedDrive drive;
  BareEditor hostile(drive.lab, "lab", drive.port, drive.keys), friendly(drive.desk, "desk", drive.port, drive.keys);
  PatientEditor patient(friendly);
  const NodeId own = hostile.first_id();
  const auto until_answered = [&] {
    REQUIRE(becomes_true([&] {
      hostile.pump();
      patient.pump();
      return hostile.is_answered();
    }));
  };
  const auto phase = [&](const std::string& name, const std::function<void()>& attack) {
    const double before_mib = resident_mib(drive, "VmRSS:");
    const std::size_t asked = hostile.asked, done = hostile.done;
    hostile.reasons.clear();
    hostile.done_ticks.clear();
    patient.slowest_s = 0.0;
    patient.most_ticks = 0;
    const auto begun = Clock::now();
    const Tick from = friendly.newest_tick();
    attack();
    until_answered();
    std::string reasons;
    for (const auto& reason : hostile.reasons) reasons += "\n  " + reason;
    MESSAGE(name << ": " << hostile.asked - asked << " batches in " << seconds_since(begun) << " s and "
                 << friendly.newest_tick() - from << " ticks, " << hostile.done - done << " done; server " << before_mib
                 << " -> " << resident_mib(drive, "VmRSS:") << " MiB; the other editor's slowest answer "
                 << 1e3 * patient.slowest_s << " ms, " << patient.most_ticks << " ticks" << reasons);
    CHECK(hostile.is_connected());
  };
  phase("nothing", [&] {
    const auto end = Clock::now() + 2s;
    becomes_true([&] {
      patient.pump();
      hostile.pump();
      return Clock::now() > end;
    });
  });
  const double before_mib = resident_mib(drive, "VmRSS:");
  constexpr std::size_t flood_changes = 4000;

  phase("a batch of a hundred thousand changes", [&] {
    const std::size_t refused = hostile.refused;
    // Of what a batch's 2 MiB hold.
    hostile.ask(std::vector<Command>(100'000, scene::HideSet{own, true}));
    until_answered();
    CHECK(hostile.refused == refused + 1);
    REQUIRE(hostile.reasons.size() == 1);
    CHECK(hostile.reasons.begin()->find("more than 4096 changes") != std::string::npos);
  });
  phase("wrong references", [&] {
    hostile.ask({scene::HideSet{4'000'000'000U, true}});
    hostile.ask(
        {scene::NodeCreate{own, scene::NodeType::object}, scene::LinkSet{own, 0, {"child", 4'000'000'000U, 0}}});
    hostile.ask({scene::NodeCreate{own, scene::NodeType::object}, scene::LinkSet{own, 0, {"child", own, 0}}});
    until_answered();
    CHECK(hostile.refused >= 2);
  });
  phase("a million nodes", [&] {
    constexpr NodeId nodes = 1'000'000, at_once = replication::most_changes_of_batch;
    for (NodeId first = 1; first < nodes; first += at_once) {
      std::vector<Command> batch;
      for (NodeId i = 0; i < at_once; ++i)
        batch.emplace_back(scene::NodeCreate{own + first + i, scene::NodeType::object});
      hostile.ask(batch);
    }
    until_answered();
    CHECK(hostile.refused > 200);
  });
  phase("huge arrays", [&] {
    const std::size_t refused = hostile.refused;
    // Of ids that the nodes before have left over.
    for (NodeId i = 0; i < 40; ++i) {
      const NodeId node = own + 65'000 + i;
      hostile.ask(
          {scene::NodeCreate{node, scene::NodeType::geometry}, scene::GeometrySizeSet{node, 1U << 22, 1U << 22}});
      until_answered();
    }
    CHECK(hostile.refused > refused);
  });
  phase("a flood", [&] {
    const std::vector<Command> batch(flood_changes, scene::TransformSet{own + 1, {{1.0, 2.0, 3.0}}});
    const auto begun = Clock::now();
    const Tick from = friendly.newest_tick();
    std::size_t sent = 0;
    REQUIRE(becomes_true([&] {
      // A hundred thousand commands a second, whatever is answered.
      for (; static_cast<double>(sent) < 25.0 * seconds_since(begun) && sent < 125; ++sent) hostile.ask(batch);
      hostile.pump();
      patient.pump();
      return sent == 125;
    }));
    MESSAGE("while it is sent: " << friendly.newest_tick() - from << " ticks in " << seconds_since(begun)
                                 << " s; the other editor's slowest answer " << 1e3 * patient.slowest_s << " ms, "
                                 << patient.most_ticks << " ticks");
  });
  // Each batch owes what its commands take of the ticks after it, however fast they are.
  constexpr Tick least_between = flood_changes / server::most_edit_work_a_tick;
  REQUIRE(hostile.done_ticks.size() > 1);
  for (std::size_t i = 1; i < hostile.done_ticks.size(); ++i)
    CHECK(hostile.done_ticks[i] >= hostile.done_ticks[i - 1] + least_between);
  CHECK(friendly.refused == 0);
  CHECK(resident_mib(drive, "VmHWM:") < before_mib + 2048.0);
  MESSAGE("the server had " << before_mib << " MiB before and " << resident_mib(drive, "VmHWM:") << " MiB at most");
}

TEST_CASE("of the batches of an editor that is killed at any moment each is there whole or not at all") {
  constexpr int things = 200, batches = 400, kills = 6;
  EditedDrive drive;
  BareEditor watcher(drive.desk, "desk", drive.port, drive.keys);
  Random random(11);
  int seen = 0, torn = 0, killed_within = 0;
  for (int kill = 0; kill < kills; ++kill) {
    // Each batch puts all things to the place that has its number.
    std::string lines = "begin\n";
    for (int i = 0; i < things; ++i) lines += fmt::format("create lab/{}/{} 0 0 0\n", kill, i);
    lines += "commit\n";
    for (int batch = 1; batch <= batches; ++batch) {
      lines += "begin\n";
      for (int i = 0; i < things; ++i) lines += fmt::format("move lab/{}/{} {} {} 0\n", kill, i, batch, 7 * batch + i);
      lines += "commit\n";
    }
    const fs::path file = drive.folder / "lines";
    write_text(file, lines);
    auto editor = start("septet", {"edit", "--keys", drive.lab.string(), file.string()}, drive.folder / "edit.err");
    const std::string first = fmt::format("lab/{}/0", kill);
    const auto last_batch = [&]() -> int {
      const scene::Node* node = watcher.scene().find(scene::NodeType::object, first);
      return node == nullptr ? -1 : static_cast<int>(std::get<scene::ObjectData>(node->data).transform.position_m.x);
    };
    const auto look = [&] {
      watcher.pump();
      std::set<double> places;
      std::size_t found = 0;
      for (const auto& [id, node] : watcher.scene().nodes()) {
        if (!node.name.starts_with(fmt::format("lab/{}/", kill))) continue;
        ++found;
        places.insert(std::get<scene::ObjectData>(node.data).transform.position_m.x);
      }
      ++seen;
      torn += places.size() > 1 || (found != 0 && found != things);
    };
    const int until = 3 + static_cast<int>(random.below(30));
    REQUIRE(becomes_true([&] {
      look();
      return last_batch() >= until || editor.poll().has_value();
    }));
    std::this_thread::sleep_for(std::chrono::microseconds(random.below(12'000)));
    killed_within += !editor.poll().has_value();
    editor.send_signal(SIGKILL);
    CHECK(exit_code(editor) == -1);
    const Tick from = watcher.newest_tick();
    REQUIRE(becomes_true([&] {
      look();
      return watcher.newest_tick() > from + 60;
    }));
  }
  MESSAGE(seen << " looks, " << torn << " of them torn; " << killed_within << " editors killed");
  CHECK(killed_within == kills);
  CHECK(torn == 0);
  CHECK_FALSE(drive.server->poll().has_value());
}

}  // namespace septet::pipeline
