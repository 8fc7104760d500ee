#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "engine/scenario/model/entity.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::scenario {
namespace {

ParticipantKind kind_of(const Entity& entity) {
  if (entity.kind == EntityKind::pedestrian) return ParticipantKind::pedestrian;
  if (entity.role == "ambulance") return ParticipantKind::ambulance;
  if (entity.role == "fire") return ParticipantKind::lorry;
  return kind_of_category(entity.category);
}

/// Words of a name outside the catalogue that suggest one model of the category. The first match counts.
struct Word {
  std::string_view category, word, model;
};
constexpr std::array<Word, 19> words{{
    {"car", "police", "police-car"},   {"car", "taxi", "taxi"},
    {"car", "pick", "pick-up"},        {"car", "coupe", "coupe"},
    {"car", "sport", "sports-car"},    {"car", "mpv", "mpv"},
    {"van", "police", "police-van"},   {"van", "minibus", "minibus"},
    {"van", "truck", "box-van"},       {"truck", "fire", "fire-engine"},
    {"truck", "tank", "tanker"},       {"truck", "tipper", "tipper"},
    {"truck", "dump", "tipper"},       {"truck", "timber", "timber-lorry"},
    {"truck", "farm", "farm-tractor"}, {"truck", "tractor", "tractor-unit"},
    {"bus", "coach", "coach"},         {"trailer", "caravan", "caravan"},
    {"trailer", "car_", "caravan"},
}};

/// The model that role, category and name suggest, before any measures are compared.
std::string_view told_model(const Entity& entity) {
  if (entity.role == "police") return entity.category == "van" ? "police-van" : "police-car";
  if (entity.role == "fire") return "fire-engine";
  std::string name;
  for (const char c : entity.type_name) name.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  for (const Word& word : words)
    if (word.category == entity.category && name.find(word.word) != std::string::npos) return word.model;
  if (entity.category == "semitrailer") return "semitrailer";
  if (entity.category == "trailer") return entity.box.length_m < 7.5 ? "caravan" : "semitrailer";
  return {};
}

/// True for models that are never chosen by their measures alone.
bool is_told_by_name_alone(std::string_view model) {
  for (const std::string_view name :
       {"taxi", "police-car", "police-van", "fire-engine", "farm-tractor", "caravan", "semitrailer", "tractor-unit",
        "tanker", "tipper", "bicycle-alone", "motorcycle-alone", "box"})
    if (model == name) return true;
  return false;
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
  if (entity.kind == EntityKind::misc_object) return box_model();
  if (const auto same_name = find_vehicle_model(entity.type_name)) return *same_name;
  if (entity.kind == EntityKind::vehicle)
    if (const auto told = find_vehicle_model(told_model(entity))) return *told;
  const ParticipantKind kind = kind_of(entity);
  const auto models = vehicle_models();
  ModelIndex best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (is_told_by_name_alone(models[i].name)) continue;
    // Another kind is chosen only where there is none of the right one.
    const double difference = difference_m(models[i], entity.box) + (models[i].kind == kind ? 0.0 : 1e6);
    if (difference < least) {
      least = difference;
      best = static_cast<ModelIndex>(i);
    }
  }
  return best;
}

}  // namespace septet::scenario
