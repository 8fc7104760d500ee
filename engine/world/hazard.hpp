#pragma once
/// A hazard: what begins to endanger the driver at a known instant, so that his reaction can be timed from the first
/// moment at which he could see it. As the log's text of the event `hazard`, whose participant is the hazard (or nobody: fog,
/// ice):
///
///     known=0 name="ball and child"
///
/// Pure functions.

#include <optional>
#include <string>
#include <string_view>

namespace septet {

struct HazardNote {
  bool known = false;  ///< The driver has it before his eyes as it begins, or had it shortly before.
  std::string name;
};

inline constexpr std::string_view hazard_event = "hazard";

inline std::string text_of(const HazardNote& note) {
  return (note.known ? "known=1 name=\"" : "known=0 name=\"") + note.name + '"';
}

/// Empty: another form.
inline std::optional<HazardNote> read_hazard_note(std::string_view text) {
  constexpr std::string_view known = "known=1 name=\"", unknown = "known=0 name=\"";
  const bool is_known = text.starts_with(known);
  if (!(is_known || text.starts_with(unknown)) || text.size() <= known.size() || !text.ends_with('"'))
    return std::nullopt;
  text.remove_prefix(known.size());
  text.remove_suffix(1);
  return HazardNote{is_known, std::string(text)};
}

}  // namespace septet
