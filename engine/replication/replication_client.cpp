#include "engine/replication/replication_client.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"

namespace septet::replication {

using namespace scene;

namespace {

constexpr std::size_t batch_bytes = 32 * 1024;
/// Answers to batches that are kept, of each kind.
constexpr std::size_t most_kept_answers = 10'000;

/// Commands kept back at most, by their bytes; beyond that they are shown early.
constexpr std::size_t most_held_bytes = 64u << 20;

/// Commands that a later tick shows.
struct HeldBatch {
  std::uint64_t tick = 0;
  bool goes_on = false;  ///< The next one belongs to it.
  std::size_t bytes = 0;
  std::vector<Command> commands;
};

struct SentBatch {
  std::uint64_t sequence = 0;
  Bytes commands;
  std::uint64_t tick = 0;
};

}  // namespace

struct ReplicationClient::State {
  SubscriptionPolicy policy;
  StoreLimits limits;

  std::unique_ptr<Store> shown = std::make_unique<Store>();
  std::unique_ptr<Store> filling;  ///< New mirror, where it is not the one shown.
  std::uint64_t generation = 0;
  std::set<std::tuple<NodeId, PartKind, PartId>> subscribed_parts;

  std::uint64_t token = 0;
  std::uint64_t received = 0;  ///< Number of the server's last batch.
  std::uint64_t sent = 0;
  std::deque<SentBatch> unacknowledged;
  std::size_t to_repeat = 0;  ///< Number of the latest unacknowledged batches to be sent (again).
  Bytes queued;               ///< Commands that are in no batch yet.
  bool hello_due = false, welcomed = false, owes_acknowledgement = false;

  bool ever_complete = false;
  bool is_current = false;   ///< On this connection the server has said that all was sent.
  bool has_gone_on = false;  ///< Changes later than `revision` are in the mirror.
  std::uint64_t answered = 0, revision = 0;
  NodeId own_ids = 0;
  std::vector<Refused> refusals;
  std::vector<Done> done;
  std::optional<std::uint64_t> shown_tick;
  std::deque<HeldBatch> held;
  std::size_t held_bytes = 0;
  std::map<NodeId, NodeType> held_nodes;  ///< Created by what is held.

  /// The server then sends each node with its content, unasked.
  bool wants_all() const { return !policy.wants_part; }
  Store& mirror() { return filling ? *filling : *shown; }
  bool complete() const { return is_current && queued.empty() && answered == sent; }

  void start_anew(std::uint64_t new_token) {
    token = new_token;
    received = sent = answered = 0;
    unacknowledged.clear();
    to_repeat = 0;
    queued.clear();
    subscribed_parts.clear();
    ever_complete = is_current = false;
    owes_acknowledgement = false;
    drop_held();
    shown_tick.reset();
    filling = std::make_unique<Store>(limits);
    if (shown->revision() == 0) show();  // No older mirror exists to keep: this one is shown as it fills.
    queue(NodeIndexSubscribe{policy.node_types | (wants_all() ? with_content(policy.node_types) : 0u)});
  }
  void show() {
    shown = std::move(filling);
    ++generation;
  }
  void drop_held() {
    held.clear();
    held_nodes.clear();
    held_bytes = 0;
  }
  /// Of the batches that belong together all or none, unless they are `forced`.
  Expected<void> apply_held(std::uint64_t tick, bool forced = false) {
    std::size_t whole = 0;
    for (std::size_t i = 0; i < held.size() && held[i].tick <= tick; ++i)
      if (forced || !held[i].goes_on) whole = i + 1;
    for (; whole > 0; --whole) {
      const HeldBatch batch = std::move(held.front());
      held.pop_front();
      held_bytes -= batch.bytes;
      for (const Command& command : batch.commands)
        if (auto applied = mirror().apply(command); !applied) return applied;
    }
    if (held.empty()) held_nodes.clear();
    return {};
  }
  /// A client that shows no ticks keeps back only what is not whole yet.
  Expected<void> apply_what_is_whole() {
    if (shown_tick || held.empty() || held.back().goes_on) return {};
    has_gone_on = true;
    return apply_held(std::numeric_limits<std::uint64_t>::max());
  }
  std::optional<NodeType> type_of(NodeId id) {
    if (const Node* node = mirror().find(id)) return node->type();
    const auto found = held_nodes.find(id);
    return found == held_nodes.end() ? std::nullopt : std::optional(found->second);
  }

  // ---- subscriptions

  void queue(const Command& command) {
    scene::encode(command, queued);
    if (queued.size() >= batch_bytes) close_batch();
  }
  void close_batch(std::uint64_t tick = 0) {
    if (queued.empty()) return;
    unacknowledged.push_back({++sent, std::exchange(queued, {}), tick});
    ++to_repeat;
  }
  void subscribe(NodeId node, NodeType type, PartKind kind, PartId part, std::string_view name) {
    if (policy.wants_part && !policy.wants_part(type, kind, name)) return;
    if (subscribed_parts.insert({node, kind, part}).second) queue(PartSubscribe{node, kind, part, true});
  }
  void forget_parts(NodeId node) {
    constexpr PartId last = std::numeric_limits<PartId>::max();
    subscribed_parts.erase(subscribed_parts.lower_bound({node, PartKind::tag_group, 0}),
                           subscribed_parts.upper_bound({node, PartKind::layer, last}));
  }

  /// Subscribes to the nodes and parts that a command announces.
  void learn_from(const Command& command) {
    if (wants_all()) return;
    if (const auto* c = std::get_if<NodeCreate>(&command)) {
      queue(NodeSubscribe{c->node, true});
      if (c->type == NodeType::geometry) {
        subscribe(c->node, c->type, PartKind::layer, base_vertex_layer, "vertex");
        subscribe(c->node, c->type, PartKind::layer, base_polygon_layer, "polygon");
      }
    } else if (const auto* destroyed = std::get_if<NodeDestroy>(&command)) {
      forget_parts(destroyed->node);
    } else if (const auto* group = std::get_if<TagGroupSet>(&command)) {
      if (const auto type = type_of(group->node))
        subscribe(group->node, *type, PartKind::tag_group, group->group, group->name);
    } else if (const auto* no_group = std::get_if<TagGroupDestroy>(&command)) {
      subscribed_parts.erase({no_group->node, PartKind::tag_group, no_group->group});
    } else if (const auto* layer = std::get_if<GeometryLayerSet>(&command)) {
      subscribe(layer->node, NodeType::geometry, PartKind::layer, layer->layer, layer->name);
    } else if (const auto* no_layer = std::get_if<GeometryLayerDestroy>(&command)) {
      subscribed_parts.erase({no_layer->node, PartKind::layer, no_layer->layer});
    } else if (const auto* pixels = std::get_if<BitmapLayerSet>(&command)) {
      subscribe(pixels->node, NodeType::bitmap, PartKind::layer, pixels->layer, pixels->name);
    } else if (const auto* no_pixels = std::get_if<BitmapLayerDestroy>(&command)) {
      subscribed_parts.erase({no_pixels->node, PartKind::layer, no_pixels->layer});
    }
  }

  // ---- messages

  Expected<void> operator()(const Welcome& message) {
    if (welcomed) return failure("a second welcome", "replication server", "welcome a client once");
    welcomed = true;
    own_ids = message.first_id;
    if (!message.resumed || message.token != token || token == 0) {
      start_anew(message.token);
      return {};
    }
    acknowledge(message.received);
    to_repeat = unacknowledged.size();
    return {};
  }

  Expected<void> operator()(const CommandBatch& message) {
    acknowledge(message.received);
    if (message.sequence <= received) return {};
    if (message.sequence != received + 1)
      return failure(fmt::format("batch {} follows {}", message.sequence, received), "replication server",
                     "connect again");
    const bool is_later = shown_tick && message.tick > *shown_tick;
    const bool may_be_shown = !filling && (shown_tick || ever_complete);
    const bool is_held = !held.empty() || (may_be_shown && (message.goes_on || is_later));
    has_gone_on = has_gone_on || !is_held;
    HeldBatch batch{message.tick, message.goes_on, message.commands.size(), {}};
    ByteReader in(message.commands);
    while (!in.at_end()) {
      auto command = scene::decode(in);
      if (!command) return tl::unexpected(command.error());
      if (!is_held) {
        if (auto applied = mirror().apply(*command); !applied) return applied;
        learn_from(*command);
        continue;
      }
      // Subscribed to at once, so that a new node's content is there when its tick is.
      if (const auto* created = std::get_if<NodeCreate>(&*command)) held_nodes[created->node] = created->type;
      learn_from(*command);
      batch.commands.push_back(std::move(*command));
    }
    if (is_held) {
      held_bytes += batch.bytes;
      held.push_back(std::move(batch));
      if (held_bytes > most_held_bytes) {
        has_gone_on = true;
        if (auto applied = apply_held(std::numeric_limits<std::uint64_t>::max(), true); !applied) return applied;
      }
      if (auto applied = apply_what_is_whole(); !applied) return applied;
    }
    received = message.sequence;
    owes_acknowledgement = true;
    return {};
  }

  Expected<void> operator()(const Complete& message) {
    answered = message.answered;
    revision = message.revision;
    if (!held.empty()) held.back().goes_on = false;  // Nothing is to come that belongs to it.
    // Before the first batch is sent there are no requests, so nothing can be complete.
    ever_complete = ever_complete || answered > 0;
    is_current = ever_complete;
    auto applied = apply_what_is_whole();
    has_gone_on = false;
    if (filling && complete()) show();
    return applied;
  }
  Expected<void> operator()(const Received& message) {
    acknowledge(message.sequence);
    return {};
  }
  Expected<void> operator()(const Refused& message) {
    if (refusals.size() < most_kept_answers) refusals.push_back(message);
    return {};
  }
  Expected<void> operator()(const Done& message) {
    if (done.size() < most_kept_answers) done.push_back(message);
    return {};
  }
  Expected<void> operator()(const Hello&) {
    return failure("a message that only a client sends", "replication server", "connect to a server");
  }

  /// A mirror that missed a change is discarded.
  void begin_anew() {
    token = 0;
    welcomed = is_current = false;
    hello_due = true;
    drop_held();
  }

  void acknowledge(std::uint64_t sequence) {
    while (!unacknowledged.empty() && unacknowledged.front().sequence <= sequence) unacknowledged.pop_front();
    to_repeat = std::min(to_repeat, unacknowledged.size());
  }

  void pump(const Send& send) {
    if (hello_due) {
      if (!send(encode(Hello{token, received}))) return;
      hello_due = false;
    }
    if (!welcomed) return;
    close_batch();
    for (; to_repeat > 0; --to_repeat) {
      const SentBatch& batch = unacknowledged[unacknowledged.size() - to_repeat];
      if (!send(encode(CommandBatch{batch.sequence, received, batch.commands, batch.tick}))) return;
      owes_acknowledgement = false;
    }
    if (owes_acknowledgement && send(encode(Received{received}))) owes_acknowledgement = false;
  }
};

ReplicationClient::ReplicationClient(SubscriptionPolicy policy, const StoreLimits& limits)
    : state_(std::make_unique<State>()) {
  state_->policy = std::move(policy);
  state_->limits = limits;
}
ReplicationClient::~ReplicationClient() = default;

void ReplicationClient::connected() {
  state_->hello_due = true;
  state_->welcomed = state_->is_current = false;
}

void ReplicationClient::disconnected() { state_->hello_due = state_->welcomed = state_->is_current = false; }

Expected<void> ReplicationClient::receive(std::span<const std::byte> message) {
  const auto decoded = decode(message);
  // Until the welcome, messages of an earlier session may still be on their way.
  if (decoded && !state_->welcomed && !std::holds_alternative<Welcome>(*decoded)) return {};
  auto done = decoded ? std::visit(*state_, *decoded) : Expected<void>(tl::unexpected(decoded.error()));
  if (!done) state_->begin_anew();
  return done;
}

Expected<void> ReplicationClient::show(std::uint64_t tick) {
  state_->shown_tick = tick;
  auto done = state_->apply_held(tick);
  if (!done) state_->begin_anew();
  return done;
}

void ReplicationClient::pump(const Send& send) { state_->pump(send); }
void ReplicationClient::request(const Command& command) { state_->queue(command); }

Expected<std::uint64_t> ReplicationClient::request_batch(std::span<const Command> changes, std::uint64_t tick) {
  Bytes bytes;
  for (const Command& command : changes) scene::encode(command, bytes);
  if (bytes.empty() || bytes.size() > max_batch_bytes)
    return failure(fmt::format("a batch of {} bytes", bytes.size()), "changes of the scene",
                   fmt::format("send 1 to {} bytes at once", max_batch_bytes));
  state_->close_batch();
  state_->queued = std::move(bytes);
  state_->close_batch(tick);
  return state_->sent;
}

NodeId ReplicationClient::own_ids() const { return state_->own_ids; }
std::vector<Refused> ReplicationClient::take_refusals() { return std::exchange(state_->refusals, {}); }
std::vector<Done> ReplicationClient::take_done() { return std::exchange(state_->done, {}); }
const Store& ReplicationClient::store() const { return *state_->shown; }
std::uint64_t ReplicationClient::generation() const { return state_->generation; }
bool ReplicationClient::complete() const { return state_->complete(); }
bool ReplicationClient::is_at(std::uint64_t revision) const {
  return complete() && !state_->has_gone_on && state_->revision == revision;
}
std::uint64_t ReplicationClient::complete_revision() const { return state_->revision; }

}  // namespace septet::replication
