#include "engine/world/snapshot.hpp"

#include <algorithm>

namespace septet {
namespace {

auto* find_in(auto& participants, ParticipantId id) {
  const auto found = std::ranges::lower_bound(participants, id, {}, &Participant::id);
  return found != participants.end() && found->id == id ? &*found : nullptr;
}

}  // namespace

const Participant* find_participant(const std::vector<Participant>& participants, ParticipantId id) {
  return find_in(participants, id);
}
Participant* find_participant(std::vector<Participant>& participants, ParticipantId id) {
  return find_in(participants, id);
}
const Participant* find_participant(const Snapshot& snapshot, ParticipantId id) {
  return find_in(snapshot.participants, id);
}

}  // namespace septet
