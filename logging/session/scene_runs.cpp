#include "logging/session/scene_runs.hpp"

#include <span>
#include <string>
#include <utility>
#include <variant>

#include <fmt/core.h>
#include <zlib.h>

#include "engine/core/check.hpp"
#include "engine/core/printable.hpp"
#include "engine/scene/command_codec.hpp"

namespace septet::logging {
namespace {

constexpr std::size_t large_run_bytes = std::size_t{256} << 10;
/// A large run's last command may be the longest there is: 262,144 numbers or 1 MiB of tiles (COMMANDS.md).
constexpr std::size_t max_run_bytes = std::size_t{4} << 20;
constexpr std::size_t max_scene_bytes = std::size_t{512} << 20;
constexpr int packing_level = 3;
constexpr int first_format_with_runs = 3;

auto damaged(Tick tick, std::string what) {
  return failure(std::move(what), fmt::format("scene of tick {}", tick),
                 "the file was altered or damaged: use an unaltered copy");
}

/// Empty unless the bytes are a whole run.
Bytes inflated(std::span<const std::byte> data) {
  ByteReader reader(data);
  Bytes commands(reader.get_count(max_run_bytes));
  const auto packed = reader.take(reader.remaining());
  auto size = static_cast<uLongf>(commands.size());
  const int result = uncompress(reinterpret_cast<Bytef*>(commands.data()), &size,
                                reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  return reader.ok() && result == Z_OK && size == commands.size() ? commands : Bytes{};
}

/// Its last name; where it has none, its number.
std::string name_of(scene::NodeId node, std::span<const SceneEdit> edits) {
  if (node == scene::no_node) return "a node";
  std::string name;
  for (const SceneEdit& edit : edits) {
    const auto command = edited_node(edit.command) == node ? scene::decode(edit.command) : failure("", "", "");
    if (!command) continue;
    if (const auto* named = std::get_if<scene::NodeNameSet>(&*command)) name = named->name;
  }
  return name.empty() ? fmt::format("node #{}", node) : fmt::format("\"{}\"", printable(name));
}

/// `edits`: all so far, of which those from `first` on are the run's.
Expected<void> check_fingerprints(const SceneRun& run, std::span<const SceneEdit> edits, std::size_t first) {
  EditFingerprints found;
  for (const SceneEdit& edit : edits.subspan(first)) found.add(edit.tick, edit.command);
  const auto altered = found.altered_node(*run.fingerprints);
  if (!altered) return {};
  return damaged(run.tick, fmt::format("the edit of {} from tick {} on is not the one that was made",
                                       name_of(*altered, edits), run.tick));
}

}  // namespace

bool SceneRunPacker::has_room_for(const SceneEdit& edit) const {
  return commands_.empty() || (edit.tick == tick_ && commands_.size() < large_run_bytes);
}

void SceneRunPacker::add(const SceneEdit& edit) {
  SEPTET_CHECK(has_room_for(edit), "a command of tick {} in a run of tick {}, {} bytes", edit.tick, tick_,
               commands_.size());
  tick_ = edit.tick;
  if (edit.tick > 0) fingerprints_.add(edit.tick, edit.command);
  ByteWriter writer(commands_);
  writer.put_varint(edit.command.size());
  writer.put_bytes(edit.command);
}

SceneRun SceneRunPacker::take() {
  SceneRun run{tick_, {}};
  if (!fingerprints_.is_empty()) run.fingerprints = fingerprints_.to_bytes();
  fingerprints_ = {};
  ByteWriter(run.data).put_varint(commands_.size());
  const std::size_t header_bytes = run.data.size();
  auto size = compressBound(static_cast<uLong>(commands_.size()));
  run.data.resize(header_bytes + size);
  const int result =
      compress2(reinterpret_cast<Bytef*>(run.data.data() + header_bytes), &size,
                reinterpret_cast<const Bytef*>(commands_.data()), static_cast<uLong>(commands_.size()), packing_level);
  SEPTET_CHECK(result == Z_OK, "deflating {} bytes: {}", commands_.size(), result);
  run.data.resize(header_bytes + size);
  commands_.clear();
  return run;
}

Expected<void> SceneUnpacker::unpack(const SceneRun& run, std::vector<SceneEdit>& out) {
  if (session_format_ < first_format_with_runs) return append(run.tick, run.data, out);
  const Bytes commands = inflated(run.data);
  if (commands.empty()) return damaged(run.tick, "its commands do not unpack");
  const std::size_t first = out.size();
  ByteReader reader(commands);
  while (!reader.at_end()) {
    const auto command = reader.take(reader.get_count(max_run_bytes));
    if (!reader.ok()) return damaged(run.tick, "its last command is cut off");
    if (auto done = append(run.tick, command, out); !done) return done;
  }
  return run.fingerprints ? check_fingerprints(run, out, first) : Expected<void>{};
}

Expected<void> SceneUnpacker::append(Tick tick, std::span<const std::byte> command, std::vector<SceneEdit>& out) {
  held_bytes_ += sizeof(SceneEdit) + command.size();
  if (held_bytes_ > max_scene_bytes)
    return damaged(tick, fmt::format("its scene takes more than {} MiB", max_scene_bytes >> 20));
  out.push_back({tick, {command.begin(), command.end()}});
  return {};
}

}  // namespace septet::logging
