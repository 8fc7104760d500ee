#include <cmath>
#include <limits>

#include "engine/scenario/entity.hpp"

namespace septet::scenario {
namespace {

ParticipantKind kind_of(const Entity& entity) {
  if (entity.kind == EntityKind::pedestrian) return ParticipantKind::pedestrian;
  if (entity.kind == EntityKind::misc_object) return ParticipantKind::object;
  if (entity.role == "ambulance") return ParticipantKind::ambulance;
  return kind_of_category(entity.category);
}

double difference_m(const VehicleModel& model, const BoundingBox& box) {
  return std::abs(model.length_m - box.length_m) + std::abs(model.width_m - box.width_m) +
         std::abs(model.height_m - box.height_m);
}

}  // namespace

ParticipantKind kind_of_category(std::string_view category) {
  if (category == "van") return ParticipantKind::van;
  if (category == "bus") return ParticipantKind::bus;
  if (category == "motorbike") return ParticipantKind::motorcycle;
  if (category == "bicycle") return ParticipantKind::bicycle;
  const bool heavy = category == "truck" || category == "semitrailer" || category == "trailer";
  return heavy ? ParticipantKind::lorry : ParticipantKind::car;
}

ModelIndex match_vehicle_model(const Entity& entity) {
  if (const auto same_name = find_vehicle_model(entity.type_name)) return *same_name;
  const ParticipantKind kind = kind_of(entity);
  const auto models = vehicle_models();
  ModelIndex best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < models.size(); ++i) {
    // Another kind is only taken where there is none of the right one.
    const double difference = difference_m(models[i], entity.box) + (models[i].kind == kind ? 0.0 : 1e6);
    if (difference < least) {
      least = difference;
      best = static_cast<ModelIndex>(i);
    }
  }
  return best;
}

}  // namespace septet::scenario
