#include "sim-client/film/accident/read_plan.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/road/opendrive_reader.hpp"

namespace septet::film {

Solids solids_of(const logging::SessionInfo& info) {
  const auto file = std::ranges::find(info.files, "road", &logging::SourceFile::role);
  if (file == info.files.end()) return Solids(nullptr);
  const auto roads = road::read_opendrive(file->content, file->name);
  if (!roads) return Solids(nullptr);
  const auto seed = info.seeds.find("drive");
  return Solids(std::make_shared<const roadside::Obstacles>(*roads, seed == info.seeds.end() ? 1 : seed->second));
}

Expected<PlannedAccident> read_plan(const logging::SessionReader& session, std::optional<std::size_t> event,
                                    double width_over_height) {
  auto facts = read_accident(session, event);
  if (!facts) return tl::unexpected(facts.error());
  AccidentPlan plan = plan_accident(*facts, solids_of(session.info()), width_over_height);
  if (plan.script.shots.empty())
    return failure("it is too short for a film of an accident", session.path().string(),
                   "film it by a script of your own: septet film --shots");
  return PlannedAccident{std::move(*facts), std::move(plan)};
}

}  // namespace septet::film
