#pragma once
/// Numbers of participants that are solids: boxes in the place of things that an editor has put into the scene. The
/// scene draws the things; as participants they are met, seen by drivers and logged, and never drawn.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/world/lamps.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

inline constexpr std::uint32_t most_solids = 64;
/// Above the numbers of all who drive, walk or ride.
inline constexpr ParticipantId first_solid_participant = 32768;

constexpr bool is_solid(ParticipantId id) {
  return id >= first_solid_participant && id - first_solid_participant < most_solids;
}

/// True for a solid with a mass that no motion leads: its thing is drawn where this box is (engine/scene/pushable_box.hpp).
/// Its brake lamp is lit, as that of a vehicle that has left its rails.
inline bool is_free_solid(const Participant& participant) {
  return is_solid(participant.id) && participant.lamps.has(Lamp::brake);
}

/// A command's text, and the name with which it ends: ` name="NAME"`; empty where it has none.
struct NamedText {
  std::string_view before, name;
};
NamedText split_name(std::string_view command);
/// True where a command's text can have it: printable, not too long, without a quotation mark. Empty: it has none.
bool is_name_of_thing(std::string_view name);

/// What the command says that stands a solid (engine/simulation/solids.hpp): its number as a participant, and the name
/// of the thing in whose place it stands.
struct NamedSolid {
  ParticipantId participant = 0;
  std::string_view name;  ///< Within the command's text.
};
/// Empty: the text is of another command, or names nothing (sessions of earlier builds).
std::optional<NamedSolid> named_solid(std::string_view command);

/// The last pair of a contact's detail in the log, with the blank before it: ` what="NAME"`.
std::string name_of_struck(std::string_view name);
/// The name in it; empty: the detail has none.
std::optional<std::string> struck_by_name(std::string_view detail);

}  // namespace septet
