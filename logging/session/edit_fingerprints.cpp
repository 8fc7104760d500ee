#include "logging/session/edit_fingerprints.hpp"

#include <algorithm>

namespace septet::logging {
namespace {

std::uint32_t fingerprint_of(const StateHash& hash) {
  return static_cast<std::uint32_t>(hash.value() ^ hash.value() >> 32);
}

}  // namespace

/// Every command but a subscription, which no log has, begins with its opcode and its node (COMMANDS.md).
scene::NodeId edited_node(std::span<const std::byte> command) {
  ByteReader in(command);
  in.get<std::uint8_t>();
  const std::uint64_t code = in.get_varint();
  return in.ok() ? static_cast<scene::NodeId>(code - 1) : scene::no_node;
}

void EditFingerprints::add(Tick tick, std::span<const std::byte> command) {
  StateHash& hash = nodes_[edited_node(command)];
  hash.add(tick);
  hash.add_bytes(command);
}

Bytes EditFingerprints::to_bytes() const {
  Bytes bytes;
  ByteWriter out(bytes);
  scene::NodeId previous = 0;
  for (const auto& [node, hash] : nodes_) {
    out.put_varint(node - previous);
    out.put(fingerprint_of(hash));
    previous = node;
  }
  return bytes;
}

std::optional<scene::NodeId> EditFingerprints::altered_node(std::span<const std::byte> bytes) const {
  ByteReader in(bytes);
  scene::NodeId logged = 0;
  for (const auto& [node, hash] : nodes_) {
    if (in.at_end()) return node;
    logged += static_cast<scene::NodeId>(in.get_varint());
    const auto fingerprint = in.get<std::uint32_t>();
    if (!in.ok()) return scene::no_node;
    if (logged != node) return std::min(logged, node);
    if (fingerprint != fingerprint_of(hash)) return node;
  }
  if (in.at_end()) return std::nullopt;
  logged += static_cast<scene::NodeId>(in.get_varint());
  return in.ok() ? logged : scene::no_node;
}

}  // namespace septet::logging
