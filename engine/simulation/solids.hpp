#pragma once
/// Solids: things of the scene that can be hit, as upright boxes.
///
/// The simulation knows a solid by its number alone; which thing of the scene it is, the server knows
/// (sim-server/drive/solid_things.hpp), and the command has that thing's name for those who read the log. It is one of the
/// loose bodies (bodies/) from the command that stands it to the one that clears it: so the driver's car, bodies and debris
/// meet it, and traffic and simulated drivers see it, as they do a box of the scenario. Without a mass it stands fast,
/// with one it is pushed and slides; it may follow a motion (solid_motion.hpp).
///
/// Both commands are logged with their tick like an operator's, and read back to the last bit. Mass and motion are left
/// out where there is none; a leg is the time from which it holds, velocity, acceleration, and turn about the vertical:
///
///     stand solid=3 x_m=120.5 y_m=-3.25 z_m=0 heading_rad=0.5 length_m=4 width_m=0.5 height_m=1.2 name="stimuli/wall"
///     stand solid=4 x_m=9 … height_m=0.2 mass_kg=0.4 about_x_m=9 about_y_m=2 leg=12.5,3,0,0,-0.5,0,0,0 name="ball"
///     clear solid=3

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/scene/motion.hpp"
#include "engine/simulation/state.hpp"
#include "engine/world/solid.hpp"

namespace septet::simulation {

/// Stands a solid, or puts one that stands elsewhere.
struct StandSolid {
  std::uint32_t solid = 0;                 ///< Below most_solids.
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< Middle of its bottom, world.
  double heading_rad = 0.0;                ///< Of its length, counter-clockwise from x.
  double length_m = 1.0, width_m = 1.0, height_m = 1.0;
  std::string name{};  ///< Of the thing (is_name_of_thing); empty in logs of earlier builds.
  double mass_kg = std::numeric_limits<double>::infinity();  ///< Infinite: nothing pushes it.
  double about_x_m = 0.0, about_y_m = 0.0;  ///< What it turns about, world, before the first leg; 0 without legs.
  std::vector<scene::MotionLeg> legs{};     ///< Turn about the vertical alone. Place and heading are before the first.
  bool operator==(const StandSolid&) const = default;
};
struct ClearSolid {
  std::uint32_t solid = 0;
  bool operator==(const ClearSolid&) const = default;
};

/// Range of each side of a solid.
inline constexpr double thinnest_solid_m = 0.05, longest_solid_m = 200.0;
/// Farthest place of one, on each axis, and its greatest speed and turn: within what a snapshot can tell.
inline constexpr double farthest_solid_m = 5e5, fastest_solid_mps = 1000.0, fastest_solid_radps = 1000.0;
inline constexpr double latest_leg_s = 1e9;

/// True where place and speed are within those bounds.
bool is_in_range(const LooseBody& solid);
/// True for legs that a solid may have: few, in order, each within the bounds above and turning about the vertical.
bool is_motion_of_solid(const std::vector<scene::MotionLeg>& legs);

std::string text_of(const StandSolid& stand);
std::string text_of(const ClearSolid& clear);
/// Texts from behind "stand " and "clear ". Error: another form, or a value out of range.
Expected<StandSolid> read_stand(std::string_view text);
Expected<ClearSolid> read_clear(std::string_view text);

/// Error: a value is out of range (not a number, too), or somebody is where it would stand.
Expected<void> may_stand(const Model& model, const State& state, const StandSolid& stand);

/// Error: as of may_stand; then nothing has changed.
Expected<void> stand_solid(const Model& model, const StandSolid& stand, State& state);
/// Error: it does not stand.
Expected<void> clear_solid(const ClearSolid& clear, State& state);

/// True where the solid of this number stands.
bool stands(const State& state, std::uint32_t solid);

}  // namespace septet::simulation
