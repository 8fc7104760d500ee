#include "engine/simulation/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/solid_box.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/command_words.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/simulation/solid_motion.hpp"
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
                 "write \"stand solid=N x_m=X y_m=Y z_m=Z heading_rad=A length_m=L width_m=W height_m=H [mass_kg=M] "
                 "[about_x_m=X about_y_m=Y leg=FROM_S,VX,VY,VZ,AX,AY,AZ,TURN …] name=\"NAME\"\" or \"clear solid=N\"");
}

tl::unexpected<Error> no_place(std::string what) {
  return failure(std::move(what), "solid", "give it another place, size, mass or motion");
}

/// In the order in which a command has them.
std::array<double, 8> numbers_of(const scene::MotionLeg& leg) {
  const Vec3 &velocity_mps = leg.velocity_mps, &acceleration_mps2 = leg.acceleration_mps2;
  return {leg.from_s,          velocity_mps.x,      velocity_mps.y,      velocity_mps.z,
          acceleration_mps2.x, acceleration_mps2.y, acceleration_mps2.z, leg.turn_radps.z};
}

std::string text_of(const scene::MotionLeg& leg) { return fmt::format("leg={}", fmt::join(numbers_of(leg), ",")); }

bool read_leg(std::string_view word, scene::MotionLeg& leg) {
  constexpr std::string_view begin = "leg=";
  if (!word.starts_with(begin)) return false;
  word.remove_prefix(begin.size());
  std::array<double, 8> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const bool is_last = i + 1 == numbers.size();
    const std::size_t end = word.find(',');
    if ((end == word.npos) != is_last || !read_number(word.substr(0, end), numbers[i])) return false;
    word.remove_prefix(is_last ? word.size() : end + 1);
  }
  leg = {numbers[0], Vec3(numbers[1], numbers[2], numbers[3]), Vec3(numbers[4], numbers[5], numbers[6]),
         Vec3(0.0, 0.0, numbers[7])};
  return true;
}

Expected<void> check_leg(const scene::MotionLeg& leg) {
  for (const double number : numbers_of(leg))
    if (!std::isfinite(number)) return no_place("its motion has what is no finite number");
  if (std::abs(leg.from_s) > latest_leg_s)
    return no_place(fmt::format("its motion begins at {:g} s, which is beyond {:g} s", leg.from_s, latest_leg_s));
  if (const double speed_mps = glm::length(leg.velocity_mps); speed_mps > fastest_solid_mps)
    return no_place(fmt::format("it moves at {:g} m/s, and a solid at {:g} at most", speed_mps, fastest_solid_mps));
  if (const double rate_mps2 = glm::length(leg.acceleration_mps2); rate_mps2 > scene::max_motion_rate)
    return no_place(
        fmt::format("it is accelerated by {:g} m/s², and a solid by {:g} at most", rate_mps2, scene::max_motion_rate));
  if (leg.turn_radps.x != 0.0 || leg.turn_radps.y != 0.0)
    return no_place("its box turns about another axis than the vertical");
  if (std::abs(leg.turn_radps.z) > fastest_solid_radps)
    return no_place(
        fmt::format("it turns by {:g} rad/s, and a solid by {:g} at most", leg.turn_radps.z, fastest_solid_radps));
  return {};
}

Expected<void> check_legs(const std::vector<scene::MotionLeg>& legs) {
  if (legs.size() > scene::max_motion_legs)
    return no_place(fmt::format("its motion has more than {} legs", scene::max_motion_legs));
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (auto sound = check_leg(legs[i]); !sound) return sound;
    if (i > 0 && legs[i].from_s < legs[i - 1].from_s)
      return no_place("a leg of its motion begins before the one that it follows");
  }
  return {};
}

Expected<void> check_values(const StandSolid& stand) {
  if (stand.solid >= most_solids) return no_solid(fmt::format("its number is to be below {}", most_solids));
  for (const Number& number : stand_numbers)
    if (const double value = stand.*number.value; !(value >= number.least && value <= number.most))
      return failure(
          fmt::format("its {} is {:g}, which is not from {:g} to {:g}", number.name, value, number.least, number.most),
          "solid", "give it another place or size");
  const bool is_mass = stand.mass_kg >= scene::lightest_solid_kg && stand.mass_kg <= scene::heaviest_solid_kg;
  if (!is_mass && stand.mass_kg != std::numeric_limits<double>::infinity())
    return no_place(fmt::format("its mass is {:g} kg, which is not from {:g} to {:g}", stand.mass_kg,
                                scene::lightest_solid_kg, scene::heaviest_solid_kg));
  for (const double about_m : {stand.about_x_m, stand.about_y_m})
    if (!(std::abs(about_m) <= farthest_solid_m)) return no_place("what it turns about is too far away");
  if (auto sound = check_legs(stand.legs); !sound) return sound;
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

SolidMotion motion_of(const StandSolid& stand) {
  const Vec3 about_m(stand.about_x_m, stand.about_y_m, stand.z_m);
  return {first_solid_participant + stand.solid,
          Vec3(stand.x_m, stand.y_m, stand.z_m) - about_m,
          stand.heading_rad,
          {about_m, Quat(1.0, 0.0, 0.0, 0.0), stand.legs}};
}

/// The solid as it is at that time.
LooseBody solid_body(const StandSolid& stand, double simulated_time_s) {
  LooseBody body = loose_body(participant_of(stand), stand.mass_kg);
  if (stand.legs.empty())
    body.lamps.set(Lamp::brake, std::isfinite(stand.mass_kg));
  else
    place_solid(motion_of(stand), simulated_time_s, body);
  return body;
}

/// Contacts and motion of one that is gone, or that stands elsewhere: it pushes nobody any more.
void forget(ParticipantId id, State& state) {
  std::erase_if(state.solid_motions, [id](const SolidMotion& moving) { return moving.participant == id; });
  std::erase_if(state.bodies.contacts,
                [id](const BodyContact& contact) { return contact.first == id || contact.second == id; });
}

}  // namespace

bool is_in_range(const LooseBody& solid) {
  const auto within = [](double value_m) { return std::abs(value_m) <= farthest_solid_m; };
  const Vec2& at_m = solid.body.mass_centre_m;
  return within(at_m.x) && within(at_m.y) && within(solid.height_m) &&
         glm::length(Vec3(solid.body.velocity_mps, solid.climb_mps)) <= fastest_solid_mps;
}

bool is_motion_of_solid(const std::vector<scene::MotionLeg>& legs) { return check_legs(legs).has_value(); }

std::string text_of(const StandSolid& stand) {
  std::string text = fmt::format("stand solid={}", stand.solid);
  for (const Number& number : stand_numbers) text += fmt::format(" {}={}", number.name, stand.*number.value);
  if (std::isfinite(stand.mass_kg)) text += fmt::format(" mass_kg={}", stand.mass_kg);
  if (!stand.legs.empty()) text += fmt::format(" about_x_m={} about_y_m={}", stand.about_x_m, stand.about_y_m);
  for (const scene::MotionLeg& leg : stand.legs) text += ' ' + text_of(leg);
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
  if (text.starts_with("mass_kg=") &&
      (!read_value(take_word(text), "mass_kg", stand.mass_kg) || !std::isfinite(stand.mass_kg)))
    return no_solid("its mass cannot be read");
  if (text.starts_with("about_x_m=") && (!read_value(take_word(text), "about_x_m", stand.about_x_m) ||
                                         !read_value(take_word(text), "about_y_m", stand.about_y_m) || text.empty()))
    return no_solid("its motion cannot be read");
  while (text.starts_with("leg="))
    if (stand.legs.size() >= scene::max_motion_legs || !read_leg(take_word(text), stand.legs.emplace_back()))
      return no_solid("a leg of its motion cannot be read");
  if (has_more || !text.empty()) return no_solid("there is more than its place, size, mass, motion and name");
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
  const LooseBody body = solid_body(stand, state.time_s());
  if (!is_in_range(body)) return no_place("its motion has it too far away by now, or too fast");
  const Participant box = participant_of(body);
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
  LooseBody body = solid_body(stand, state.time_s());
  forget(body.id, state);
  if (!stand.legs.empty()) state.solid_motions.push_back(motion_of(stand));
  if (LooseBody* before = find_loose(state, body.id)) {
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
  forget(id, state);
  std::erase_if(state.bodies.bodies, [id](const LooseBody& body) { return body.id == id; });
  return {};
}

bool stands(const State& state, std::uint32_t solid) {
  return find_loose(state, first_solid_participant + solid) != nullptr;
}

}  // namespace septet::simulation
