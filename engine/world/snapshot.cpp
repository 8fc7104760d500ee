#include "engine/world/snapshot.hpp"

#include <algorithm>

namespace septet {

const Participant* find_participant(const Snapshot& snapshot, ParticipantId id) {
  const auto& all = snapshot.participants;
  const auto found = std::ranges::lower_bound(all, id, {}, &Participant::id);
  return found != all.end() && found->id == id ? &*found : nullptr;
}

}  // namespace septet
