#include "engine/simulation/broken_off.hpp"

#include <optional>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"

namespace septet::simulation {
namespace {

std::optional<PushedByPieces> pushed(ParticipantId id, const Vec3& impulse_ns, std::vector<Participant>& participants,
                                     State& state) {
  LooseBody* loose = find_loose(state, id);
  if (!loose) return std::nullopt;
  const impact::Body before = loose->body;
  push(impulse_ns, *loose);
  if (Participant* shown = find_participant(participants, id)) *shown = participant_of(*loose);
  return PushedByPieces{before, loose->body};
}

}  // namespace

void give_back(const BrokenOff& broken, const PushedByPieces& own, std::vector<Participant>& participants,
               State& state) {
  const auto side = [&](ParticipantId id, const Vec3& impulse_ns) {
    return id == driver_participant ? std::optional(own) : pushed(id, impulse_ns, participants, state);
  };
  const auto first = side(broken.first, broken.on_first_ns);
  const auto second = broken.second ? side(*broken.second, broken.on_second_ns) : std::nullopt;
  note_broken_off(broken, first, second, state);
}

}  // namespace septet::simulation
