#pragma once
/// Inside of ice: generic crack surfaces and planes of air bubbles, placed at random and larger than the body; drawing
/// clips them at its surface (section 3.3 of the paper).
///
/// Two ways to place them. A free-standing body has a number of cracks near its middle, scaled to its box. Pieces of a
/// broken body have those of a field that fills all of rest space, cell by cell: a piece has the cracks of its cells,
/// so a crack stays in its place through a break without being sent. Metres; pure functions.

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "engine/world/ice_vertex.hpp"

namespace septet::ice {

/// Third number of IceVertex::rest_m of vertices inside. `mark`: an opaque red crack, for a look at the clipping
/// (figure 5).
enum class InsideKind : int { crack = 0, air = 1, mark = 2 };

struct Box {
  glm::vec3 min_m{0.0f}, max_m{0.0f};
};

/// A curved sheet: a patch through `middle_m`, whose size is from rim to rim.
struct Crack {
  glm::vec3 middle_m{0.0f};
  glm::mat3 turn{1.0f};  ///< Columns: along, across, normal.
  float size_m = 1.0f;
  float bend = 0.2f;  ///< Height of its middle over its rim, in sizes.
  float seed = 0.0f;  ///< Seed of its texture.
};

/// `count` cracks near the middle of a box that their size covers; the same for the same seed.
std::vector<Crack> generic_cracks(const Box& box, std::uint32_t count, std::uint64_t seed);
/// Cracks of the field that may reach into a box of rest space; `cell_m` is the side of a cell.
std::vector<Crack> cracks_in(const Box& rest_box, float cell_m);

/// A crack's triangles, two a cell of `cells` times `cells`; `rest_m` = texture coordinates and kind. Their normals are
/// to one side; both are seen.
void append_crack(std::vector<IceVertex>& inside, const Crack& crack, InsideKind kind = InsideKind::crack,
                  std::uint32_t cells = 6);
/// `count` planes across the box along its three axes in turn.
void append_air(std::vector<IceVertex>& inside, const Box& box, std::uint32_t count, std::uint64_t seed);

}  // namespace septet::ice
