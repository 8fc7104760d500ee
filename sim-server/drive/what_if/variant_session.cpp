#include "sim-server/drive/what_if/variant_session.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/core/hash.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/deviation_text.hpp"
#include "engine/simulation/server_step.hpp"
#include "logging/session/input_hash.hpp"
#include "logging/session/recorded_scene.hpp"
#include "sim-server/drive/departing_drive.hpp"
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

/// One course of a session's drive: what it begins with, and what is told of it.
struct Course {
  LoadedDrive loaded;
  simulation::State state;
  Tick begin = 0, end = 0;
  std::uint64_t begin_hash = 0;
  std::vector<PlacedChange> placed;
  std::string changes;                      ///< In words.
  std::map<std::string, std::string> meta;  ///< Rows of its own.
};

/// Rows that say which variant of which session this is.
std::map<std::string, std::string> variant_meta(const logging::SessionReader& source, const WhatIf& what_if,
                                                const Course& course) {
  StateHash inputs;
  for (const auto& input : what_if.recorded.inputs) logging::add_to_hash(input, inputs);
  std::map<std::string, std::string> meta = course.meta;
  meta[variant_changes_row] = course.changes;
  meta["what_if_source_started_utc"] = source.info().started_utc;
  meta["what_if_source_inputs_hash"] = fmt::format("{:016x}", inputs.value());
  meta["what_if_begin_hash"] = fmt::format("{:016x}", course.begin_hash);
  if (const auto driver = source.info().other.find("driver"); driver != source.info().other.end()) meta.insert(*driver);
  return meta;
}

/// Runs the course to its end and writes it; an earlier variant's file is replaced.
Expected<fs::path> write_course(const logging::SessionReader& source, const WhatIf& what_if, Course course,
                                const fs::path& folder, const std::string& name) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(error.message(), folder.string(), "choose a folder that can be written with --out");
  const fs::path file = folder / name;
  if (auto room = make_room(file); !room) return tl::unexpected(room.error());
  scene::Store store;
  if (auto restored = logging::restore_scene(source, store); !restored) return tl::unexpected(restored.error());
  const auto live = LiveDrive::start(course.loaded.model, std::move(course.state), {});
  const ServerOptions options{
      .out = folder, .seed = course.loaded.model->seed, .traffic = what_if.recorded.traffic, .no_screens = true};
  auto log = SessionLog::create(course.loaded, options, course.begin, {name, variant_meta(source, what_if, course)});
  if (!log) return tl::unexpected(log.error());
  log->record_scene(store);
  live->log_to(*log);
  const auto& commands = what_if.recorded.commands;
  std::size_t command = first_command_after(what_if.recorded, course.begin);
  ServeResult result{.end = logging::DriveEnd::time_over};
  while (live->state().tick < course.end) {
    const Tick next = live->state().tick + 1;
    for (; command < commands.size() && commands[command].before <= next; ++command)
      if (auto done = live->command(commands[command].command); !done) return tl::unexpected(done.error());
    if (next == what_if.fork + 1 && !course.placed.empty()) log->record_message("what_if", course.changes);
    const auto made = live->next(changed_input(what_if.known(), course.placed, next));
    if (!made) return tl::unexpected(made.error());
    if (!*made) {
      result.end = live->end();
      break;
    }
    if (auto failed = live->take_error()) return tl::unexpected(std::move(*failed));
  }
  result.ticks = live->state().tick - course.begin;
  result.simulated_s = live->state().time_s();
  result.state_hash = live->newest().state_hash;
  live->log_unfinished();
  if (auto finished = log->finish(log->outcome(result, {})); !finished) return tl::unexpected(finished.error());
  return file;
}

}  // namespace

Expected<fs::path> write_variant_session(const logging::SessionReader& source, const WhatIf& what_if,
                                         std::span<const InputChange> changes, const fs::path& folder) {
  auto placed = place_changes(what_if, changes);
  if (!placed) return tl::unexpected(placed.error());
  const LoadedDrive& loaded = what_if.recorded.loaded;
  auto traffic = open_traffic(what_if.recorded.traffic, *loaded.model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto state = kept_state(source, *loaded.model, static_cast<double>(what_if.begin) / simulation::tick_rate_hz,
                          std::move(*traffic));
  if (!state) return tl::unexpected(state.error());
  return write_course(source, what_if,
                      {.loaded = loaded,
                       .state = std::move(*state),
                       .begin = what_if.begin,
                       .end = what_if.end,
                       .begin_hash = what_if.begin_hash,
                       .placed = std::move(*placed),
                       .changes = text_of(changes),
                       .meta = {}},
                      folder, variant_session_name);
}

Expected<fs::path> write_run_session(const logging::SessionReader& source, const WhatIf& what_if,
                                     const simulation::MotionDeviation& deviation, const fs::path& folder,
                                     const std::string& name) {
  const std::string departure = simulation::deviation_text(deviation);
  LoadedDrive loaded = departing_drive(what_if.recorded.loaded, deviation);
  auto traffic = open_traffic(what_if.recorded.traffic, *loaded.model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto state = simulation::initial_state(*loaded.model, std::move(*traffic));
  if (!state) return tl::unexpected(state.error());
  const std::uint64_t begin_hash = simulation::hash_state(*state);
  return write_course(source, what_if,
                      {.loaded = std::move(loaded),
                       .state = std::move(*state),
                       .begin = 0,
                       .end = std::min(what_if.end, what_if.recorded.inputs.back().tick),
                       .begin_hash = begin_hash,
                       .placed = {},
                       .changes = departure,
                       .meta = {{motion_deviation_row, departure}}},
                      folder, name);
}

}  // namespace septet::server
