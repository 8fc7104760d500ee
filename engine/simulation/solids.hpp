#pragma once
/// Solids: things of the scene that can be hit, as upright boxes that stand fast.
///
/// The simulation knows a solid by its number alone; which thing of the scene it is, the server knows
/// (sim-server/drive/solid_things.hpp), and the command has that thing's name for those who read the log. It stands among the loose bodies (bodies/), with an infinite mass, from the
/// command that stands it to the one that clears it. So the driver's car, bodies and debris meet it, and traffic and
/// simulated drivers see it, as they do a box of the scenario that stands fast.
///
/// Both commands are logged with their tick like an operator's, and read back to the last bit:
///
///     stand solid=3 x_m=120.5 y_m=-3.25 z_m=0 heading_rad=0.5 length_m=4 width_m=0.5 height_m=1.2 name="stimuli/wall"
///     clear solid=3

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
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
  bool operator==(const StandSolid&) const = default;
};
struct ClearSolid {
  std::uint32_t solid = 0;
  bool operator==(const ClearSolid&) const = default;
};

/// Range of each side of a solid.
inline constexpr double thinnest_solid_m = 0.05, longest_solid_m = 200.0;
/// Farthest place of one, on each axis: within what a snapshot can tell.
inline constexpr double farthest_solid_m = 5e5;

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
