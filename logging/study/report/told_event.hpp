#pragma once
/// The events of a log for people: their row on the page, and their text.

#include <string>
#include <string_view>
#include <vector>

#include "logging/session/participants.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// Events that share one row below the speed.
struct EventRow {
  std::string_view title;  ///< "lane changes".
  std::string_view sign;   ///< On the route; empty: a dot alone.
};

struct ToldEvent {
  double time_s = 0.0;
  const EventRow* row = nullptr;
  std::string says;  ///< Plain text, not escaped.
};

/// In the order of the log. Every event is included, also one known to the scenario alone. `names`: of the session.
std::vector<ToldEvent> tell_events(const std::vector<Event>& events, const ParticipantNames& names);

/// All rows, from the top of the page down.
const std::vector<EventRow>& event_rows();

}  // namespace septet::logging
