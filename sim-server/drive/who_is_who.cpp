#include "sim-server/drive/who_is_who.hpp"

#include <cstddef>
#include <utility>

#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"
#include "engine/world/kind_name.hpp"
#include "engine/world/vehicle_body.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::server {

std::vector<std::pair<ParticipantId, std::string>> participant_names(const simulation::Model& model) {
  std::vector<std::pair<ParticipantId, std::string>> names;
  const auto& entities = model.scenario.entities;
  names.reserve(entities.size());
  for (scenario::EntityIndex i = 0; i < entities.size(); ++i)
    names.emplace_back(simulation::number_of(model, i), entities[i].name);
  return names;
}

std::map<std::string, std::string> who_is_who(const simulation::Model& model) {
  document::Json models = document::Json::array(), names = document::Json::object();
  for (const VehicleModel& vehicle : vehicle_models()) {
    document::Json row;
    row["name"] = vehicle.name;
    row["kind"] = name_of(vehicle.kind);
    row["length_m"] = vehicle.length_m;
    row["width_m"] = vehicle.width_m;
    row["height_m"] = vehicle.height_m;
    row["clearance_m"] = vehicle_body(vehicle.kind).clearance_m;
    row["wheelbase_m"] = vehicle.wheelbase_m;
    row["rear_overhang_m"] = vehicle.rear_overhang_m;
    row["track_m"] = vehicle.track_m;
    row["wheel_radius_m"] = vehicle.wheel_radius_m;
    models.push_back(std::move(row));
  }
  for (auto& [id, name] : participant_names(model)) names[std::to_string(id)] = std::move(name);
  return {{"vehicle_models", document::text_of(models)}, {"participant_names", document::text_of(names)}};
}

}  // namespace septet::server
