#include "command-line/command/rig_command.hpp"

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/rig/rig.hpp"
#include "program/resources.hpp"
#include "sim-server/host/rig_keys.hpp"

namespace septet::server {
namespace {

Expected<std::vector<std::string>> write_keys(const std::string& name, const std::filesystem::path& out) {
  const auto file = program::find_resource(name, "rigs", ".toml");
  if (!file) return tl::unexpected(file.error());
  const auto text = read_regular_file(*file);
  if (!text) return tl::unexpected(text.error());
  const auto rig = rig::read_rig(*text, file->string());
  if (!rig) return tl::unexpected(rig.error());
  return write_rig_keys(*rig, out);
}

}  // namespace

Expected<int> run_rig_keys(const std::string& rig, const std::filesystem::path& out) {
  const auto said = write_keys(rig, out);
  if (!said) return tl::unexpected(said.error());
  for (const auto& line : *said) fmt::print("{}\n", line);
  return 0;
}

}  // namespace septet::server
