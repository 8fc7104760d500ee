#pragma once
/// Layout of the layers of ice: a rectangle a body in one image, seen through a frustum fitted to the body.
///
/// Near plane and rectangle close around the body, as the paper closes its near and far planes (section 3.3), so the
/// cost follows the body's size on the screen. The frustum depends on the eye and the body alone: on both sides of a
/// screen's edge the layers hold the same. No device is needed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "engine/instant/instant.hpp"
#include "engine/light/records.hpp"
#include "engine/render/words.hpp"

namespace septet::render {

using light::IceConstants;

struct IceTile {
  std::uint32_t body = 0, view = 0;  ///< Indices of Instant::ice and Instant::views.
  std::uint32_t around = 0;          ///< Index among the frame's surroundings.
  PixelRectangle rectangle;
  IceConstants constants{};
  /// Nearest bodies behind it that light from it may meet; empty unless Look::seen_beyond.
  std::vector<std::uint32_t> beyond;
};

/// Greatest number of bodies beyond.
inline constexpr std::size_t most_beyond = 4;

/// Size of the layers for a target: even, since one layer is half as wide as the others.
constexpr std::uint32_t layer_px(std::uint32_t target_px) { return target_px + (target_px & 1u); }

struct IceTiles {
  std::vector<IceTile> list;  ///< Nearest body last.
  bool beyond = false;        ///< True if other ice is seen through some body.
  std::uint32_t used_width = 0, used_height = 0;
};

/// Constants for drawing another body into the layers of this one's tile.
IceConstants constants_beyond(const IceTile& tile, const ice::IceBody& own, const ice::IceBody& other);

/// Rectangle for each body that a view sees, in one image of this size. If they do not fit, all are drawn coarser.
IceTiles ice_tiles(std::span<const ice::IceBody> bodies, std::span<const FrameView> views, std::uint32_t width,
                   std::uint32_t height);

/// Groups of neighbouring bodies that mirror the same surroundings. Groups form around the bodies that appear largest
/// to the eye; the other bodies join the nearest group. They are the same on all screens of one eye.
struct IceNeighbourhoods {
  std::vector<Vec3> middles_m;         ///< Viewpoint of each group's surroundings; bodies near to the eye weigh most.
  std::vector<std::uint32_t> of_body;  ///< Group of each body.
};
inline constexpr std::size_t most_neighbourhoods = 2;
IceNeighbourhoods ice_neighbourhoods(std::span<const ice::IceBody> bodies, const Vec3& eye_m);
/// Viewpoints of the groups that some tile uses; sets IceTile::around.
std::vector<Vec3> seen_neighbourhoods(const IceNeighbourhoods& neighbourhoods, IceTiles& tiles);

/// Six views of a cube map, side by side in two rows of three: +x, −x, +z, −z, +y, −y, as `around` in shaders/ice.glsl
/// looks them up.
std::vector<FrameView> surrounding_views(const Vec3& middle_m, std::uint32_t side_px);

}  // namespace septet::render
