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
  std::string object = "cube";  ///< Name of ice::object, or an OBJ file.
  Surroundings surroundings = Surroundings::outdoors;
  ice::Look look;
  std::uint32_t cracks = 2, air_planes = 19;  ///< Numbers of the paper.
  bool pair = false;                          ///< A second one stands behind it.
  bool mark_cracks = false;                   ///< Marks in red, as in figure 5.
  std::uint64_t seed = 1;
  std::uint32_t width_px = 800, height_px = 600;
  std::uint32_t pictures = 8;  ///< Pictures of one turn.
  std::uint32_t surroundings_px = 256;
  bool surroundings_kept = false;  ///< The first picture's surroundings serve for all.
  double share_of_picture = 0.2;   ///< Approximate share that the object covers; more: the camera is nearer.
  double turn_deg = 0.0;           ///< Turn in the first picture.
  bool window = false;             ///< Shows a window instead of pictures.
  bool software = false;
  std::filesystem::path out = "ice";
  std::filesystem::path reference;  ///< Folder for a path tracer's input to draw the same; empty: not written.
};

/// Object by its name or from its file. Faults that do not prevent drawing go to `say`.
Expected<ice::Surface> read_surface(const std::string& object, const std::function<void(const std::string&)>& say);

/// Object turned about the vertical by `turn_rad`.
ice::IceBody body_of(const ice::Surface& surface, const IceOptions& options, double turn_rad);
/// Place of the second object; it does not turn.
inline constexpr glm::vec3 second_place_m{1.15f, 0.22f, -0.1f};

/// View of the object: from the front, a little from above.
instant::FrameInput frame_of(const ice::Surface& surface, const IceOptions& options, double turn_rad);

/// Draws the pictures of one turn into the folder, 000.png and so on, or shows it in a window. Returns the exit status.
Expected<int> run_ice(const IceOptions& options);

}  // namespace septet::ice_viewer
