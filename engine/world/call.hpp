#pragma once
/// A call: one message to all who listen to a drive, about a node of the scene or about none: a barrier is to lift, a sign
/// to switch. It comes from the storyboard, from an operator's page or from a script. A call changes nothing itself: those
/// who listen do. It is input of the drive, logged with its tick and made again when the drive is run again.
///
///     name=lift node=stimuli/barrier seconds=3 words="please wait" by=lab
///
/// Words of the form name=value; a value with a blank or a quote in it, or an empty one, stands in quotes, with \" and \\.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet {

struct Call {
  std::string name;  ///< Letters, digits, hyphens, underscores.
  std::string node;  ///< Name of the node that it is about; empty: none.
  /// By name (small letters, digits, underscores), each once, in the order given.
  std::vector<std::pair<std::string, std::string>> parameters;
  std::string by;  ///< Who calls: the name of a key or of an operator, or "storyboard".
  bool operator==(const Call&) const = default;
};

/// Kind of the event that tells of a call; its detail is the call's text.
inline constexpr std::string_view call_event = "call";
inline constexpr std::string_view storyboard_calls = "storyboard";
/// Bounds of a call; in bytes, of its name and its parameters' names, and of a value. Values are printable. With them a
/// call may have 3,600 bytes, so that it fits into an event on the wire.
inline constexpr std::size_t most_call_parameters = 16, longest_call_name = 40, longest_call_value = 180;

/// The call's words by name, in the order of its text.
std::vector<std::pair<std::string, std::string>> words_of(const Call& call);
std::string text_of(const Call& call);
/// Error: another form, a name that is missing or given twice, or a value beyond its bounds.
Expected<Call> read_call(std::string_view text);

}  // namespace septet
