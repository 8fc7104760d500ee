#pragma once
/// A client's side of replication: a mirror of its subscriptions (REPLICATION.md).
///
///     on a connection:  client.connected();
///     on a message:     client.receive(bytes);   // an error: log it
///     on a loss:        client.disconnected();
///     every frame:      client.pump(send); if (resolver generation differs) resolver.forget();
///     resolver.update(client.store())
///
/// Bytes in, bytes out; single-threaded.

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/replication/message.hpp"
#include "engine/replication/replication_server.hpp"
#include "engine/scene/store.hpp"

namespace septet::replication {

/// Selects a client's subscriptions among announced nodes and parts. The default, a screen's: everything.
struct SubscriptionPolicy {
  std::uint32_t node_types = (1u << scene::node_type_count) - 1u;
  /// True for a tag group or layer of that name to subscribe to (base layers: "vertex", "polygon"); empty: all.
  std::function<bool(scene::NodeType, scene::PartKind, std::string_view name)> wants_part;
};

class ReplicationClient {
 public:
  explicit ReplicationClient(SubscriptionPolicy policy = {}, const scene::StoreLimits& limits = {});
  ~ReplicationClient();

  void connected();
  void disconnected();
  /// After an error, which is to be logged, the client says hello again and fills a new mirror.
  Expected<void> receive(std::span<const std::byte> message);
  /// Sends subscriptions, requests and acknowledgements that are due.
  void pump(const Send& send);

  /// Requests a change from the server (the reply is the same command, or none) or a subscription beyond the
  /// policy's. Requests of a session that is not resumed are lost.
  void request(const scene::Command& command);
  /// Requests changes that are made together or not at all; returns the batch's number, by which its answer names it. New
  /// nodes have ids of `own_ids`. `tick`: the one that is to show them first; 0: the next. Error: they are too many for one
  /// batch.
  Expected<std::uint64_t> request_batch(std::span<const scene::Command> changes, std::uint64_t tick = 0);
  /// The first of the ids that this client gives to nodes (ids_per_session of them); 0 before the welcome.
  scene::NodeId own_ids() const;
  /// The refusals since the last call.
  std::vector<Refused> take_refusals();
  /// The batches that were done since the last call.
  std::vector<Done> take_done();
  /// The tick that is shown next: what holds from it on is in the store now, and from the first call on what holds from a
  /// later tick is kept back. Ticks rise. Error: as of `receive`.
  Expected<void> show(std::uint64_t tick);
  /// The store to be shown: the mirror, or, while a new connection fills a new one, the last complete one.
  const scene::Store& store() const;
  /// Changes whenever `store()` is replaced by another one.
  std::uint64_t generation() const;

  /// True where the mirror being filled holds all subscriptions, up to `complete_revision` of the server's store, as the
  /// server has said on this connection.
  bool complete() const;
  std::uint64_t complete_revision() const;
  /// True where the mirror, at the tick that shows that revision of the server's store, equals it; false where it lacks
  /// something, or has gone beyond, as one that has shown nothing yet does.
  bool is_at(std::uint64_t revision) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::replication
