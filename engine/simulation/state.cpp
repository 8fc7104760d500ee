#include "engine/simulation/state.hpp"

#include <fmt/core.h>

#include "engine/core/hash.hpp"

namespace septet::simulation {

void note_bad_numbers(std::uint32_t count, std::optional<ParticipantId> participant, const char* reset, State& state,
                      std::vector<Event>& events) {
  if (count == 0) return;
  state.diagnostics.bad_numbers += count;
  events.push_back({"bad_number", participant, fmt::format("count={} reset={}", count, reset)});
}

std::uint64_t hash_state(const State& state) {
  StateHash hash;
  hash.add(state.tick);
  vehicle::hash_state(hash, state.car);
  vehicle::hash_hull(hash, state.hull);
  scenario::add_to_hash(state.scenario, hash);
  state.traffic->add_to_hash(hash);
  hash.add(state.effects.hash);
  hash.add(state.diagnostics.collisions);
  hash.add(state.diagnostics.bad_numbers);
  return hash.value();
}

}  // namespace septet::simulation
