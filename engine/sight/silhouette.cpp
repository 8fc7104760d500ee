#include "engine/sight/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace septet::sight {
namespace {

constexpr double widest_slope = 3.732;  ///< tan 75°.
constexpr double least_slope = 1e-9;
/// Its multiples lie most evenly between whole numbers.
constexpr double golden_ratio = std::numbers::phi - 1.0;

}  // namespace

Raster::Raster(const Vec3& eye_m, const Box& box, std::uint32_t longer_side) : eye_m_(eye_m) {
  const Vec3 to_middle = box.world_from_box.position_m - eye_m;
  const double distance_m = glm::length(to_middle);
  ahead_ = distance_m > 0.0 ? to_middle / distance_m : Vec3(1, 0, 0);
  right_ = glm::normalize(glm::cross(ahead_, std::abs(ahead_.z) < 0.99 ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
  up_ = glm::cross(right_, ahead_);
  double low_x = widest_slope, high_x = -widest_slope, low_y = widest_slope, high_y = -widest_slope;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 signs((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const Vec3 to_corner = box.world_from_box * (signs * box.half_m) - eye_m;
    const double depth_m = glm::dot(to_corner, ahead_);
    const double least_m = glm::length(to_corner) / std::hypot(1.0, widest_slope);
    if (depth_m < least_m) {
      low_x = low_y = -widest_slope, high_x = high_y = widest_slope;
      break;
    }
    const double x = glm::dot(to_corner, right_) / depth_m, y = glm::dot(to_corner, up_) / depth_m;
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  const double width = std::max(high_x - low_x, least_slope), height = std::max(high_y - low_y, least_slope);
  pixel_slope_ = std::max(width, height) / std::max(1u, longer_side);
  const auto pixels = [&](double slopes) {
    return std::max(1u, static_cast<std::uint32_t>(std::ceil(slopes / pixel_slope_ - 1e-9)));
  };
  width_ = pixels(width), height_ = pixels(height);
  left_slope_ = 0.5 * (low_x + high_x) - 0.5 * width_ * pixel_slope_;
  top_slope_ = 0.5 * (low_y + high_y) + 0.5 * height_ * pixel_slope_;
}

Line Raster::line(std::uint32_t x, std::uint32_t y) const {
  const auto within = [](std::uint32_t n) { return std::fmod(0.5 + n * golden_ratio, 1.0); };
  return {eye_m_, glm::normalize(ahead_ + (left_slope_ + (x + within(y)) * pixel_slope_) * right_ +
                                 (top_slope_ - (y + within(x)) * pixel_slope_) * up_)};
}

double Raster::solid_angle_sr(const Line& line) const {
  const double cosine = glm::dot(line.direction, ahead_);
  return pixel_slope_ * pixel_slope_ * cosine * cosine * cosine;
}

Sight sight_of_box(const Vec3& eye_m, const Box& target, const Surroundings& between, std::uint32_t longer_side) {
  return look(Raster(eye_m, target, longer_side), [&](const Line& line) {
    OnLine met;
    const auto target_m = entry_m(target, line);
    if (!target_m) return met;
    met.meets_target = true;
    met.target_m = *target_m;
    for (const Box& box : between.boxes)
      if (const auto before_m = entry_m(box, line); before_m && *before_m < *target_m) return met;
    met.transmittance =
        between.extinction_per_m ? transmittance(line, *target_m, between.step_m, between.extinction_per_m) : 1.0;
    return met;
  });
}

}  // namespace septet::sight
