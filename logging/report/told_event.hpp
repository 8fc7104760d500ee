#pragma once
/// The events of a log for people: of which row of the page they are, and in words what happened.

#include <string>
#include <string_view>
#include <vector>

#include "logging/records.hpp"

namespace septet::logging {

/// What belongs together in one row below the speed.
struct EventRow {
  std::string_view title;  ///< "lane changes".
  std::string_view sign;   ///< On the route; empty: a dot alone.
};

struct ToldEvent {
  double time_s = 0.0;
  const EventRow* row = nullptr;
  std::string says;  ///< Plain text, not escaped.
};

/// In the order of the log. Every event is told, also one whose word only the scenario knows.
std::vector<ToldEvent> tell_events(const std::vector<Event>& events);

/// All rows, from the top of the page down.
const std::vector<EventRow>& event_rows();

}  // namespace septet::logging
