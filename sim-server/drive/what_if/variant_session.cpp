#include "sim-server/drive/what_if/variant_session.hpp"

#include <string>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "engine/core/hash.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/server_step.hpp"
#include "logging/session/input_hash.hpp"
#include "logging/session/recorded_scene.hpp"
#include "sim-server/drive/kept_state.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/drive/traffic_choice.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

std::string text_of(std::span<const InputChange> changes) {
  std::string text;
  for (const InputChange& change : changes) text += (text.empty() ? "" : " ") + text_of(change);
  return text;
}

/// Removes an earlier variant's session.
Expected<void> make_room(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  const auto earlier = logging::SessionReader::open(file);
  if (!earlier || !earlier->info().other.contains(variant_changes_row))
    return failure("this is no variant of a drive, and is not replaced", file.string(),
                   "give another folder with --out");
  for (const char* ending : {"", "-wal", "-shm"})
    if (fs::remove(file.string() + ending, error); error) return failure(error.message(), file.string(), "remove it");
  return {};
}

/// Rows that say which variant of which session this is.
std::map<std::string, std::string> variant_meta(const logging::SessionReader& source, const WhatIf& what_if,
                                                std::span<const InputChange> changes) {
  StateHash inputs;
  for (const auto& input : what_if.recorded.inputs) logging::add_to_hash(input, inputs);
  std::map<std::string, std::string> meta{
      {variant_changes_row, text_of(changes)},
      {"what_if_source_started_utc", source.info().started_utc},
      {"what_if_source_inputs_hash", fmt::format("{:016x}", inputs.value())},
      {"what_if_begin_hash", fmt::format("{:016x}", what_if.begin_hash)},
  };
  if (const auto driver = source.info().other.find("driver"); driver != source.info().other.end()) meta.insert(*driver);
  return meta;
}

}  // namespace

Expected<fs::path> write_variant_session(const logging::SessionReader& source, const WhatIf& what_if,
                                         std::span<const InputChange> changes, const fs::path& folder) {
  const auto placed = place_changes(what_if, changes);
  if (!placed) return tl::unexpected(placed.error());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(error.message(), folder.string(), "choose a folder that can be written with --out");
  const fs::path file = folder / variant_session_name;
  if (auto room = make_room(file); !room) return tl::unexpected(room.error());

  const LoadedDrive& loaded = what_if.recorded.loaded;
  auto traffic = open_traffic(what_if.recorded.traffic, *loaded.model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto state = kept_state(source, *loaded.model, static_cast<double>(what_if.begin) / simulation::tick_rate_hz,
                          std::move(*traffic));
  if (!state) return tl::unexpected(state.error());
  scene::Store store;
  if (auto restored = logging::restore_scene(source, store); !restored) return tl::unexpected(restored.error());
  const auto live = LiveDrive::start(loaded.model, std::move(*state), {});
  const ServerOptions options{
      .out = folder, .seed = loaded.model->seed, .traffic = what_if.recorded.traffic, .no_screens = true};
  auto log = SessionLog::create(loaded, options, what_if.begin,
                                {variant_session_name, variant_meta(source, what_if, changes)});
  if (!log) return tl::unexpected(log.error());
  log->record_scene(store);
  live->log_to(*log);
  const auto& commands = what_if.recorded.commands;
  std::size_t command = first_command_after(what_if.recorded, what_if.begin);
  ServeResult result{.end = logging::DriveEnd::time_over};
  while (live->state().tick < what_if.end) {
    const Tick next = live->state().tick + 1;
    for (; command < commands.size() && commands[command].before <= next; ++command)
      if (auto done = live->command(commands[command].command); !done) return tl::unexpected(done.error());
    if (next == what_if.fork + 1 && !changes.empty()) log->record_message("what_if", text_of(changes));
    const auto made = live->next(changed_input(what_if.known(), *placed, next));
    if (!made) return tl::unexpected(made.error());
    if (!*made) {
      result.end = live->end();
      break;
    }
    if (auto failed = live->take_error()) return tl::unexpected(std::move(*failed));
  }
  result.ticks = live->state().tick - what_if.begin;
  result.simulated_s = live->state().time_s();
  result.state_hash = live->newest().state_hash;
  live->log_unfinished();
  if (auto finished = log->finish(log->outcome(result, {})); !finished) return tl::unexpected(finished.error());
  return file;
}

}  // namespace septet::server
