// Hostile bytes against node commands and replication. The first byte chooses: commands straight
// into a store that is then described again and resolved; messages to a server; messages to a
// client.

#include <cstdlib>

#include "engine/replication/message.hpp"
#include "engine/replication/replication_client.hpp"
#include "engine/replication/replication_server.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/resolve.hpp"

namespace {

using namespace septet;

constexpr scene::StoreLimits limits{
    .nodes = 64, .vertices = 4096, .polygons = 4096, .bitmap_side = 256, .bytes = 1 << 20};

void require(bool condition) {
  if (!condition) std::abort();
}

void fill_store(std::span<const std::byte> bytes) {
  scene::Store store(limits), copy(limits);
  ByteReader in(bytes);
  while (!in.at_end()) {
    const auto command = scene::decode(in);
    if (!command) break;
    Bytes again;
    scene::encode(*command, again);
    require(scene::decode(again) == *command);
    (void)store.apply(*command);
    require(store.content_bytes() <= limits.bytes);
  }
  scene::describe_store(store, [&](const scene::Command& command) { require(copy.apply(command).has_value()); });
  require(same_content(store, copy));
  const scene::ResolvedScene resolved = scene::resolve(store);
  for (const auto& mesh : resolved.meshes)
    for (const auto index : mesh.indices) require(index < mesh.vertices.size());
}

/// Pieces of the input as messages: a length, then its bytes.
template <class Take>
void each_message(std::span<const std::byte> bytes, Take take) {
  ByteReader in(bytes);
  while (!in.at_end() && in.ok()) {
    const std::size_t size = in.get<std::uint16_t>();
    take(in.take(std::min(size, in.remaining())));
  }
}

void talk_to_server(std::span<const std::byte> bytes) {
  scene::Store store(limits);
  replication::ReplicationServer server(store, 1, {.waiting_requests = 1000});
  for (const auto& command : {scene::Command(scene::NodeCreate{1, scene::NodeType::geometry}),
                              scene::Command(scene::GeometrySizeSet{1, 100, 100}),
                              scene::Command(scene::NodeCreate{2, scene::NodeType::object})})
    require(store.apply(command).has_value());
  server.connect(1, "fuzzer");
  each_message(bytes, [&](std::span<const std::byte> message) {
    const auto batch = server.receive(1, message);
    if (!batch) return;
    for (const auto& command : batch->changes)
      if (store.apply(command)) server.applied(command);
    server.pump(1, 4096, [](std::span<const std::byte>) { return true; });
  });
}

void talk_to_client(std::span<const std::byte> bytes) {
  replication::ReplicationClient client({}, limits);
  client.connected();
  (void)client.receive(replication::encode(replication::Welcome{1, false, 0}));
  each_message(bytes, [&](std::span<const std::byte> message) {
    (void)client.receive(message);
    client.pump([](std::span<const std::byte>) { return true; });
    require(client.store().content_bytes() <= limits.bytes);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::byte> rest(reinterpret_cast<const std::byte*>(data) + 1, size - 1);
  switch (data[0] % 3) {
    case 0:
      fill_store(rest);
      break;
    case 1:
      talk_to_server(rest);
      break;
    default:
      talk_to_client(rest);
      break;
  }
  return 0;
}
