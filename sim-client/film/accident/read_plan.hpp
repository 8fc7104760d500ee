#pragma once
/// Facts and plan of an accident from its session.

#include "sim-client/film/accident/accident_plan.hpp"

namespace septet::film {

struct PlannedAccident {
  AccidentFacts facts;
  AccidentPlan plan;
};

/// Reads the session's world for what stands there. Error: as read_accident, or a plan without a shot.
Expected<PlannedAccident> read_plan(const logging::SessionReader& session, std::optional<std::size_t> event,
                                    double width_over_height);

/// What stands in the session's world; nothing where its road cannot be read.
Solids solids_of(const logging::SessionInfo& info);

}  // namespace septet::film
