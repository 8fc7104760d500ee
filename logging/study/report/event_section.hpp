#pragma once
/// The events of a drive on its page: a strip of the time line for each kind, below the speed and as long as it, and a
/// table of times and texts.

#include <span>
#include <string>

#include "engine/document/chart_axis.hpp"
#include "logging/study/report/told_event.hpp"

namespace septet::logging {

/// More rows of one kind are counted and not listed, so that an hour of glances stays a page.
inline constexpr std::size_t most_listed_events = 60;

/// An `svg` element on the time axis of a line chart over `time_s`; empty without events.
std::string event_strip(std::span<const ToldEvent> events, document::Range time_s);

/// Heading and table; empty without events.
std::string event_table(std::span<const ToldEvent> events);

}  // namespace septet::logging
