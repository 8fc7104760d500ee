#pragma once
/// Things beside the roads that the world was generated with and that an editor hides or shows again: a tree, a house, a
/// lamp, a parked car. What is gone is met by nobody: by the driver's car, bodies and debris.
///
/// A thing is known by its place, which is that of the object that draws it; the same roads and seed give the same
/// places. Both commands are logged with their tick like an operator's, and read back to the last bit; the name is for
/// the log's readers:
///
///     gone x_m=412.5321 y_m=-81.02 name="tree/412.5/-81.0"
///     back x_m=412.5321 y_m=-81.02 name="tree/412.5/-81.0"

#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

struct ShowStanding {
  double x_m = 0.0, y_m = 0.0;  ///< World.
  bool shown = false;
  std::string name{};  ///< Of its object, as that of a solid (solids.hpp).
  bool operator==(const ShowStanding&) const = default;
};

std::string text_of(const ShowStanding& show);
/// The text from behind "gone " or "back ". Error: another form, or a value out of range.
Expected<ShowStanding> read_standing(std::string_view text, bool shown);

/// Error: nothing stands there, it is so already, or somebody is where it would stand.
Expected<void> may_show(const Model& model, const State& state, const ShowStanding& show);
/// Error: as of may_show; then nothing has changed.
Expected<void> show_standing(const Model& model, const ShowStanding& show, State& state);

}  // namespace septet::simulation
