#include "engine/simulation/standing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/math/rigid_transform.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/command_words.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/solid.hpp"

namespace septet::simulation {
namespace {

tl::unexpected<Error> no_standing(std::string what) {
  return failure(std::move(what), "standing thing",
                 "write \"gone x_m=X y_m=Y name=\"NAME\"\" or \"back x_m=X y_m=Y name=\"NAME\"\"");
}

std::string told_place(const ShowStanding& show) {
  return show.name.empty() ? fmt::format("{:.1f}, {:.1f}", show.x_m, show.y_m) : show.name;
}

/// Its number among the obstacles; 0: nothing stands there.
std::uint32_t number_of(const Model& model, const ShowStanding& show) {
  return model.obstacles ? model.obstacles->thing_at({show.x_m, show.y_m}) : 0;
}

/// A stretch of it as a box as high as whoever might be there.
Participant filled_by(const Obstacle& obstacle, const Participant& beside) {
  constexpr double taller_m = 5.0, least_m = 0.01;
  const Vec2 along_m = obstacle.to_m - obstacle.from_m, middle_m = 0.5 * (obstacle.from_m + obstacle.to_m);
  const double low_m = std::max(obstacle.low_m, beside.world_from_vehicle.position_m.z - taller_m);
  const double high_m = std::min(obstacle.high_m, beside.world_from_vehicle.position_m.z + taller_m);
  const double thick_m = 2.0 * obstacle.radius_m;
  Participant box;
  box.model = box_model();
  box.world_from_vehicle = {Vec3(middle_m, low_m), orientation_from_angles(std::atan2(along_m.y, along_m.x), 0.0, 0.0)};
  set_box_size({glm::length(along_m) + thick_m, thick_m, std::max(least_m, high_m - low_m)}, box);
  return box;
}

Expected<void> is_free(const Model& model, const State& state, std::uint32_t thing) {
  std::vector<Participant> others{driven_car(model, state).participant};
  append_others(model, state, others);
  for (const Obstacle& obstacle : model.obstacles->listed()) {
    if (obstacle.thing != thing) continue;
    for (const Participant& other : others)
      if (!is_solid(other.id) && !is_box(other) && overlap(filled_by(obstacle, other), other))
        return failure(other.id == driver_participant ? "the driver's car is there"
                                                      : fmt::format("participant {} is there", other.id),
                       "standing thing", "wait until the place is free");
  }
  return {};
}

}  // namespace

std::string text_of(const ShowStanding& show) {
  std::string text = fmt::format("{} x_m={} y_m={}", show.shown ? "back" : "gone", show.x_m, show.y_m);
  if (!show.name.empty()) text += fmt::format(" name=\"{}\"", show.name);
  return text;
}

Expected<ShowStanding> read_standing(std::string_view text, bool shown) {
  ShowStanding show{.shown = shown};
  const NamedText named = split_name(text);
  show.name = named.name;
  if (!is_name_of_thing(show.name)) return no_standing("its name cannot be a thing's");
  std::string_view rest = named.before;
  for (const auto& [key, value] : {std::pair("x_m=", &show.x_m), std::pair("y_m=", &show.y_m)}) {
    const std::string_view word = take_word(rest);
    if (!word.starts_with(key) || !read_number(word.substr(std::string_view(key).size()), *value) ||
        !std::isfinite(*value))
      return no_standing("its place cannot be read");
  }
  if (!rest.empty() || named.before.ends_with(' ')) return no_standing("there is more than its place and name");
  return show;
}

Expected<void> may_show(const Model& model, const State& state, const ShowStanding& show) {
  const std::uint32_t thing = number_of(model, show);
  if (thing == 0)
    return failure("nothing that could be taken away stands there", told_place(show), "name the place of another one");
  if (std::ranges::binary_search(state.gone, thing) != show.shown)
    return failure(show.shown ? "it stands already" : "it is gone already", told_place(show), "name another one");
  return show.shown ? is_free(model, state, thing) : Expected<void>();
}

Expected<void> show_standing(const Model& model, const ShowStanding& show, State& state) {
  if (auto may = may_show(model, state, show); !may) return may;
  const std::uint32_t thing = number_of(model, show);
  const auto place = std::ranges::lower_bound(state.gone, thing);
  if (show.shown)
    state.gone.erase(place);
  else
    state.gone.insert(place, thing);
  return {};
}

}  // namespace septet::simulation
