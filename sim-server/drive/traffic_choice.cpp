#include "sim-server/drive/traffic_choice.hpp"

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "sim-server/sumo/sumo_process.hpp"
#include "sim-server/sumo/sumo_traffic.hpp"

namespace septet::server {

Expected<void> check_traffic(const std::string& name) {
  if (name == "own" || name == "sumo") return {};
  return failure(fmt::format("there is no traffic engine \"{}\"", printable(name)), "--traffic", "use own or sumo");
}

Expected<std::unique_ptr<traffic::TrafficEngine>> open_traffic(const std::string& name,
                                                               const simulation::Model& model) {
  if (auto known = check_traffic(name); !known) return tl::unexpected(known.error());
  if (name == "own") return traffic::own_traffic(model.roads, model.seed);
  SumoNetwork network = make_sumo_network(model.roads);
  auto process = SumoProcess::start(network, {.step_s = sumo_step_s, .seed = model.seed});
  if (!process) return tl::unexpected(process.error());
  std::shared_ptr<SumoProcess> running = std::move(*process);
  std::shared_ptr<SumoClient> client(running, &running->client());  // The process lives as long as its client.
  return std::make_unique<SumoTraffic>(model.roads, std::move(network), std::move(client), model.seed);
}

}  // namespace septet::server
