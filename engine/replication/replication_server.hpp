#pragma once
/// The server's side of replication: each client's subscriptions, and the changes to be sent to it next
/// (REPLICATION.md).
///
///     on a connection:   server.connect(id, name_of_its_key);
///     on a message:      requests = server.receive(id, bytes);   // the client's requests; refused ones end it
///     on every change:   store.apply(command); server.applied(command);
///     every tick:        for each client: server.pump(id, bytes, send);
///
/// Bytes in, bytes out: no socket, no clock. A pump does work in proportion to its byte budget, so that a late joiner
/// or a hung client does not hold up the tick. Single-threaded, on the thread that owns the store.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::replication {

/// Hands a message to the reliable, ordered lane; false where the lane does not accept it now (it is offered again).
using Send = std::function<bool(std::span<const std::byte> message)>;

/// Id of a connection, given by the lane; a client that reconnects has a new one.
using ConnectionId = std::uint32_t;

struct ReplicationOptions {
  std::size_t batch_bytes = 32 * 1024;         ///< Size of the commands in one message, before packing.
  std::size_t window_bytes = 4 * 1024 * 1024;  ///< Bytes sent and not yet acknowledged, before packing.
  std::size_t lost_sessions = 32;              ///< Sessions kept for clients that come back.
  std::size_t waiting_requests = 1u << 20;     ///< Limit of one client's requests; more end its connection.
};

/// A client's changes, to be made together.
struct ClientBatch {
  std::uint64_t number = 0;  ///< By which its answer names it.
  std::uint64_t tick = 0;    ///< The one that is to show them first; 0: the next.
  std::size_t bytes = 0;     ///< As encoded.
  std::vector<scene::Command> changes{};
  bool has_too_many =
      false;  ///< More than most_changes_of_batch: `changes` are the first of them, and it is to be refused.
};

class ReplicationServer {
 public:
  /// `instance` distinguishes this run of the server from earlier ones; any number that does not repeat. The store must
  /// outlive the server.
  ReplicationServer(const scene::Store& store, std::uint64_t instance, const ReplicationOptions& options = {});
  ~ReplicationServer();

  /// `identity` (its key, its name) decides which sessions a client can resume.
  void connect(ConnectionId connection, std::string identity);
  /// Keeps its session for a while.
  void disconnect(ConnectionId connection);

  /// Returns the client's requested changes, for the owner of the store to apply or not. After an error the connection
  /// is to be dropped.
  Expected<ClientBatch> receive(ConnectionId connection, std::span<const std::byte> message);

  /// The first of the ids that are this client's own; 0: it has not said hello.
  scene::NodeId own_ids(ConnectionId connection) const;
  /// Tells a client that nothing of its batch was done, and why. Of the answers that wait, the
  /// oldest thousand are told. A connection that is gone is told nothing.
  void refuse(ConnectionId connection, std::uint64_t batch, Refusal refusal);
  /// Tells a client that its batch was done, and the first tick that shows it, behind what it changed.
  void done(ConnectionId connection, std::uint64_t batch, std::uint64_t tick);

  /// Call after every command that the store accepted. `tick`: the first that shows it; mirrors that show ticks keep it
  /// back until then. 0: at once. Ticks rise.
  void applied(const scene::Command& command, std::uint64_t tick = 0);

  struct Pumped {
    std::size_t messages = 0;
    std::size_t bytes = 0;  ///< Bytes as handed to `send`.
    bool finished = false;  ///< True if only acknowledgements wait for this client.
  };
  /// Serves requests and sends changes until about `max_bytes` (before packing) are written.
  Pumped pump(ConnectionId connection, std::size_t max_bytes, const Send& send);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::replication
