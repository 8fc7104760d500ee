#pragma once
/// How a piece of a vehicle's part is drawn: the panel that was cut out of the vehicle (torn_vehicle.hpp) follows the
/// piece's lattice.
///
/// The lattice is a plain box of tetrahedra, the panel has the part's true form. Both cover the part: a triangle of the
/// panel belongs to that piece in whose lattice the same share of the box lies. It moves with the affine map that takes
/// the piece's vertices at rest closest to their places, and with what of their bend that leaves, by the nearest four.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "sim-client/frame/sheet.hpp"

namespace septet::frame {

/// A run of triangles of one material.
struct ClothRun {
  std::uint32_t first = 0, count = 0;
  std::uint32_t material = 0;
};

class Clothing {
 public:
  /// `panel`: of the origin of `piece`. Nothing is worn where the panel is empty, or has no triangle in the piece.
  Clothing(const Sheet& panel, const debris::Keyframe& piece);

  /// True if the piece is still the same, however it lies.
  bool fits(const debris::Keyframe& piece) const;
  bool is_worn() const { return !triangles_.empty(); }
  /// The panel's vertices and triangles, as the piece lies.
  debris::Keyframe worn(const debris::Keyframe& piece) const;

  const std::vector<ClothRun>& runs() const { return runs_; }
  const std::vector<glm::vec2>& uvs() const { return uvs_; }  ///< Three a triangle.
  std::uint32_t material() const { return runs_.empty() ? 0 : runs_.front().material; }

 private:
  struct Thread {
    Vec3 rest_m{0.0};  ///< From the piece's middle, in the part's frame.
    std::array<std::uint32_t, 4> nearest{};
    std::array<double, 4> weights{};
  };
  std::vector<Thread> vertices_;
  std::vector<std::array<std::uint16_t, 3>> triangles_;
  std::vector<glm::vec2> uvs_;
  std::vector<ClothRun> runs_;
  // Of the piece.
  std::optional<debris::PieceOrigin> origin_;
  std::vector<std::uint8_t> nodes_;
  std::vector<std::array<std::uint16_t, 3>> lattice_;
  std::vector<Vec3> lattice_rest_m_;  ///< From their middle.
};

}  // namespace septet::frame
