#include "engine/traffic/network/errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/outline.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double draws_each_s = 1.0;
constexpr double fades_s = 600.0;    ///< An impulse without an occasion.
constexpr double awaited_s = 120.0;  ///< A wish without one.
constexpr double unmet_s = 60.0;     ///< Two of whom one overlooks the other, and who do not come near.
constexpr double lingers_s = 5.0;    ///< Then who has erred is as all others.
constexpr double near_m = 40.0, parted_m = 10.0;
constexpr double stands_s = 2.0;
constexpr double long_ago_s = 1e6;

/// The ground that a body covers.
struct Footprint {
  Vec3 middle_m{0.0};
  impact::Outline outline;
};

Footprint footprint(const Vec3& rear_axle_m, const Vec3& forwards, const VehicleModel& model) {
  constexpr double round_m = 0.001;  // The least that an outline may have.
  const Vec2 along = glm::normalize(Vec2(forwards));
  const Vec3 middle_m = rear_axle_m + model.centre_x_m() * Vec3(along, 0.0);
  return {middle_m, impact::box_outline(Vec2(middle_m), along, 0.5 * Vec2(model.length_m, model.width_m), round_m)};
}

std::optional<Footprint> footprint_of(const TownTick& tick, const TownState& town, ParticipantId id) {
  if (const auto own = std::ranges::find(town.vehicles, id, &TownVehicle::id); own != town.vehicles.end()) {
    if (own->outside) return std::nullopt;
    const BodyOnRoute body = body_on_route(tick.graph, *own);
    return footprint(body.rear_axle_m, body.forwards, vehicle_models()[own->model]);
  }
  const auto other = std::ranges::find(tick.foreign, id, &ForeignVehicle::id);
  if (other == tick.foreign.end()) return std::nullopt;
  return footprint(other->world_from_vehicle.position_m, other->world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0),
                   other->shape());
}

/// Distance of two outlines on one level; 0: they overlap.
double gap_m(const Footprint& a, const Footprint& b) {
  if (std::abs(a.middle_m.z - b.middle_m.z) > road::level_reach_m) return 1e6;
  return std::max(0.0, impact::nearest(a.outline, b.outline).gap_m);
}

void end(ErrorEnd how, double time_s, DriverError& error, TownErrors& errors) {
  ToldError told{.kind = error.kind,
                 .who = error.who,
                 .whom = error.whom,
                 .lasted_s = time_s - error.since_s,
                 .end = how,
                 .nearest_m = {}};
  if (error.kind == PeopleError::overlook && std::isfinite(error.nearest_m)) told.nearest_m = error.nearest_m;
  errors.told.push_back(told);
  error.stage = DriverError::Stage::over;
  error.since_s = time_s;
}

std::optional<ErrorEnd> end_of_overlook(const TownTick& tick, const TownState& town, DriverError& error) {
  const auto own = footprint_of(tick, town, error.who), his = footprint_of(tick, town, *error.whom);
  if (!own || !his) return ErrorEnd::gone;
  const double apart_m = gap_m(*own, *his);
  error.nearest_m = std::min(error.nearest_m, apart_m);
  if (apart_m <= 0.0) return ErrorEnd::touched;
  if (error.nearest_m < near_m)
    return apart_m > error.nearest_m + parted_m ? std::optional(ErrorEnd::parted) : std::nullopt;
  return town.time_s > error.since_s + unmet_s ? std::optional(ErrorEnd::unmet) : std::nullopt;
}

std::optional<ErrorEnd> end_of_red(const TownTick& tick, const TownVehicle& vehicle, const DriverError& error) {
  const auto ahead = light_ahead(tick.graph, vehicle);
  if (!ahead || ahead->way != error.way || ahead->line_m <= 0.0) return ErrorEnd::passed;
  return vehicle.stands_s > stands_s ? std::optional(ErrorEnd::stood) : std::nullopt;
}

std::optional<ErrorEnd> end_now(const TownTick& tick, const TownState& town, const TownVehicle& vehicle,
                                DriverError& error) {
  if (error.kind == PeopleError::overlook) return end_of_overlook(tick, town, error);
  if (error.kind == PeopleError::red) return end_of_red(tick, vehicle, error);
  return town.time_s >= error.since_s + error.lasts_s ? std::optional(ErrorEnd::seen) : std::nullopt;
}

void end_errors(const TownTick& tick, TownState& town) {
  TownErrors& errors = town.errors;
  using enum DriverError::Stage;
  for (DriverError& error : errors.drivers) {
    const auto own = std::ranges::find(town.vehicles, error.who, &TownVehicle::id);
    const bool is_there = own != town.vehicles.end() && !own->outside;
    if (error.stage == runs) {
      const auto how = is_there ? end_now(tick, town, *own, error) : std::optional(ErrorEnd::gone);
      if (how) end(*how, town.time_s, error, errors);
    } else if (error.stage == waits && !is_there) {
      error.since_s = -fades_s;
    }
  }
  std::erase_if(errors.drivers, [&](const DriverError& error) {
    const double for_s = town.time_s - error.since_s;
    return (error.stage == waits && for_s > fades_s) || (error.stage == over && for_s > lingers_s);
  });
  std::erase_if(errors.awaited, [&](const AwaitedOverlook& wish) {
    const double for_s = town.time_s - wish.since_s;
    if (for_s <= awaited_s) return false;
    errors.told.push_back({.kind = PeopleError::overlook,
                           .who = {},
                           .whom = wish.whom,
                           .lasted_s = for_s,
                           .end = ErrorEnd::unmet,
                           .nearest_m = {}});
    return true;
  });
}

/// Lights that are red when this begins have been so for long.
void time_reds(const TownTick& tick, bool is_asked, std::vector<double>& red_for_s) {
  if (!is_asked) {
    red_for_s.clear();
    return;
  }
  const bool is_first = red_for_s.size() != tick.lights.size();
  if (is_first) red_for_s.assign(tick.lights.size(), 0.0);
  for (std::size_t k = 0; k < red_for_s.size(); ++k)
    red_for_s[k] = tick.lights[k] != LightState::red ? 0.0 : is_first ? long_ago_s : red_for_s[k] + tick.dt_s;
}

double drawn_duration_s(PeopleError kind, Random& random) {
  switch (kind) {
    case PeopleError::overlook:
      return 0.0;
    case PeopleError::late_brake:
      return random.uniform(1.0, 2.5);
    case PeopleError::telephone:
      return random.uniform(2.0, 6.0);
    case PeopleError::red:
      return random.uniform(1.0, 3.0);
  }
  return 0.0;
}

void draw_impulses(const PeopleErrorRates& rates, Random& random, TownState& town) {
  for (const TownVehicle& vehicle : town.vehicles) {
    if (vehicle.outside) continue;
    for (std::size_t k = 0; k < rates.per_hour.size(); ++k) {
      const auto kind = static_cast<PeopleError>(k);
      if (rates.per_hour[k] <= 0.0 || random.uniform() >= rates.per_hour[k] * draws_each_s / 3600.0) continue;
      const auto known = errors_of(vehicle.id, town.errors);
      if (std::ranges::any_of(known, [&](const DriverError& error) {
            return error.kind == kind && error.stage != DriverError::Stage::over;
          }))
        continue;
      add_error({.who = vehicle.id,
                 .kind = kind,
                 .whom = {},
                 .since_s = town.time_s,
                 .lasts_s = drawn_duration_s(kind, random)},
                town.errors);
    }
  }
}

}  // namespace

std::span<DriverError> errors_of(ParticipantId who, TownErrors& errors) {
  const auto first = std::ranges::lower_bound(errors.drivers, who, {}, &DriverError::who);
  const auto last = std::ranges::upper_bound(errors.drivers, who, {}, &DriverError::who);
  return {first, last};
}

DriverError* running_error(ParticipantId who, TownErrors& errors) {
  const auto own = errors_of(who, errors);
  const auto runs = std::ranges::find(own, DriverError::Stage::runs, &DriverError::stage);
  return runs == own.end() ? nullptr : &*runs;
}

DriverError& add_error(const DriverError& error, TownErrors& errors) {
  return *errors.drivers.insert(std::ranges::upper_bound(errors.drivers, error.who, {}, &DriverError::who), error);
}

Expected<void> overlook(std::optional<ParticipantId> who, ParticipantId whom, TownState& town) {
  TownErrors& errors = town.errors;
  if (!who) {
    if (std::ranges::find(errors.awaited, whom, &AwaitedOverlook::whom) != errors.awaited.end())
      return failure("somebody is to overlook that one already", "overlook", "wait until he does");
    errors.awaited.push_back({whom, town.time_s});
    return {};
  }
  const auto own = std::ranges::find(town.vehicles, *who, &TownVehicle::id);
  if (own == town.vehicles.end() || own->outside || *who == whom)
    return failure(fmt::format("participant {} is no vehicle of the traffic that could overlook another", *who),
                   "overlook", "name another one, or nobody: then the next one who would have to give way");
  if (running_error(*who, errors) != nullptr)
    return failure(fmt::format("participant {} errs already", *who), "overlook", "wait until he sees again");
  const DriverError& error = add_error({.who = *who,
                                        .kind = PeopleError::overlook,
                                        .stage = DriverError::Stage::runs,
                                        .whom = whom,
                                        .since_s = town.time_s},
                                       errors);
  errors.told.push_back({.kind = error.kind, .who = who, .whom = whom, .lasted_s = 0.0, .end = {}, .nearest_m = {}});
  return {};
}

void end_at_touch(ParticipantId id, TownState& town) {
  for (DriverError& error : town.errors.drivers)
    if (error.stage == DriverError::Stage::runs && (error.who == id || error.whom == id)) {
      if (error.kind == PeopleError::overlook) error.nearest_m = 0.0;
      end(ErrorEnd::touched, town.time_s, error, town.errors);
    }
}

void advance_errors(const TrafficParameters& parameters, const TownTick& tick, Random& random, TownState& town) {
  const PeopleErrorRates& rates = parameters.errors;
  if (!rates.any() && !town.errors.any()) return town.errors.red_for_s.clear();
  end_errors(tick, town);
  time_reds(
      tick,
      rates.per_hour[static_cast<std::size_t>(PeopleError::red)] > 0.0 ||
          std::ranges::find(town.errors.drivers, PeopleError::red, &DriverError::kind) != town.errors.drivers.end(),
      town.errors.red_for_s);
  if (std::floor((town.time_s - tick.dt_s) / draws_each_s) < std::floor(town.time_s / draws_each_s))
    draw_impulses(rates, random, town);
}

}  // namespace septet::traffic
