#include "sim-server/command/replay_command.hpp"

#include <fmt/core.h>

#include "logging/session_reader.hpp"
#include "sim-server/drive_loader.hpp"
#include "sim-server/traffic_choice.hpp"

namespace septet::server {
namespace {

struct Verified {
  std::uint64_t ticks = 0;
};

Expected<Verified> verify(const std::filesystem::path& file) {
  const auto session = logging::SessionReader::open(file);
  if (!session) return tl::unexpected(session.error());
  const auto drive = load_drive(session->info());
  if (!drive) return tl::unexpected(drive.error());
  const auto inputs = session->inputs();
  if (!inputs) return tl::unexpected(inputs.error());
  auto recorded = session->snapshots();
  if (!recorded) return tl::unexpected(recorded.error());
  const auto& other = session->info().other;
  const auto engine = other.find("traffic");
  auto traffic = open_traffic(engine == other.end() ? "own" : engine->second, *drive->model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto state = initial_state(*drive->model, std::move(*traffic));
  if (!state) return tl::unexpected(state.error());

  Verified result;
  const auto compare = [&](std::uint64_t hash) -> Expected<bool> {
    const auto snapshot = recorded->next();
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (!*snapshot) return false;
    if ((*snapshot)->tick != state->tick || (*snapshot)->state_hash != hash)
      return failure(fmt::format("tick {} gives state hash {:016x}, recorded is {:016x} of tick {}", state->tick, hash,
                                 (*snapshot)->state_hash, (*snapshot)->tick),
                     file.string(), "it was recorded by another build, or on a processor whose arithmetic differs");
    return true;
  };
  auto go_on = compare(hash_state(*state));
  std::vector<SimulationEvent> events;
  for (const auto& input : *inputs) {
    if (!go_on) return tl::unexpected(go_on.error());
    if (!*go_on) break;
    events.clear();
    const Snapshot snapshot = server_step(*drive->model, input.input, *state, events);
    if (auto error = state->traffic->take_error()) return tl::unexpected(std::move(*error));
    go_on = compare(snapshot.state_hash);
    ++result.ticks;
  }
  if (!go_on) return tl::unexpected(go_on.error());
  return result;
}

}  // namespace

int run_verify(const std::filesystem::path& session) {
  const auto result = verify(session);
  if (!result) {
    fmt::print(stderr, "septet: {}\n", describe(result.error()));
    return 1;
  }
  fmt::print("{} ticks run again: every state hash agrees\n", result->ticks);
  return 0;
}

}  // namespace septet::server
