#include "sim-client/sight/pairs.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/world/rider.hpp"
#include "logging/study/measures/collisions.hpp"

namespace septet::sight {
namespace {

/// Least distances of everybody from one participant, between two times; riders by their machines' numbers.
Expected<std::map<ParticipantId, double>> distances_from(const logging::SessionReader& session, ParticipantId centre,
                                                         const PairChoice& choice) {
  std::map<ParticipantId, double> least_m;
  auto cursor = session.snapshots_from(choice.from_s);
  if (!cursor) return tl::unexpected(cursor.error());
  for (;;) {
    const auto world = cursor->next();
    if (!world) return tl::unexpected(world.error());
    if (!*world || (*world)->simulated_time_s > choice.to_s) return least_m;
    const Participant* from = find_person(**world, centre);
    if (!from) continue;
    for (const Participant& other : (*world)->participants) {
      const ParticipantId number = machine_of(other.id);
      if (other.id == centre || number == centre || find_person(**world, number) != &other) continue;
      const double distance_m = glm::length(other.world_from_vehicle.position_m - from->world_from_vehicle.position_m);
      const auto [known, is_new] = least_m.try_emplace(number, distance_m);
      if (!is_new) known->second = std::min(known->second, distance_m);
    }
  }
}

/// Two participants, the lesser number first; a rider by his machine's.
using Two = std::pair<ParticipantId, ParticipantId>;
Two two(ParticipantId a, ParticipantId b) {
  return {std::min(machine_of(a), machine_of(b)), std::max(machine_of(a), machine_of(b))};
}

/// First contact of each two: with the driver's car, or of two others.
Expected<std::map<Two, double>> contacts_of(const logging::SessionReader& session, std::optional<ParticipantId> driver,
                                            const PairChoice& choice) {
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  std::map<Two, double> contacts;
  for (const logging::Event& event : *events) {
    if (!event.participant || event.simulated_time_s < choice.from_s || event.simulated_time_s > choice.to_s) continue;
    if (event.kind == "collision" && driver) {
      contacts.try_emplace(two(*driver, *event.participant), event.simulated_time_s);
    } else if (event.kind == "crash_of_others") {
      const auto with = logging::number_in_detail(event.detail, "with");  // None: a thing that stands.
      if (with && *with >= 0.0 && *with <= std::numeric_limits<ParticipantId>::max())
        contacts.try_emplace(two(*event.participant, static_cast<ParticipantId>(*with)), event.simulated_time_s);
    }
  }
  return contacts;
}

}  // namespace

bool has_eyes(const logging::Stay& stay) { return scenery::is_driven(vehicle_models()[stay.model]); }

Expected<std::vector<ChosenPair>> choose_pairs(const logging::SessionReader& session, const PairChoice& choice) {
  const auto stays = logging::stays_of(session);
  if (!stays) return tl::unexpected(stays.error());
  const auto driver = std::ranges::find_if(*stays, &logging::Stay::is_driver);
  const auto contacts =
      contacts_of(session, driver != stays->end() ? std::optional(driver->number) : std::nullopt, choice);
  if (!contacts) return tl::unexpected(contacts.error());
  std::optional<logging::Stay> eyes, target;
  if (!choice.eyes.empty()) {
    auto found = logging::find_stay(session, choice.eyes, "--eyes");
    if (!found) return tl::unexpected(found.error());
    if (!has_eyes(*found))
      return failure(fmt::format("{} has no eyes", logging::called(*found)), "--eyes", "name it with --target");
    eyes = std::move(*found);
  }
  if (!choice.target.empty()) {
    auto found = logging::find_stay(session, choice.target, "--target");
    if (!found) return tl::unexpected(found.error());
    target = std::move(*found);
  }
  const auto contact = [&](const logging::Stay& a, const logging::Stay& b) -> std::optional<double> {
    const auto found = contacts->find(two(a.number, b.number));
    return found == contacts->end() ? std::nullopt : std::optional(found->second);
  };
  if (eyes && target) {
    if (eyes->number == target->number)
      return failure("nobody looks at themselves", "--eyes, --target", "name two participants");
    return std::vector<ChosenPair>{{*eyes, *target, contact(*eyes, *target)}};
  }
  const std::optional<logging::Stay> centre = eyes                     ? eyes
                                              : target                 ? target
                                              : driver != stays->end() ? std::optional(*driver)
                                                                       : std::nullopt;
  if (!centre)
    return failure("nobody drives in it", session.path().string(), "name two participants with --eyes and --target");
  const auto least_m = distances_from(session, centre->number, choice);
  if (!least_m) return tl::unexpected(least_m.error());
  // Contacts first, in their order; then by distance.
  std::vector<std::pair<std::pair<bool, double>, ChosenPair>> found;
  for (const logging::Stay& other : *stays) {
    const auto distance = least_m->find(other.number);
    if (distance == least_m->end() || distance->second > choice.range_m || !has_eyes(other)) continue;
    const auto touched_s = contact(*centre, other);
    found.push_back({{!touched_s, touched_s.value_or(distance->second)},
                     target ? ChosenPair{other, *centre, touched_s} : ChosenPair{*centre, other, touched_s}});
  }
  std::ranges::stable_sort(found, {}, [](const auto& each) { return each.first; });
  if (found.empty())
    return failure(fmt::format("between {:.2f} and {:.2f} s nobody comes within {:g} m of {}", choice.from_s,
                               choice.to_s, choice.range_m, logging::called(*centre)),
                   session.path().string(), "widen it with --range, or name two with --eyes and --target");
  std::vector<ChosenPair> pairs;
  for (std::size_t n = 0; n < found.size() && n < choice.most; ++n) pairs.push_back(std::move(found[n].second));
  return pairs;
}

}  // namespace septet::sight
