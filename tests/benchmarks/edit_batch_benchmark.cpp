// What an editor's batch costs the tick that does it: its message's bytes to commands, the gate (rights, the change, its inverse), and the word to seven screens. The
// world is the motorway's. Processor time. Counters: microseconds a command, and the share of a tick.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <benchmark/benchmark.h>

#include "engine/core/bytes.hpp"
#include "engine/replication/message.hpp"
#include "engine/replication/replication_client.hpp"
#include "engine/replication/replication_server.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/simulation/server_step.hpp"
#include "program/resources.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/world_gate.hpp"
#include "tests/benchmarks/must_be.hpp"

namespace septet::server {
namespace {

using replication::ConnectionId;
using replication::ReplicationClient;
using replication::ReplicationServer;
using scene::Command;
using scene::NodeId;

LoadedDrive drive_of_the_motorway() {
  const auto scenario = must_be(program::find_resource("behind-ambulance", "scenarios", ".xosc"));
  const auto rig = must_be(program::find_resource("desktop", "rigs", ".toml"));
  return must_be(load_drive(DriveFiles{scenario.string(), rig.string(), 1}));
}

/// A gate, seven screens that have everything, and the editor's connection.
struct EditedWorld {
  static constexpr ConnectionId editor = 100;
  static constexpr int screen_count = 7;
  OpenedDrive opened{.loaded = drive_of_the_motorway(), .store = scene::Store()};
  std::unique_ptr<LiveDrive> live;
  std::optional<WorldGate> gate;
  std::optional<ReplicationServer> server;
  std::deque<ReplicationClient> screens;
  NodeId own_ids = 0;

  EditedWorld() {
    scene::SceneBuilder builder(opened.store);
    scenery::build_road_world(builder, opened.loaded.model->roads, 1);
    const auto& model = opened.loaded.model;
    live = must_be(LiveDrive::start(model, traffic::own_traffic(model->roads, 1), {}));
    opened.live = live.get();
    server.emplace(opened.store, 1);
    gate.emplace(opened);
    gate->tell([this](const Command& command, Tick from) { server->applied(command, from); });
    gate->begin();
    for (int i = 0; i < screen_count; ++i) {
      screens.emplace_back().connected();
      server->connect(static_cast<ConnectionId>(i), "screen");
    }
    for (int rounds = 0; rounds < 10'000 && !all_complete(); ++rounds) pump_screens();
    if (!all_complete()) throw std::runtime_error("the screens have no scene");
    server->connect(editor, "lab");
    const auto hello = server->receive(editor, replication::encode(replication::Hello{}));
    if (!hello) throw std::runtime_error(describe(hello.error()));
    own_ids = server->own_ids(editor);
  }
  bool all_complete() {
    for (ReplicationClient& screen : screens)
      if (!screen.complete() || screen.complete_revision() != opened.store.revision()) return false;
    return true;
  }
  void pump_screens() {
    for (std::size_t i = 0; i < screens.size(); ++i) {
      const auto id = static_cast<ConnectionId>(i);
      screens[i].pump([&](std::span<const std::byte> message) { return server->receive(id, message).has_value(); });
      server->pump(id, 1u << 20,
                   [&](std::span<const std::byte> message) { return screens[i].receive(message).has_value(); });
    }
  }
};

/// Of this thread, in s.
double processor_s() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// `refused`: one of more changes than a batch may have, as the server takes it; the others are read and done whatever their size.
enum class Kind { moves, creates, refused };

std::vector<Command> read_whole(const Bytes& message) {
  const auto decoded = must_be(replication::decode(message));
  ByteReader in(std::get<replication::CommandBatch>(decoded).commands);
  std::vector<Command> commands;
  while (!in.at_end()) commands.push_back(must_be(scene::decode(in)));
  return commands;
}

std::vector<Command> batch_of(const EditedWorld& world, Kind kind, std::size_t commands, std::size_t round) {
  std::vector<Command> batch;
  batch.reserve(commands);
  const auto node = [&](std::size_t i) { return world.own_ids + static_cast<NodeId>(i); };
  if (kind != Kind::creates) {
    for (std::size_t i = 0; i < commands; ++i)
      batch.emplace_back(scene::TransformSet{node(i % 1000), {{0.5 * static_cast<double>(i + round), 1.0, 2.0}}});
    return batch;
  }
  const std::size_t first = 1000 + round * commands;
  for (std::size_t i = 0; batch.size() + 1 < commands; ++i) {
    batch.emplace_back(scene::NodeCreate{node(first + i), scene::NodeType::object});
    batch.emplace_back(scene::NodeNameSet{node(first + i), "lab/thing/" + std::to_string(i)});
  }
  return batch;
}

void edit_batch(benchmark::State& state, Kind kind) {
  static EditedWorld world;
  const Editor lab{"lab", {}, world.own_ids};
  static bool has_things = false;
  if (!std::exchange(has_things, true)) {
    std::vector<Command> things;
    for (NodeId i = 0; i < 1000; ++i)
      things.emplace_back(scene::NodeCreate{world.own_ids + i, scene::NodeType::object});
    if (world.gate->make(lab, things, 1)) throw std::runtime_error("the things are refused");
    for (int rounds = 0; rounds < 1000 && !world.all_complete(); ++rounds) world.pump_screens();
  }
  static std::uint64_t sequence = 0;
  const auto commands = static_cast<std::size_t>(state.range(0));
  std::size_t round = 0, done = 0;
  double seconds = 0.0, worst_s = 0.0;
  for (auto unused : state) {
    const std::vector<Command> asked = batch_of(world, kind, commands, round++);
    Bytes bytes;
    for (const Command& command : asked) scene::encode(command, bytes);
    if (kind == Kind::refused) ++sequence;
    const Bytes message = replication::encode(replication::CommandBatch{sequence, 0, bytes});
    const double begun_s = processor_s();
    std::vector<Command> read;
    if (kind == Kind::refused)
      read = must_be(world.server->receive(EditedWorld::editor, message)).changes;
    else
      read = read_whole(message);
    if (kind != Kind::refused && !world.gate->make(lab, std::move(read), 1)) done += asked.size();
    const double took_s = processor_s() - begun_s;
    state.SetIterationTime(took_s);
    seconds += took_s, worst_s = std::max(worst_s, took_s);
    if (kind == Kind::creates) {
      std::vector<Command> gone;
      for (const Command& command : asked)
        if (const auto* create = std::get_if<scene::NodeCreate>(&command))
          gone.emplace_back(scene::NodeDestroy{create->node});
      (void)world.gate->make(lab, gone, 1, false);
      round = 0;
    }
    for (int rounds = 0; rounds < 1000 && !world.all_complete(); ++rounds) world.pump_screens();
  }
  const auto asked = static_cast<double>(commands * state.iterations());
  state.counters["us_a_command"] = 1e6 * seconds / asked;
  state.counters["done"] = static_cast<double>(done) / asked;
  state.counters["worst_share_of_tick"] = worst_s / simulation::tick_s;
}

void batches(benchmark::internal::Benchmark* each) {
  for (const int commands : {256, 1024, 4096, 16384, 50000}) each->Arg(commands);
  each->Iterations(8)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(edit_batch, moves, Kind::moves)->Name("edit_batch/moves")->Apply(batches);
BENCHMARK_CAPTURE(edit_batch, creates, Kind::creates)->Name("edit_batch/creates")->Apply(batches);
BENCHMARK_CAPTURE(edit_batch, refused, Kind::refused)
    ->Name("edit_batch/refused")
    ->Arg(50000)
    ->Iterations(8)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace septet::server
