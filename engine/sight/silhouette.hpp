#pragma once
/// How much of a body an eye has before it: the share of its silhouette without anything opaque on the way, and the
/// light that passes there.
///
/// The silhouette is a picture of the body alone from the eye: a raster of lines through a flat picture, one a pixel,
/// that holds the body's box. Unobstructed does not mean seen: attention, contrast, glare and the dark play no part. One
/// eye in the middle between the two.
///
/// World frame, metres, radians. Pure: the caller's function, which knows the world, describes each line; `sight_of_box`
/// does so with boxes alone, for models without triangles.

#include <cstdint>
#include <functional>
#include <span>

#include "engine/sight/line_of_sight.hpp"

namespace septet::sight {

/// Description of a line.
struct OnLine {
  bool meets_target = false;   ///< It would, were the target alone.
  double transmittance = 0.0;  ///< Share of light that passes from there to the eye; 0: something opaque is before it.
  double target_m = 0.0;       ///< Distance of the target along the line.
};

struct Sight {
  std::uint32_t silhouette = 0;    ///< Lines that meet the target alone.
  std::uint32_t unobstructed = 0;  ///< Lines of these without anything opaque before it.
  double transmittance = 0.0;      ///< Mean over the unobstructed lines; 0 without any.
  double nearest_m = 0.0;          ///< Distance of the nearest point of the target that a line meets; 0 without any.
  double solid_angle_sr = 0.0;     ///< Of the whole silhouette.

  double share() const { return silhouette ? static_cast<double>(unobstructed) / silhouette : 0.0; }
};

/// Lines from an eye through the pixels of a flat picture that just holds a box. Of a box around or right beside the
/// eye the picture is cut off 75° from the direction of its middle.
class Raster {
 public:
  /// `longer_side`: pixels along the longer side, 1 or more.
  Raster(const Vec3& eye_m, const Box& box, std::uint32_t longer_side);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Line through a pixel, counted from the upper left, at a place that differs from row to row and from column to
  /// column: an upright or level edge moves past the lines one by one, not row by row.
  Line line(std::uint32_t x, std::uint32_t y) const;
  /// Solid angle of a pixel.
  double solid_angle_sr(const Line& line) const;

 private:
  Vec3 eye_m_, ahead_, right_, up_;
  double left_slope_ = 0.0, top_slope_ = 0.0, pixel_slope_ = 0.0;
  std::uint32_t width_ = 1, height_ = 1;
};

/// Sight by the lines of a raster. `on_line`: OnLine of a Line.
template <class OnLineOf>
Sight look(const Raster& raster, const OnLineOf& on_line) {
  Sight sight;
  double passed = 0.0;
  for (std::uint32_t y = 0; y < raster.height(); ++y)
    for (std::uint32_t x = 0; x < raster.width(); ++x) {
      const Line line = raster.line(x, y);
      const OnLine met = on_line(line);
      if (!met.meets_target) continue;
      if (sight.silhouette++ == 0 || met.target_m < sight.nearest_m) sight.nearest_m = met.target_m;
      sight.solid_angle_sr += raster.solid_angle_sr(line);
      if (!(met.transmittance > 0.0)) continue;
      ++sight.unobstructed;
      passed += met.transmittance;
    }
  if (sight.unobstructed) sight.transmittance = passed / sight.unobstructed;
  return sight;
}

/// Air and opaque boxes between an eye and what it looks at.
struct Surroundings {
  std::span<const Box> boxes;                             ///< Neither the eye's own body nor the target.
  std::function<double(const Vec3&)> extinction_per_m{};  ///< Empty: clear air.
  double step_m = 0.5;                                    ///< Of the integral through it.
};

/// Sight of a box past boxes, for simulated drivers and traffic.
Sight sight_of_box(const Vec3& eye_m, const Box& target, const Surroundings& between, std::uint32_t longer_side = 16);

}  // namespace septet::sight
