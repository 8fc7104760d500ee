#pragma once
/// Where the layers of each body of ice are drawn: a rectangle a body in one image, seen through a frustum fitted to it.
///
/// Near plane and rectangle close around the body, as the paper closes its near and far planes (section 3.3), so the cost
/// follows the body's size on the screen. The frustum depends on the eye and the body alone: on both sides of a screen's
/// edge the layers hold the same. No device is needed.

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
  std::uint32_t around = 0;          ///< Which of the frame's surroundings it is in.
  PixelRectangle rectangle;
  IceConstants constants{};
  std::vector<std::uint32_t> beyond;  ///< Bodies behind it that light from it may meet, the nearest few, if it is to.
};

/// Of such bodies.
inline constexpr std::size_t most_beyond = 4;

/// Of the layers for a target: even, since one layer is half as wide as the others.
constexpr std::uint32_t layer_px(std::uint32_t target_px) { return target_px + (target_px & 1u); }

struct IceTiles {
  std::vector<IceTile> list;  ///< Nearest body last.
  bool beyond = false;        ///< Some body is looked through to what lies behind it.
  std::uint32_t used_width = 0, used_height = 0;
};

/// Those with which another body is drawn into the layers of this one's tile.
IceConstants constants_beyond(const IceTile& tile, const ice::IceBody& own, const ice::IceBody& other);

/// A rectangle for each body that a view sees, in one image of this size. Where they do not fit, all are drawn coarser.
IceTiles ice_tiles(std::span<const ice::IceBody> bodies, std::span<const FrameView> views, std::uint32_t width,
                   std::uint32_t height);

/// Ice that lies together mirrors the same surroundings; of what is elsewhere the largest in the eye comes first, and the rest
/// takes the nearest. The same on all screens of one eye.
struct IceNeighbourhoods {
  std::vector<Vec3> middles_m;  ///< From where the surroundings of each are seen: what is near to the eye weighs most.
  std::vector<std::uint32_t> of_body;  ///< One a body.
};
inline constexpr std::size_t most_neighbourhoods = 2;
IceNeighbourhoods ice_neighbourhoods(std::span<const ice::IceBody> bodies, const Vec3& eye_m);
/// Those that some tile is in, whose `around` is told; the others are left out.
std::vector<Vec3> seen_neighbourhoods(const IceNeighbourhoods& neighbourhoods, IceTiles& tiles);

/// The six views of a cube map, side by side in two rows of three: +x, −x, +z, −z, +y, −y, as `around` in shaders/ice.glsl
/// looks them up.
std::vector<FrameView> surrounding_views(const Vec3& middle_m, std::uint32_t side_px);

}  // namespace septet::render
