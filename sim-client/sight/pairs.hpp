#pragma once
/// Choice of the pairs whose sight is worked out, from a session's participants and events.

#include <optional>
#include <string>
#include <vector>

#include "logging/session/participants.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::sight {

struct PairChoice {
  std::string eyes, target;  ///< Names or numbers, or "driver"; empty: not given.
  double from_s = 0.0, to_s = 0.0;
  double range_m = 100.0;
  std::size_t most = 6;
};

/// Two participants, and their contact, if the log has one.
struct ChosenPair {
  logging::Stay first, second;
  std::optional<double> contact_s;  ///< The first one.
};

/// False for objects and towed vehicles.
bool has_eyes(const logging::Stay& stay);

/// Chosen pairs: those of collisions first, then by least distance. With both names that pair; with one, everybody who
/// comes within range of them; without, of the driver's car. A rider is chosen by his machine's number, which stands for
/// him also when he has left it, unless he is named himself. Errors: an unknown name, nobody within range, damage.
Expected<std::vector<ChosenPair>> choose_pairs(const logging::SessionReader& session, const PairChoice& choice);

}  // namespace septet::sight
