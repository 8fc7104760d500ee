#pragma once
/// What an operator places on the page's map, as plain data: what there is to place, and what was placed or changed.
///
/// Metres and degrees counter-clockwise from x, world frame.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace septet::page {

/// A thing that the world has already, of which another one can be placed.
struct StockThing {
  std::string kind;  ///< "vehicle", "tree", "town house", …
  std::string name;  ///< What tells it from others of its kind: "hatchback", "birch".
  std::string node;  ///< Word by which an editor's line means it.
  double length_m = 0.0, width_m = 0.0;
};

/// What there is to place; the same for the whole drive.
struct PlacingFacts {
  bool has_scene = false;               ///< False: the drive has nothing that can be seen, and nothing can be placed.
  std::vector<StockThing> stock;        ///< By kind, then by name.
  std::vector<std::string> own_models;  ///< Names of files of the drive's folder.
};

/// An object of the scene as the map shows it.
struct PlacedThing {
  std::uint32_t id = 0;
  std::string name;  ///< As people read it.
  std::string node;  ///< Word by which an editor's line means it.
  double x_m = 0.0, y_m = 0.0, heading_deg = 0.0;
  double length_m = 0.0, width_m = 0.0;       ///< Along the heading, and across.
  double middle_x_m = 0.0, middle_y_m = 0.0;  ///< Of what is seen of it.
  bool is_shown = true, is_solid = false;
  bool was_placed = true;  ///< False: the world was generated with it.
  bool operator==(const PlacedThing&) const = default;
};

/// What the scene has beside or otherwise than the generated world.
struct PlacedView {
  std::vector<PlacedThing> things;
  std::size_t more = 0;  ///< Further ones, which are not listed.
};
inline constexpr std::size_t most_placed_shown = 300;

}  // namespace septet::page
