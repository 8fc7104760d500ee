#include "engine/replication/replication_server.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/core/hash.hpp"
#include "engine/replication/outbox.hpp"
#include "engine/scene/command_codec.hpp"

namespace septet::replication {

using namespace scene;

namespace {

constexpr int nodes_listed_at_once = 256;
constexpr int requests_per_pump = 8192;
constexpr std::size_t most_waiting_answers = 1000;
/// Sessions' own ids lie above those that the server assigns, and begin again after many sessions.
constexpr NodeId first_own_id = 0x40000000u, sessions_with_ids = 0xA000u;

/// A batch on its way: its content, to be repeated if it does not arrive.
struct Unacknowledged {
  std::uint64_t sequence = 0;
  std::size_t bytes = 0;
  std::uint64_t tick = 0;  ///< That shows it first.
  std::vector<Change> changes;
};

struct Session {
  std::uint64_t token = 0;
  std::string identity;

  std::uint32_t node_types = 0;
  NodeId next_listed = no_node;  ///< First node of the index still to be listed; no_node: all are listed.
  std::set<NodeId> announced;
  std::map<NodeId, std::set<std::pair<PartKind, PartId>>> subscriptions;  ///< Those with their type's content, too.

  Outbox outbox;
  std::deque<Command> requests;  ///< Requests without a reply yet.
  std::uint64_t received = 0;    ///< Number of the client's last batch.
  bool owes_acknowledgement = false;
  std::uint64_t sent = 0;
  std::deque<Unacknowledged> unacknowledged;
  std::size_t unacknowledged_bytes = 0;
  bool told_complete = false;
  std::uint64_t told_revision = 0, told_answered = 0;
  NodeId own_ids = 0;
  std::uint64_t changed_at = 0;  ///< First tick that shows the newest change.
  std::deque<Message> answers;   ///< Refused and Done, to be sent.

  bool wants_type(NodeType type) const { return node_types >> static_cast<int>(type) & 1; }
  bool wants_all_of(NodeType type) const { return node_types & with_content(1u << static_cast<int>(type)); }
  bool wants(const Subject& subject) const {
    const auto node = subscriptions.find(subject.node);
    if (node == subscriptions.end()) return false;
    if (subject.kind == SubjectKind::tag) return node->second.contains({PartKind::tag_group, subject.part});
    if (is_range(subject.kind)) return node->second.contains({PartKind::layer, subject.part});
    return true;
  }

  void acknowledge(std::uint64_t sequence) {
    while (!unacknowledged.empty() && unacknowledged.front().sequence <= sequence) {
      unacknowledged_bytes -= unacknowledged.front().bytes;
      unacknowledged.pop_front();
    }
  }

  /// After a loss: repeats the batches that did not arrive.
  void rewind(std::uint64_t arrived) {
    acknowledge(arrived);
    std::vector<Change> lost;
    for (const Unacknowledged& batch : unacknowledged)
      std::ranges::copy_if(batch.changes, std::back_inserter(lost), [&](const Change& change) {
        return change.subject.kind == SubjectKind::existence || wants(change.subject);
      });
    if (!unacknowledged.empty()) outbox.mark_lost(lost, unacknowledged.back().tick);
    unacknowledged.clear();
    unacknowledged_bytes = 0;
    sent = arrived;
    told_complete = false;
  }
};

struct Connection {
  std::string identity;
  std::unique_ptr<Session> session;  ///< Set from its hello on.
  Bytes unsent;                      ///< A message that the lane did not accept.
};

using Parts = std::set<std::pair<PartKind, PartId>>;

Parts base_layers_of(NodeType type) {
  if (type != NodeType::geometry) return {};
  return {{PartKind::layer, base_vertex_layer}, {PartKind::layer, base_polygon_layer}};
}

/// All that a node has.
Parts parts_of(const Node& node) {
  Parts parts = base_layers_of(node.type());
  for (const auto& [id, group] : node.tag_groups) parts.insert({PartKind::tag_group, id});
  const auto add_layers = [&](const auto& data) {
    for (const auto& [id, layer] : data.layers) parts.insert({PartKind::layer, id});
  };
  if (const auto* geometry = std::get_if<GeometryData>(&node.data)) add_layers(*geometry);
  if (const auto* bitmap = std::get_if<BitmapData>(&node.data)) add_layers(*bitmap);
  return parts;
}

/// The part that a subject defines; empty for any other.
std::optional<std::pair<PartKind, PartId>> part_of(const Subject& definition) {
  switch (definition.kind) {
    case SubjectKind::tag_group:
      return std::pair{PartKind::tag_group, definition.part};
    case SubjectKind::geometry_layer:
    case SubjectKind::bitmap_layer:
      return std::pair{PartKind::layer, definition.part};
    default:
      return std::nullopt;
  }
}

/// Drops waiting changes of a part's content.
void forget_content(Outbox& outbox, const Subject& definition) {
  const auto [node, kind, part, item] = definition;
  if (kind == SubjectKind::tag_group)
    outbox.forget({node, SubjectKind::tag, part, 0}, {node, SubjectKind::tag, part, 0xFFFF});
  if (kind == SubjectKind::geometry_layer)
    outbox.forget({node, SubjectKind::layer_values, part, 0}, {node, SubjectKind::layer_values, part, 0xFFFF});
  if (kind == SubjectKind::bitmap_layer)
    outbox.forget({node, SubjectKind::tiles, part, 0}, {node, SubjectKind::tiles, part, 0xFFFF});
}

}  // namespace

struct ReplicationServer::State {
  const Store& store;
  std::uint64_t instance;
  ReplicationOptions options;
  std::map<ConnectionId, Connection> connections;
  std::deque<std::unique_ptr<Session>> lost;  ///< Oldest first.
  std::uint64_t sessions_made = 0;

  // ---- changes of the store

  void tell(Session& session, const Change& change, const Command& command, std::uint64_t tick) {
    session.changed_at = std::max(session.changed_at, tick);
    const NodeId node = change.subject.node;
    if (change.subject.kind == SubjectKind::existence) {
      if (const auto* created = std::get_if<NodeCreate>(&command)) {
        const bool already_listed = node < session.next_listed;
        if (!session.wants_type(created->type) || !already_listed) return;
        session.announced.insert(node);
        if (session.wants_all_of(created->type)) session.subscriptions[node] = base_layers_of(created->type);
      } else {
        if (session.announced.erase(node) == 0) return;
        session.subscriptions.erase(node);
        session.outbox.forget({node, SubjectKind::name, 0, 0}, {node, SubjectKind::tiles, 0xFFFF, 0xFFFF});
      }
      return session.outbox.mark(change, tick);
    }
    if (!session.wants(change.subject)) return;
    if (change.renew) {
      const PartKind kind = change.subject.kind == SubjectKind::tag_group ? PartKind::tag_group : PartKind::layer;
      session.subscriptions[node].erase({kind, change.subject.part});
      forget_content(session.outbox, change.subject);
    } else if (const Node* changed = store.find(node); changed && session.wants_all_of(changed->type())) {
      if (const auto part = part_of(change.subject)) session.subscriptions[node].insert(*part);
    }
    session.outbox.mark(change, tick);
  }

  // ---- requests

  void answer(Session& session, const Command& request) {
    const Mark mark = [&](const Change& change) { session.outbox.mark(change); };
    if (const auto* index = std::get_if<NodeIndexSubscribe>(&request)) {
      session.node_types = index->type_mask;
      session.next_listed = index->type_mask == 0 ? no_node : 0;
    } else if (const auto* subscription = std::get_if<NodeSubscribe>(&request)) {
      const Node* node = store.find(subscription->node);
      if (!subscription->subscribe) {
        session.subscriptions.erase(subscription->node);
        session.outbox.forget({subscription->node, SubjectKind::name, 0, 0},
                              {subscription->node, SubjectKind::tiles, 0xFFFF, 0xFFFF});
      } else if (node) {
        session.subscriptions.try_emplace(subscription->node);
        // A client that subscribes without the index still gets the node's end.
        session.announced.insert(subscription->node);
        mark_node(*node, mark);
      }
    } else if (const auto* part = std::get_if<PartSubscribe>(&request)) {
      const auto subscribed = session.subscriptions.find(part->node);
      if (subscribed == session.subscriptions.end()) return;
      if (!part->subscribe) {
        subscribed->second.erase({part->kind, part->part});
        return;
      }
      if (!has_part(*part)) return;
      subscribed->second.insert({part->kind, part->part});
      mark_part(store, part->node, part->kind, part->part, mark);
    }
  }

  bool has_part(const PartSubscribe& part) const {
    const Node* node = store.find(part.node);
    if (!node) return false;
    if (part.kind == PartKind::tag_group) return node->tag_groups.contains(part.part);
    if (const auto* geometry = std::get_if<GeometryData>(&node->data))
      return part.part >= base_polygon_layer || geometry->layers.contains(part.part);
    const auto* bitmap = std::get_if<BitmapData>(&node->data);
    return bitmap && bitmap->layers.contains(part.part);
  }

  /// Marks the next nodes of the index.
  void list_nodes(Session& session) {
    auto node = store.nodes().lower_bound(session.next_listed);
    const Mark mark = [&](const Change& change) { session.outbox.mark(change); };
    for (int i = 0; i < nodes_listed_at_once && node != store.nodes().end(); ++i, ++node) {
      const NodeType type = node->second.type();
      if (!session.wants_type(type) || !session.announced.insert(node->first).second) continue;
      mark({{node->first, SubjectKind::existence, 0, 0}});
      if (!session.wants_all_of(type)) continue;
      mark_node(node->second, mark);
      Parts& parts = session.subscriptions[node->first] = parts_of(node->second);
      for (const auto& [kind, part] : parts) mark_part(store, node->first, kind, part, mark);
    }
    session.next_listed = node == store.nodes().end() ? no_node : node->first;
  }

  /// Turns the next request, or the next nodes of the index, into changes to send. False when no request is left, or no
  /// more are allowed.
  bool go_on(Session& session, int& requests) {
    if (session.next_listed != no_node) return list_nodes(session), true;
    if (session.requests.empty() || requests <= 0) return false;
    --requests;
    answer(session, session.requests.front());
    session.requests.pop_front();
    return true;
  }

  // ---- messages

  void trim_lost() {
    while (lost.size() > options.lost_sessions) lost.pop_front();
  }

  Expected<void> hello(Connection& connection, const Hello& message) {
    // A client may be back before the loss of its old connection was noticed.
    for (auto& [id, other] : connections)
      if (other.session && other.session->token == message.token && other.identity == connection.identity)
        lost.push_back(std::move(other.session));
    trim_lost();
    connection.session.reset();  // A client that found a fault starts anew without a token.
    const auto found = std::find_if(lost.begin(), lost.end(), [&](const auto& session) {
      return message.token != 0 && session->token == message.token && session->identity == connection.identity &&
             message.received <= session->sent &&
             (session->unacknowledged.empty() ? message.received == session->sent
                                              : message.received + 1 >= session->unacknowledged.front().sequence);
    });
    const bool resumed = found != lost.end();
    if (resumed) {
      connection.session = std::move(*found);
      lost.erase(found);
      connection.session->rewind(message.received);
    } else {
      StateHash token;
      token.add(instance);
      token.add(++sessions_made);
      connection.session = std::make_unique<Session>();
      connection.session->token = std::max<std::uint64_t>(1, token.value());
      connection.session->identity = connection.identity;
      connection.session->own_ids =
          first_own_id + static_cast<NodeId>(sessions_made % sessions_with_ids) * ids_per_session;
    }
    connection.unsent =
        encode(Welcome{connection.session->token, resumed, connection.session->received, connection.session->own_ids});
    return {};
  }

  void answer(ConnectionId connection, Message message) {
    const auto found = connections.find(connection);
    if (found == connections.end() || !found->second.session) return;
    std::deque<Message>& answers = found->second.session->answers;
    if (answers.size() < most_waiting_answers) answers.push_back(std::move(message));
  }

  Expected<ClientBatch> batch(Session& session, const CommandBatch& message) {
    if (message.sequence <= session.received) return ClientBatch{};
    if (message.sequence != session.received + 1)
      return failure(fmt::format("batch {} follows {}", message.sequence, session.received),
                     "replication client " + session.identity, "repeat unanswered batches in order");
    ClientBatch asked{message.sequence, message.tick, message.commands.size()};
    ByteReader in(message.commands);
    while (!in.at_end()) {
      auto command = scene::decode(in);
      if (!command) return tl::unexpected(command.error());
      constexpr std::size_t subscription_kinds = 3;
      const bool is_change = command->index() >= subscription_kinds;
      asked.has_too_many = is_change && asked.changes.size() == most_changes_of_batch;
      if (asked.has_too_many) break;  // What nobody does need not be read.
      if (is_change)
        asked.changes.push_back(std::move(*command));
      else if (session.requests.size() < options.waiting_requests)
        session.requests.push_back(std::move(*command));
      else
        return failure("too many subscriptions wait", "replication client " + session.identity,
                       "subscribe to each part once");
    }
    session.received = message.sequence;
    session.owes_acknowledgement = true;
    return asked;
  }

  Pumped pump(Connection& connection, std::size_t max_bytes, const Send& send) {
    Pumped pumped;
    const auto offer = [&](Bytes message) {
      ++pumped.messages;
      pumped.bytes += message.size();
      if (send(message)) return true;
      connection.unsent = std::move(message);
      return false;
    };
    if (!connection.unsent.empty() && !offer(std::exchange(connection.unsent, {}))) return pumped;
    if (!connection.session) return pumped;
    Session& session = *connection.session;

    int requests = requests_per_pump;
    for (std::size_t written = 0; written < max_bytes && session.unacknowledged_bytes < options.window_bytes;) {
      Unacknowledged batch{session.sent + 1, 0, session.changed_at, {}};
      Bytes commands;
      const std::size_t limit = std::min(options.batch_bytes, max_bytes - written);
      while (commands.size() < limit) {
        if (session.outbox.empty() && !go_on(session, requests)) break;
        session.outbox.write(store, limit, commands, batch.changes);
      }
      if (commands.empty()) break;
      batch.bytes = commands.size();
      written += commands.size();
      session.sent = batch.sequence;
      session.unacknowledged_bytes += batch.bytes;
      session.unacknowledged.push_back(std::move(batch));
      session.owes_acknowledgement = false;
      if (!offer(encode(CommandBatch{session.sent, session.received, std::move(commands), session.changed_at,
                                     session.outbox.goes_on()})))
        return pumped;
    }

    // What was done is in the mirror of who is told so.
    const auto is_too_early = [&](const Message& message) {
      const auto* done = std::get_if<Done>(&message);
      return done && session.outbox.waits_for(done->tick);
    };
    while (!session.answers.empty() && !is_too_early(session.answers.front())) {
      const Message next = std::move(session.answers.front());
      session.answers.pop_front();
      if (!offer(encode(next))) return pumped;
    }
    const bool all_said = session.outbox.empty() && session.requests.empty() && session.next_listed == no_node;
    const bool news = !session.told_complete || session.told_revision != store.revision() ||
                      session.told_answered != session.received;
    if (all_said && news) {
      session.told_complete = true;
      session.told_revision = store.revision();
      session.told_answered = session.received;
      if (!offer(encode(Complete{session.told_revision, session.told_answered}))) return pumped;
    }
    if (session.owes_acknowledgement) {
      session.owes_acknowledgement = false;
      if (!offer(encode(Received{session.received}))) return pumped;
    }
    pumped.finished = all_said;
    return pumped;
  }
};

ReplicationServer::ReplicationServer(const Store& store, std::uint64_t instance, const ReplicationOptions& options)
    : state_(new State{store, instance, options, {}, {}, 0}) {}
ReplicationServer::~ReplicationServer() = default;

void ReplicationServer::connect(ConnectionId connection, std::string identity) {
  disconnect(connection);
  state_->connections[connection].identity = std::move(identity);
}

void ReplicationServer::disconnect(ConnectionId connection) {
  const auto found = state_->connections.find(connection);
  if (found == state_->connections.end()) return;
  if (found->second.session) state_->lost.push_back(std::move(found->second.session));
  state_->trim_lost();
  state_->connections.erase(found);
}

Expected<ClientBatch> ReplicationServer::receive(ConnectionId connection, std::span<const std::byte> message) {
  const auto found = state_->connections.find(connection);
  SEPTET_CHECK(found != state_->connections.end(), "connection {} is not known", connection);
  Connection& from = found->second;
  auto decoded = decode(message);
  if (!decoded) return tl::unexpected(decoded.error());
  if (const auto* hello = std::get_if<Hello>(&*decoded)) {
    if (auto done = state_->hello(from, *hello); !done) return tl::unexpected(done.error());
    return ClientBatch{};
  }
  if (!from.session)
    return failure("a message before the hello", "replication client " + from.identity, "say hello first");
  if (const auto* batch = std::get_if<CommandBatch>(&*decoded)) {
    from.session->acknowledge(batch->received);
    return state_->batch(*from.session, *batch);
  }
  if (const auto* received = std::get_if<Received>(&*decoded)) {
    from.session->acknowledge(received->sequence);
    return ClientBatch{};
  }
  return failure("a message that only a server sends", "replication client " + from.identity,
                 "send hello, commands or received");
}

NodeId ReplicationServer::own_ids(ConnectionId connection) const {
  const auto found = state_->connections.find(connection);
  return found == state_->connections.end() || !found->second.session ? 0 : found->second.session->own_ids;
}

void ReplicationServer::refuse(ConnectionId connection, std::uint64_t batch, Refusal refusal) {
  state_->answer(connection, Refused{batch, std::move(refusal)});
}

void ReplicationServer::done(ConnectionId connection, std::uint64_t batch, std::uint64_t tick) {
  state_->answer(connection, Done{batch, tick});
}

void ReplicationServer::applied(const Command& command, std::uint64_t tick) {
  const auto change = change_of(command, state_->store);
  if (!change) return;
  for (auto& [id, connection] : state_->connections)
    if (connection.session) state_->tell(*connection.session, *change, command, tick);
  for (auto& session : state_->lost) state_->tell(*session, *change, command, tick);
}

ReplicationServer::Pumped ReplicationServer::pump(ConnectionId connection, std::size_t max_bytes, const Send& send) {
  const auto found = state_->connections.find(connection);
  SEPTET_CHECK(found != state_->connections.end(), "connection {} is not known", connection);
  return state_->pump(found->second, max_bytes, send);
}

}  // namespace septet::replication
