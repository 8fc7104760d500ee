#include "engine/simulation/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/core.h>

#include "engine/math/rigid_transform.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/command_words.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/solid.hpp"

namespace septet::simulation {
namespace {

struct Number {
  std::string_view name;
  double StandSolid::*value;
  double least, most;
};
constexpr double whole_turn_rad = 2.0 * std::numbers::pi;
constexpr Number stand_numbers[] = {
    {"x_m", &StandSolid::x_m, -farthest_solid_m, farthest_solid_m},
    {"y_m", &StandSolid::y_m, -farthest_solid_m, farthest_solid_m},
    {"z_m", &StandSolid::z_m, -farthest_solid_m, farthest_solid_m},
    {"heading_rad", &StandSolid::heading_rad, -whole_turn_rad, whole_turn_rad},
    {"length_m", &StandSolid::length_m, thinnest_solid_m, longest_solid_m},
    {"width_m", &StandSolid::width_m, thinnest_solid_m, longest_solid_m},
    {"height_m", &StandSolid::height_m, thinnest_solid_m, longest_solid_m},
};

tl::unexpected<Error> no_solid(std::string what) {
  return failure(std::move(what), "solid",
                 "write \"stand solid=N x_m=X y_m=Y z_m=Z heading_rad=A length_m=L width_m=W height_m=H "
                 "name=\"NAME\"\" or \"clear solid=N\"");
}

Expected<void> check_values(const StandSolid& stand) {
  if (stand.solid >= most_solids) return no_solid(fmt::format("its number is to be below {}", most_solids));
  for (const Number& number : stand_numbers)
    if (const double value = stand.*number.value; !(value >= number.least && value <= number.most))
      return failure(
          fmt::format("its {} is {:g}, which is not from {:g} to {:g}", number.name, value, number.least, number.most),
          "solid", "give it another place or size");
  if (!is_name_of_thing(stand.name))
    return no_solid("its name is too long, or holds what cannot be printed or a quotation mark");
  return {};
}

/// The whole of a word as the value behind "name=".
template <class Value>
bool read_value(std::string_view word, std::string_view name, Value& value) {
  if (!word.starts_with(name) || !word.substr(name.size()).starts_with('=')) return false;
  return read_number(word.substr(name.size() + 1), value);
}

Participant participant_of(const StandSolid& stand) {
  Participant box;
  box.id = first_solid_participant + stand.solid;
  box.model = box_model();
  box.world_from_vehicle = {Vec3(stand.x_m, stand.y_m, stand.z_m),
                            orientation_from_angles(stand.heading_rad, 0.0, 0.0)};
  set_box_size({stand.length_m, stand.width_m, stand.height_m}, box);
  return box;
}

/// Contacts of one that is gone, or that stands elsewhere, push nobody any more.
void drop_contacts(ParticipantId id, State& state) {
  std::erase_if(state.bodies.contacts,
                [id](const BodyContact& contact) { return contact.first == id || contact.second == id; });
}

}  // namespace

std::string text_of(const StandSolid& stand) {
  std::string text = fmt::format("stand solid={}", stand.solid);
  for (const Number& number : stand_numbers) text += fmt::format(" {}={}", number.name, stand.*number.value);
  if (!stand.name.empty()) text += fmt::format(" name=\"{}\"", stand.name);
  return text;
}

std::string text_of(const ClearSolid& clear) { return fmt::format("clear solid={}", clear.solid); }

Expected<StandSolid> read_stand(std::string_view text) {
  StandSolid stand;
  const NamedText named = split_name(text);
  stand.name = named.name;
  text = named.before;
  const bool has_more = text.ends_with(' ');
  if (!read_value(take_word(text), "solid", stand.solid)) return no_solid("its number cannot be read");
  for (const Number& number : stand_numbers)
    if (!read_value(take_word(text), number.name, stand.*number.value))
      return no_solid(fmt::format("its {} cannot be read", number.name));
  if (has_more || !text.empty()) return no_solid("there is more than its place, size and name");
  if (auto sound = check_values(stand); !sound) return tl::unexpected(sound.error());
  return stand;
}

Expected<ClearSolid> read_clear(std::string_view text) {
  ClearSolid clear;
  if (!read_value(text, "solid", clear.solid) || clear.solid >= most_solids)
    return no_solid("its number cannot be read");
  return clear;
}

Expected<void> may_stand(const Model& model, const State& state, const StandSolid& stand) {
  if (auto sound = check_values(stand); !sound) return sound;
  const Participant box = participant_of(stand);
  std::vector<Participant> others{driven_car(model, state).participant};
  append_others(model, state, others);
  for (const Participant& other : others)
    if (!is_solid(other.id) && !is_box(other) && overlap(box, other))
      return failure(other.id == driver_participant ? "the driver's car is there"
                                                    : fmt::format("participant {} is there", other.id),
                     "solid", "choose another place, or wait");
  return {};
}

Expected<void> stand_solid(const Model& model, const StandSolid& stand, State& state) {
  if (auto may = may_stand(model, state, stand); !may) return may;
  LooseBody body = loose_body(participant_of(stand), std::numeric_limits<double>::infinity());
  if (LooseBody* before = find_loose(state, body.id)) {
    drop_contacts(body.id, state);
    *before = std::move(body);
  } else {
    state.bodies.bodies.push_back(std::move(body));
  }
  return {};
}

Expected<void> clear_solid(const ClearSolid& clear, State& state) {
  const ParticipantId id = first_solid_participant + clear.solid;
  if (!stands(state, clear.solid))
    return failure("it does not stand", fmt::format("solid {}", clear.solid), "name another one");
  drop_contacts(id, state);
  std::erase_if(state.bodies.bodies, [id](const LooseBody& body) { return body.id == id; });
  return {};
}

bool stands(const State& state, std::uint32_t solid) {
  return find_loose(state, first_solid_participant + solid) != nullptr;
}

}  // namespace septet::simulation
