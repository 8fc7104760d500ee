#include "engine/simulation/state.hpp"

#include <fmt/core.h>

namespace septet::simulation {

void note_bad_numbers(std::uint32_t count, std::optional<ParticipantId> participant, const char* reset, State& state,
                      std::vector<Event>& events) {
  if (count == 0) return;
  state.diagnostics.bad_numbers += count;
  events.push_back({"bad_number", participant, fmt::format("count={} reset={}", count, reset)});
}

}  // namespace septet::simulation
