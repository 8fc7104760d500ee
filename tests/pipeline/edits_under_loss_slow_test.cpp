#include <csignal>

#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include <nlohmann/json.hpp>

#include "engine/core/random.hpp"
#include "engine/image/png.hpp"
#include "engine/scene/content_hash.hpp"
#include "logging/session/recorded_scene.hpp"
#include "logging/session/session_reader.hpp"
#include "tests/command-line/what_if/logged_crash.hpp"
#include "tests/pipeline/editing_rig.hpp"
#include "tests/pipeline/random_edits.hpp"

namespace septet::pipeline {
namespace {

constexpr int second_ticks = 120, drive_s = 30, late_from_s = 20;
constexpr int driver_car = 0, other_car = 1;
const std::string seven = "abcdefg";

/// Hashes of a scene, by ticks.
using SceneHashes = std::map<Tick, std::string>;

/// As `septet-screen --scene-hashes` writes them.
SceneHashes read_hashes(const fs::path& file) {
  SceneHashes hashes;
  std::istringstream text(text_of(file));
  Tick tick = 0;
  std::string hash;
  while (text >> tick >> hash) hashes[tick] = hash;
  return hashes;
}

/// Of the server's store, which the log has by ticks, at each whole second.
SceneHashes logged_hashes(const fs::path& log) {
  const auto session = logging::SessionReader::open(log);
  REQUIRE(session.has_value());
  auto recorded = logging::RecordedScene::open(*session);
  REQUIRE(recorded.has_value());
  scene::Store store;
  SceneHashes hashes;
  for (Tick tick = second_ticks; tick <= second_ticks * drive_s; tick += second_ticks) {
    REQUIRE(recorded->advance(tick, store).has_value());
    hashes[tick] = fmt::format("{:016x}", scene::content_hash(store));
  }
  return hashes;
}

/// An editor whose batches go on until shortly before the drive ends: six in a simulated second, each at a tick that it
/// names; of three two at a tick that is compared, or the one after it.
class BusyEditor {
 public:
  BusyEditor(const fs::path& folder, const std::string& name, std::uint64_t seed, int carrier)
      : edits_(name, seed, carrier),
        random_(seed + 100),
        client_(connect_editor(folder)),
        thread_([this] { work(); }) {}
  void wait() { thread_.join(); }
  int done = 0, at_compared = 0;
  std::string end;  ///< Why its last batch was not done; empty: all were.

 private:
  Tick next_after(Tick tick) {
    const Tick next = tick + 12 + random_.below(17), compared = (next / second_ticks + 1) * second_ticks;
    return compared - next < 20 && random_.below(3) != 0 ? compared + random_.below(2) : next;
  }
  void work() {
    for (Tick tick = 1; tick <= Tick{second_ticks} * drive_s;) {
      const auto taken = client_->take(edits_.batch(), tick);
      if (!taken) {
        end = describe(taken.error());
        return;
      }
      ++done;
      at_compared += taken->tick % second_ticks == 0;
      tick = next_after(taken->tick);
    }
  }

  RandomEdits edits_;
  Random random_;
  std::unique_ptr<editor::EditorClient> client_;
  std::jthread thread_;
};

std::map<std::string, std::string> loss(int seed) {
  return {{"LD_PRELOAD", (fs::path(build_folder()) / "septet-lossy.so").string()},
          {"SEPTET_LOST_PER_MILLE", "50"},
          {"SEPTET_LOSS_SEED", std::to_string(seed)}};
}

program::ChildProcess start_hashing_screen(const std::string& name, const std::string& port, const fs::path& keys,
                                           const fs::path& pictures) {
  fs::create_directories(pictures);
  return start("septet-screen",
               {"--name", name, "--server", "127.0.0.1:" + port, "--keys", keys.string(), "--virtual", "--pictures",
                (pictures / name).string(), "--scene-hashes", (pictures / (name + ".hashes")).string()},
               pictures / (name + ".log"));
}

/// How many pictures of a screen differ from the same in another folder; each must be there.
int differing_pictures(const SceneHashes& of, const fs::path& shown, const fs::path& expected) {
  int differing = 0;
  for (const auto& [tick, hash] : of) {
    const auto a = image::read_png(shown / fmt::format("{}.png", tick)),
               b = image::read_png(expected / fmt::format("{}.png", tick));
    CAPTURE(tick);
    CAPTURE(shown);
    REQUIRE(a.has_value());
    REQUIRE(b.has_value());
    differing += a->rgba != b->rgba;
  }
  return differing;
}

}  // namespace

TEST_CASE(
    "two editors' random batches for thirty seconds reach seven screens whole that lose a datagram in twenty each way: "
    "at "
    "every second each mirror equals the store, a late one's too, and each picture that of a screen which loses none") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(7, "transport = \"unicast\""));
  const fs::path keys = make_keys(folder / "keys", seven), pictures = folder / "pictures";
  const fs::path lab = add_editor(keys, "lab"), desk = add_editor(keys, "desk");
  // A straight road and a van that the car does not reach, so that a screen is small.
  write_text(folder / "straight.xodr", server::straight_road());
  write_text(folder / "straight.xosc", server::crash_scenario(580.0));
  auto server = start("septet-server",
                      {"--rig", (folder / "small.toml").string(), "--scenario", (folder / "straight.xosc").string(),
                       "--keys", keys.string(), "--out", (folder / "out").string(), "--lockstep", "--seconds",
                       std::to_string(drive_s), "--any-port"},
                      folder / "server.err", loss(1));
  const std::string port = ready_port(server, folder / "server.err");
  for (const fs::path& editor : {lab, desk}) tell_port(editor, port);
  const auto begun = Clock::now();
  std::map<char, program::ChildProcess> screens;
  for (const char name : seven) screens.emplace(name, start_hashing_screen(std::string(1, name), port, keys, pictures));
  BusyEditor first(lab, "lab", 1, driver_car), second(desk, "desk", 2, other_car);

  // The last screen is lost, and another one comes late in its place.
  REQUIRE(becomes_true([&] { return newest_picture(pictures / "g") >= second_ticks * late_from_s; }));
  screens.at('g').send_signal(SIGKILL);
  CHECK(exit_code(screens.at('g')) == -1);
  screens.erase('g');
  const Tick before = newest_picture(pictures / "a");
  fs::remove(pictures / "g.hashes");
  fs::remove_all(pictures / "g");
  screens.emplace('g', start_hashing_screen("g", port, keys, pictures));

  CHECK(exit_code(server) == 0);
  for (auto& [name, screen] : screens) CHECK(exit_code(screen) == 0);
  const double wall_s = seconds_since(begun);
  first.wait(), second.wait();
  INFO(text_of(folder / "server.err"));
  const std::string said = text_of(folder / "server.err");
  const auto was_left_behind = [&](char name) {
    return said.find(fmt::format("screen {} has not shown tick", name)) != std::string::npos;
  };
  for (const BusyEditor* editor : {&first, &second}) {
    INFO(editor->end);
    CHECK(editor->end.find("nothing of its batch was done") == std::string::npos);
    CHECK(editor->done > drive_s);
    CHECK(editor->at_compared > 0);
  }

  const SceneHashes store = logged_hashes(folder / "out" / "session.sqlite");
  std::set<std::string> distinct;
  for (const auto& [tick, hash] : store) distinct.insert(hash);
  CHECK(distinct.size() > drive_s / 2);
  std::map<char, SceneHashes> mirrors;
  for (const char name : seven) {
    CAPTURE(name);
    mirrors[name] = read_hashes(pictures / (std::string(1, name) + ".hashes"));
    for (const auto& [tick, hash] : mirrors[name]) {
      CAPTURE(tick);
      CHECK(hash == store.at(tick));
    }
    if (name != 'g' && !was_left_behind(name)) CHECK(mirrors[name].size() == drive_s);
  }
  REQUIRE_FALSE(mirrors['g'].empty());
  const Tick first_of_late = mirrors['g'].begin()->first;
  CHECK(first_of_late >= before);
  if (!was_left_behind('g')) {
    CHECK(first_of_late <= before + second_ticks);
    CHECK(mirrors['g'].size() == drive_s + 1 - first_of_late / second_ticks);
  }

  auto replay = run("septet",
                    {"replay", (folder / "out" / "session.sqlite").string(), "--virtual", "--rig",
                     (folder / "small.toml").string(), "--out", (folder / "shown").string()},
                    folder / "shown.err");
  INFO(replay.error);
  REQUIRE(replay.code == 0);
  int differing = 0;
  for (const auto& [name, hashes] : mirrors)
    differing += differing_pictures(hashes, pictures / std::string(1, name),
                                    folder / "shown" / "screens" / std::string(1, name));
  CHECK(differing == 0);

  const auto summary = nlohmann::json::parse(text_of(folder / "out" / "summary.json"));
  for (const auto& screen : summary.at("screens"))
    CHECK(screen.at("datagrams_lost").get<int>() + screen.at("datagrams_repaired").get<int>() > 0);
  MESSAGE(first.done << " and " << second.done << " batches; the late screen's first whole second is " << first_of_late
                     << ", the others had shown " << before << "; " << wall_s << " s");
}

}  // namespace septet::pipeline
