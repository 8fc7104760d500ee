#pragma once
/// `septet-ice`: one object of ice alone, turning, with every part of its drawing switched on and off; pictures.

#include <filesystem>
#include <functional>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/effects/ice/objects.hpp"
#include "engine/instant/frame_input.hpp"
#include "sim-client/ice/surroundings.hpp"

namespace septet::ice_viewer {

struct IceOptions {
  std::string object = "cube";  ///< A name of ice::object, or an OBJ file.
  Surroundings surroundings = Surroundings::outdoors;
  ice::Look look;
  std::uint32_t cracks = 2, air_planes = 19;  ///< The paper's.
  bool pair = false;                          ///< A second one stands behind it.
  bool mark_cracks = false;                   ///< In red, as figure 5 shows them.
  std::uint64_t seed = 1;
  std::uint32_t width_px = 800, height_px = 600;
  std::uint32_t pictures = 8;  ///< Of one turn.
  std::uint32_t surroundings_px = 256;
  bool surroundings_kept = false;  ///< Those of the first picture do for all.
  double share_of_picture = 0.2;   ///< That the object covers, about; more: the camera is nearer.
  double turn_deg = 0.0;           ///< Of the first picture.
  bool window = false;             ///< Instead of pictures.
  bool software = false;
  std::filesystem::path out = "ice";
  std::filesystem::path reference;  ///< Folder for what a path tracer needs to draw the same; empty: none.
};

/// An object by its name or from its file. What is wrong with it, and can be drawn none the less, goes to `say`.
Expected<ice::Surface> read_surface(const std::string& object, const std::function<void(const std::string&)>& say);

/// The object, turned about the vertical by `turn_rad`.
ice::IceBody body_of(const ice::Surface& surface, const IceOptions& options, double turn_rad);
/// Where the second one stands; it does not turn.
inline constexpr glm::vec3 second_place_m{1.15f, 0.22f, -0.1f};

/// How the object is seen: from the front, a little from above.
instant::FrameInput frame_of(const ice::Surface& surface, const IceOptions& options, double turn_rad);

/// Draws the pictures of one turn into the folder, 000.png and so on, or shows it in a window. The exit status.
Expected<int> run_ice(const IceOptions& options);

}  // namespace septet::ice_viewer
