#include "engine/scene/content_hash.hpp"

#include "engine/core/bytes.hpp"
#include "engine/core/hash.hpp"
#include "engine/scene/command_codec.hpp"

namespace septet::scene {

std::uint64_t content_hash(const Store& store) {
  StateHash hash;
  Bytes bytes;
  describe_store(store, [&](const Command& command) {
    bytes.clear();
    encode(command, bytes);
    hash.add_bytes(bytes);
  });
  return hash.value();
}

}  // namespace septet::scene
