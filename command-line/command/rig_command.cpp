#include "command-line/command/rig_command.hpp"

#include <utility>

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/rig/rig.hpp"
#include "program/resources.hpp"
#include "sim-server/host/rig_keys.hpp"

namespace septet::server {
namespace {

Expected<std::vector<std::string>> write_keys(const RigKeysOptions& options) {
  std::vector<EditorKey> editors;
  for (const std::string& text : options.editors) {
    auto editor = parse_editor_key(text);
    if (!editor) return tl::unexpected(editor.error());
    editors.push_back(std::move(*editor));
  }
  const auto file = program::find_resource(options.rig, "rigs", ".toml");
  if (!file) return tl::unexpected(file.error());
  const auto text = read_regular_file(*file);
  if (!text) return tl::unexpected(text.error());
  const auto rig = rig::read_rig(*text, file->string());
  if (!rig) return tl::unexpected(rig.error());
  return write_rig_keys(*rig, options.out, editors);
}

}  // namespace

Expected<int> run_rig_keys(const RigKeysOptions& options) {
  const auto said = write_keys(options);
  if (!said) return tl::unexpected(said.error());
  for (const auto& line : *said) fmt::print("{}\n", line);
  return 0;
}

}  // namespace septet::server
