#include "engine/scene/command_codec.hpp"

#include "engine/scene/command_fields.hpp"
#include "engine/scene/command_validation.hpp"

namespace septet::scene {
namespace {

tl::unexpected<Error> bad_bytes(const char* what) {
  return failure(what, "bytes of a node command", "send commands as COMMANDS.md specifies them");
}

}  // namespace

void encode(const Command& command, Bytes& out) {
  Writer writer{ByteWriter(out)};
  variant(writer, command);
}

Expected<Command> decode(ByteReader& in) {
  Reader reader{in};
  Command command;
  variant(reader, command);
  if (!in.ok()) return bad_bytes("a command is truncated or out of range");
  if (auto valid = validate(command); !valid) {
    in.fail();
    return tl::unexpected(valid.error());
  }
  return command;
}

Expected<Command> decode(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  Expected<Command> command = decode(in);
  if (command && !in.at_end()) return bad_bytes("bytes follow a command");
  return command;
}

}  // namespace septet::scene
