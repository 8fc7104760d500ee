#include "sim-server/drive/scene_gate.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/control/control_message.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/net/udp_socket.hpp"
#include "engine/replication/message.hpp"
#include "engine/replication/replication_client.hpp"
#include "engine/scene/builder.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {
namespace {

using scene::Command;
using scene::NodeId;

net::UdpSocket socket_here() { return *net::UdpSocket::open({.bind = {net::loopback_ip, 0}}); }

/// A client of the scene lane that no rig knows: a key and a mirror.
struct Client {
  net::Identity identity = net::Identity::generate();
  net::UdpSocket socket = socket_here();
  net::SecureClient lane;
  replication::ReplicationClient scene;

  Client(const net::Address& server, const net::PublicKey& key, const net::Identity& own)
      : identity(own), lane(socket, {server, key, identity, {}}) {}
  void pump(double now_s) {
    for (const net::ClientEvent& event : lane.pump(now_s)) {
      if (event.kind == net::ClientEvent::Kind::connected) scene.connected();
      if (event.kind == net::ClientEvent::Kind::lost) scene.disconnected();
      if (event.kind == net::ClientEvent::Kind::message && control::lane_of(event.bytes) == control::LaneMessage::scene)
        REQUIRE(scene.receive(std::span(event.bytes).subspan(1)).has_value());
    }
    if (lane.state() == net::ClientState::connected)
      scene.pump([&](std::span<const std::byte> message) {
        return lane.send(control::scene_message(message), net::Reliability::reliable) == net::SendResult::queued;
      });
  }
};

/// A host with its store, and the gate between two pumps, over real sockets.
struct Stage {
  scene::Store store;
  scene::SceneBuilder build{store};
  NodeId tree = build.add_object("tree", {});
  net::Identity server = net::Identity::generate(), editor_key = net::Identity::generate(),
                looker_key = net::Identity::generate();
  net::UdpSocket lane = socket_here(), ticks = socket_here();
  ScreenHost host{
      lane,
      ticks,
      store,
      {.identity = server,
       .allowed = {{editor_key.public_key(), "lab", {true, net::EditRights{}}}, {looker_key.public_key(), "guest"}},
       .screens = {"screen"}}};
  Client editor{lane.local_address(), server.public_key(), editor_key},
      looker{lane.local_address(), server.public_key(), looker_key};
  NodeMakers makers;
  std::vector<Command> logged;
  std::vector<std::string> told;
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();

  void step() {
    const double now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    host.pump(now_s);
    for (const SceneRequest& request : host.take_scene_requests()) {
      auto refused = pass_gate(store, request.batch.changes, request.editor, makers,
                               [&](const Command& command) { host.scene_changed(command, 0); });
      if (refused)
        host.refuse_scene(request, std::move(*refused), now_s);
      else
        logged.insert(logged.end(), request.batch.changes.begin(), request.batch.changes.end()),
            host.scene_done(request, 7);
    }
    for (auto& text : host.take_messages()) told.push_back(std::move(text));
    editor.pump(now_s), looker.pump(now_s);
  }
  bool until(const std::function<bool()>& holds) {
    for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
         std::chrono::steady_clock::now() < end;) {
      step();
      if (holds()) return true;
    }
    return false;
  }
  bool all_equal() {
    return until([&] {
      return editor.scene.complete() && looker.scene.complete() && scene::same_content(editor.scene.store(), store) &&
             scene::same_content(looker.scene.store(), store);
    });
  }
};

}  // namespace

TEST_CASE("an editor creates and fills a node in one batch and all mirrors have it") {
  Stage stage;
  REQUIRE(stage.all_equal());
  const NodeId own = stage.editor.scene.own_ids();
  const std::vector<Command> batch = {scene::NodeCreate{own, scene::NodeType::object}, scene::NodeNameSet{own, "deer"},
                                      scene::TransformSet{own, {{40.0, 2.0, 0.0}}}, scene::HideSet{stage.tree, true}};
  REQUIRE(stage.editor.scene.request_batch(batch).has_value());
  REQUIRE(stage.until([&] { return stage.store.find(own) != nullptr; }));
  REQUIRE(stage.all_equal());
  CHECK(stage.looker.scene.store().find(own)->name == "deer");
  CHECK(stage.logged == batch);
  CHECK(stage.editor.scene.take_refusals().empty());
  const auto done = stage.editor.scene.take_done();
  REQUIRE(done.size() == 1);
  CHECK(done.front().tick == 7);
}

TEST_CASE("of a batch that cannot be done nothing is done and its client is told the command and why") {
  Stage stage;
  REQUIRE(stage.all_equal());
  const NodeId own = stage.editor.scene.own_ids();
  const scene::Store before = stage.store;
  const std::vector<std::vector<Command>> bad = {
      {scene::NodeCreate{own, scene::NodeType::object}, scene::HideSet{stage.tree, true},
       scene::HideSet{own + 7, true}},
      {scene::HideSet{stage.tree, true}, scene::NodeCreate{stage.tree + 1, scene::NodeType::object}},
      {scene::HideSet{stage.tree, true}, scene::NodeCreate{scene::no_node, scene::NodeType::object}}};
  const std::vector<std::pair<std::uint64_t, std::string>> why = {
      {2, "there is no such node"}, {1, "is not one of this editor's ids"}, {1, "is not one of this editor's ids"}};
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto number = stage.editor.scene.request_batch(bad[i]);
    REQUIRE(number.has_value());
    std::vector<replication::Refused> refusals;
    REQUIRE(stage.until([&] { return !(refusals = stage.editor.scene.take_refusals()).empty(); }));
    CHECK(refusals.front().sequence == *number);
    REQUIRE(refusals.front().refusal.failures.size() == 1);
    CHECK(refusals.front().refusal.failures.front().index == why[i].first);
    CHECK(refusals.front().refusal.failures.front().why.find(why[i].second) != std::string::npos);
    CHECK(scene::same_content(stage.store, before));
  }
  CHECK(stage.logged.empty());
  CHECK(stage.told.size() >= 3);
}

TEST_CASE("an editor is told of each command of a refused batch that could not be done, with its node's name") {
  Stage stage;
  REQUIRE(stage.all_equal());
  const NodeId own = stage.editor.scene.own_ids();
  const scene::Store before = stage.store;
  const std::vector<Command> bad = {scene::NodeCreate{own, scene::NodeType::object}, scene::NodeNameSet{own, "deer"},
                                    scene::TagSet{own, 3, 0, {"a", true}}, scene::HideSet{own + 7, true},
                                    scene::TagSet{stage.tree, 9, 0, {"a", true}}};
  REQUIRE(stage.editor.scene.request_batch(bad).has_value());
  std::vector<replication::Refused> refusals;
  REQUIRE(stage.until([&] { return !(refusals = stage.editor.scene.take_refusals()).empty(); }));
  const replication::Refusal& told = refusals.front().refusal;
  REQUIRE(told.failures.size() == 3);
  CHECK(told.others == 0);
  CHECK(told.failures[0].index == 2);
  CHECK(told.failures[0].node == "deer");
  CHECK(told.failures[1].index == 3);
  CHECK(told.failures[1].node == std::to_string(own + 7));
  CHECK(told.failures[2].index == 4);
  CHECK(told.failures[2].node == "tree");
  CHECK(scene::same_content(stage.store, before));
  REQUIRE_FALSE(stage.told.empty());
  CHECK(stage.told.back().find("; 2 more could not be done") != std::string::npos);
}

TEST_CASE("what fails for an earlier failure alone is left out, or told so, and of many failures the first are told") {
  scene::Store store;
  scene::SceneBuilder build(store);
  const NodeId tree = build.add_object("tree/1", {}), sign = build.add_object("sign/1", {});
  NodeMakers makers;
  const Editor lab{"lab", {{"tree/"}, net::all_edit_kinds}, 1000};
  const scene::Store before = store;
  const auto refusal = [&](const std::vector<Command>& batch) {
    auto why = pass_gate(store, batch, lab, makers, [](const Command&) {});
    REQUIRE(why.has_value());
    CHECK(scene::same_content(store, before));
    return *why;
  };
  // Node 900,000 is not of this editor's ids; its name and its place on the tree fail with it, the sign for itself.
  const auto created =
      refusal({scene::NodeCreate{5000, scene::NodeType::object}, scene::NodeCreate{900'000, scene::NodeType::object},
               scene::NodeNameSet{900'000, "tree/5"}, scene::TransformSet{900'000, {}},
               scene::LinkSet{tree, 0, {"child", 900'000, 0}}, scene::HideSet{sign, true}});
  REQUIRE(created.failures.size() == 2);
  CHECK(created.failures[0].index == 1);
  CHECK(created.failures[1].index == 5);
  CHECK(created.failures[1].node == "sign/1");
  CHECK(created.failures[1].why.find("may not hide \"sign/1\"") != std::string::npos);

  const auto twice = refusal({scene::TagSet{tree, 9, 0, {"a", true}}, scene::TagSet{tree, 9, 1, {"a", true}}});
  REQUIRE(twice.failures.size() == 2);
  CHECK(twice.failures[0].why.find("earlier failure") == std::string::npos);
  CHECK(twice.failures[1].why.starts_with("after an earlier failure of this node: "));

  const auto many = refusal(std::vector<Command>(5000, scene::HideSet{sign, true}));
  CHECK(many.failures.size() == replication::most_failures_told);
  CHECK(many.others == 5000 - replication::most_failures_told);
  CHECK(many.failures.back().index == replication::most_failures_told - 1);
  CHECK(makers.empty());
}

TEST_CASE("a key without the right to edit changes nothing and is told the line that it needs") {
  Stage stage;
  REQUIRE(stage.all_equal());
  const scene::Store before = stage.store;
  stage.looker.scene.request(scene::HideSet{stage.tree, true});
  std::vector<replication::Refused> refusals;
  REQUIRE(stage.until([&] { return !(refusals = stage.looker.scene.take_refusals()).empty(); }));
  CHECK(refusals.front().refusal.failures.front().why ==
        "the key of guest may look, not edit: allowed-clients needs `KEY guest edit`");
  CHECK(scene::same_content(stage.store, before));
  CHECK(stage.looker.lane.state() == net::ClientState::connected);
  // The right may be given while the server runs.
  stage.host.set_allowed({{stage.editor_key.public_key(), "lab", {true, net::EditRights{}}},
                          {stage.looker_key.public_key(), "guest", {true, net::EditRights{}}}});
  stage.looker.scene.request(scene::HideSet{stage.tree, true});
  CHECK(stage.until([&] { return !scene::same_content(stage.store, before); }));
}

TEST_CASE("an editor does what the words of its key say and a node belongs to who made it") {
  scene::Store store;
  scene::SceneBuilder build(store);
  const NodeId tree = build.add_object("tree/1", {}), sign = build.add_object("sign/1", {});
  NodeMakers makers;
  const Editor lab{"lab", {{"tree/", "stimuli/"}, net::all_edit_kinds}, 1000},
      hider{"hider", {{}, 1u << static_cast<int>(net::EditKind::hide)}, 100'000}, free{"free", {}, 200'000};
  const auto refused = [&](const Editor& editor, const std::vector<Command>& batch) {
    const auto why = pass_gate(store, batch, editor, makers, [](const Command&) {});
    return why ? why->failures.front().why : std::string();
  };
  CHECK(refused(lab, {scene::HideSet{tree, true}}).empty());
  CHECK(refused(lab, {scene::HideSet{sign, true}}) ==
        "the key of lab may not hide \"sign/1\": its line in allowed-clients needs a prefix of that name");
  CHECK(refused(hider, {scene::HideSet{sign, true}}).empty());
  CHECK(refused(hider, {scene::TransformSet{sign, {}}}) ==
        "the key of hider may not move \"sign/1\": its line in allowed-clients needs the word move");
  CHECK(refused(hider, {scene::NodeCreate{100'000, scene::NodeType::object}}).find("needs the word create") !=
        std::string::npos);
  // Its own nodes have names below its prefixes, and nobody without a prefix of theirs changes them.
  CHECK(refused(lab, {scene::NodeCreate{1000, scene::NodeType::object}, scene::NodeNameSet{1000, "model/hatchback"}})
            .find("no such name") != std::string::npos);
  CHECK(store.find(1000) == nullptr);
  CHECK(refused(lab, {scene::NodeCreate{1000, scene::NodeType::object}, scene::NodeNameSet{1000, "stimuli/ball"},
                      scene::TransformSet{1000, {{1.0, 2.0, 3.0}}}})
            .empty());
  CHECK(refused(free, {scene::TransformSet{1000, {}}}).find("which lab made") != std::string::npos);
  CHECK(refused(free, {scene::NodeDestroy{1000}}).find("may not create") != std::string::npos);
  // Hanging a node on another one moves it.
  CHECK(refused(hider, {scene::LinkSet{tree, 0, {"child", sign, 0}}}).find("may not create") != std::string::npos);
  CHECK(refused(free,
                {scene::NodeCreate{200'000, scene::NodeType::object}, scene::LinkSet{200'000, 0, {"child", 1000, 0}}})
            .find("may not move \"stimuli/ball\", which lab made") != std::string::npos);
  CHECK(refused(free,
                {scene::NodeCreate{200'000, scene::NodeType::object}, scene::LinkSet{200'000, 0, {"child", 1001, 0}}})
            .find("no node 1001") != std::string::npos);
  CHECK(refused(lab, {scene::NodeDestroy{1000}}).empty());
  CHECK(makers.empty());
}

TEST_CASE("a generated thing's parts may be seen once more by a key with prefixes, and what stands by itself may not") {
  scene::Store store;
  scene::SceneBuilder build(store);
  const NodeId model = build.add_object("model/van", {}), body = build.add_object("van/body", {}),
               tree = build.add_object("tree/1", {});
  build.apply(scene::LinkSet{model, 0, {"child", body, 0}});
  NodeMakers makers;
  const Editor lab{"lab", {{"stimuli/"}, net::all_edit_kinds}, 1000};
  const auto refused = [&](NodeId child) {
    const std::vector<Command> batch{scene::NodeCreate{1000, scene::NodeType::object},
                                     scene::NodeNameSet{1000, "stimuli/van"},
                                     scene::LinkSet{1000, 0, {"child", child, 0}}, scene::NodeDestroy{1000}};
    return pass_gate(store, batch, lab, makers, [](const Command&) {}).has_value();
  };
  CHECK_FALSE(refused(body));
  CHECK(refused(tree));
  CHECK(refused(model));
}

TEST_CASE("an editor's own node that is gone already need not be destroyed, and what is left keeps its place") {
  scene::Store store;
  scene::SceneBuilder build(store);
  const NodeId tree = build.add_object("tree/1", {});
  REQUIRE(store.apply(scene::NodeCreate{1001, scene::NodeType::object}).has_value());
  const std::vector<Command> batch = {
      scene::NodeDestroy{1000}, scene::NodeDestroy{1001}, scene::NodeCreate{1002, scene::NodeType::object},
      scene::NodeDestroy{1002}, scene::NodeDestroy{999},  scene::NodeDestroy{tree}};
  const auto left = without_gone(store, batch, 1000);
  REQUIRE(left.has_value());
  CHECK(left->places == std::vector<std::size_t>{1, 2, 3, 4, 5});
  for (std::size_t i = 0; i < left->places.size(); ++i) CHECK(left->commands[i] == batch[left->places[i]]);
  // Who has no ids has no nodes; and a batch of which nothing is gone is done as it is.
  CHECK_FALSE(without_gone(store, batch, 0).has_value());
  CHECK_FALSE(without_gone(store, left->commands, 1000).has_value());
}

TEST_CASE("an editor that floods is refused beyond what waits for one tick and the host keeps its memory") {
  Stage stage;
  REQUIRE(stage.all_equal());
  const std::vector<Command> many(replication::most_changes_of_batch, scene::HideSet{stage.tree, true});
  constexpr std::size_t taken = most_edits / replication::most_changes_of_batch;
  for (std::size_t i = 0; i < taken + 7; ++i) REQUIRE(stage.editor.scene.request_batch(many).has_value());
  std::size_t most = 0, refused = 0;
  // The host is busy: no tick takes the requests.
  for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
       std::chrono::steady_clock::now() < end && refused < 7;) {
    const double now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - stage.begun).count();
    stage.host.pump(now_s);
    stage.editor.pump(now_s);
    refused += stage.editor.scene.take_refusals().size();
  }
  for (const SceneRequest& request : stage.host.take_scene_requests()) most += request.batch.changes.size();
  CHECK(refused == 7);
  CHECK(most == taken * many.size());
}

TEST_CASE("an editor that floods takes no room of another one's") {
  Stage stage;
  stage.host.set_allowed({{stage.editor_key.public_key(), "lab", {true, net::EditRights{}}},
                          {stage.looker_key.public_key(), "guest", {true, net::EditRights{}}}});
  REQUIRE(stage.all_equal());
  const std::vector<Command> many(replication::most_changes_of_batch, scene::HideSet{stage.tree, true});
  constexpr std::size_t taken = most_edits / replication::most_changes_of_batch;
  for (std::size_t i = 0; i < taken + 2; ++i) REQUIRE(stage.editor.scene.request_batch(many).has_value());
  const auto pump = [&] {
    const double now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - stage.begun).count();
    stage.host.pump(now_s), stage.editor.pump(now_s), stage.looker.pump(now_s);
  };
  const auto until_refused = [&](Client& client, std::size_t batches) {
    std::size_t refused = 0;
    for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
         std::chrono::steady_clock::now() < end && refused < batches;) {
      pump();
      refused += client.scene.take_refusals().size();
    }
    return refused;
  };
  REQUIRE(until_refused(stage.editor, 2) == 2);
  // Of the other one there is room for as many.
  for (std::size_t i = 0; i < taken + 1; ++i) REQUIRE(stage.looker.scene.request_batch(many).has_value());
  REQUIRE(until_refused(stage.looker, 1) == 1);
  std::set<std::string> heard;
  for (const SceneRequest& request : stage.host.take_scene_requests()) heard.insert(request.editor.name);
  CHECK(heard == std::set<std::string>{"guest", "lab"});
}

TEST_CASE(
    "a batch of more changes than may be done between two ticks is refused with their number, and no less of it is "
    "done") {
  Stage stage;
  REQUIRE(stage.all_equal());
  const auto answered = [&](std::size_t changes) {
    REQUIRE(
        stage.editor.scene.request_batch(std::vector<Command>(changes, scene::HideSet{stage.tree, true})).has_value());
    std::vector<replication::Refused> refusals;
    std::size_t waiting = 0;
    for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
         std::chrono::steady_clock::now() < end && refusals.empty() && waiting == 0;) {
      const double now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - stage.begun).count();
      stage.host.pump(now_s);
      stage.editor.pump(now_s);
      refusals = stage.editor.scene.take_refusals();
      for (const SceneRequest& request : stage.host.take_scene_requests()) waiting += request.batch.changes.size();
    }
    return std::pair{waiting, refusals.empty() ? std::string() : refusals.front().refusal.failures.front().why};
  };
  constexpr std::size_t most = replication::most_changes_of_batch;
  CHECK(answered(most) == std::pair{most, std::string()});
  for (const std::size_t changes : {most + 1, std::size_t{100'000}}) {
    const auto answer = answered(changes);
    CHECK(answer.first == 0);
    CHECK(answer.second.find("it has more than 4096 changes") == 0);
    CHECK(answer.second.find("send it in several batches") != std::string::npos);
  }
}

}  // namespace septet::server
