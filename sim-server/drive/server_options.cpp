#include "sim-server/drive/server_options.hpp"

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "logging/session/subject.hpp"
#include "program/resources.hpp"
#include "sim-server/drive/traffic_choice.hpp"

namespace septet::server {

Expected<void> check_names(const ServerOptions& options) {
  if (!options.driver.empty())
    if (const auto driver = driver::find_driver(options.driver); !driver)
      return failure(driver.error().what, "--driver", driver.error().remedy);
  if (auto traffic = check_traffic(options.traffic); !traffic) return traffic;
  const auto characters = printable_characters(options.participant);
  if (!characters || *characters > most_participant_characters)
    return failure(
        fmt::format("\"{}\" is no participant's code", printable(options.participant)), "--participant",
        fmt::format("use at most {} characters, none of them a control character", most_participant_characters));
  logging::Subject subject;
  for (const auto& text : options.about)
    if (auto added = add_to_subject(subject, text); !added) return added;
  return {};
}

Expected<void> find_files(ServerOptions& options) {
  const auto rig = program::find_resource(options.rig, "rigs", ".toml");
  if (!rig) return tl::unexpected(rig.error());
  options.rig = rig->string();
  if (!options.replay.empty()) return {};
  const auto scenario = program::find_resource(options.scenario, "scenarios", ".xosc");
  if (!scenario) return tl::unexpected(scenario.error());
  options.scenario = scenario->string();
  return {};
}

}  // namespace septet::server
