#include "engine/world/kind_name.hpp"

namespace septet {

std::string_view name_of(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::car:
      return "car";
    case ParticipantKind::van:
      return "van";
    case ParticipantKind::lorry:
      return "lorry";
    case ParticipantKind::bus:
      return "bus";
    case ParticipantKind::motorcycle:
      return "motorcycle";
    case ParticipantKind::bicycle:
      return "bicycle";
    case ParticipantKind::pedestrian:
      return "pedestrian";
    case ParticipantKind::ambulance:
      return "ambulance";
    case ParticipantKind::object:
      break;
  }
  return "object";
}

}  // namespace septet
