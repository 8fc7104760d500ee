#include "sim-client/screen/window_shape.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace septet::screen {
namespace {

/// Moves the sides apart: `across` times as wide and `upward` times as high, about the middle.
void stretch(rig::Window& window, double across, double upward) {
  const Vec3 middle = 0.5 * (window.lower_right_m + window.upper_left_m),
             half_right = 0.5 * across * (window.lower_right_m - window.lower_left_m),
             half_up = 0.5 * upward * (window.upper_left_m - window.lower_left_m);
  window = {middle - half_right - half_up, middle + half_right - half_up, middle - half_right + half_up};
}

/// Beginning of a part as long as `was` of a side, now `now`: at the edge near which it was, or about its middle.
double begins(double from, double was, double now) {
  const double middle = from + 0.5 * was;
  if (middle < 0.35) return from;
  return middle > 0.65 ? from + was - now : middle - 0.5 * now;
}

}  // namespace

bool takes_window_shape(const rig::Rig& rig, const rig::Screen& screen) {
  if (screen.only_instruments) return true;
  const auto roads = std::ranges::count_if(rig.screens, [](const rig::Screen& one) { return !one.only_instruments; });
  return screen.show_interior && !screen.full_screen && roads == 1;
}

rig::Screen shaped_to_window(const rig::Screen& screen, const Vec3& eye_m, std::uint32_t width_px,
                             std::uint32_t height_px) {
  rig::Screen shaped = screen;
  shaped.width_px = std::max(width_px, 1u);
  shaped.height_px = std::max(height_px, 1u);
  if (screen.views.empty()) return shaped;
  const double widens = (double(shaped.width_px) / shaped.height_px) / (double(screen.width_px) / screen.height_px);
  rig::Window& whole = shaped.views.front().window;
  const double half_width_m = 0.5 * glm::distance(whole.lower_left_m, whole.lower_right_m);
  const double distance_m = glm::distance(0.5 * (whole.lower_right_m + whole.upper_left_m), eye_m);
  const double most = std::max(1.0, distance_m * std::tan(0.5 * widest_rad) / half_width_m);
  const double across = std::min(widens, most);
  stretch(whole, across, across / widens);
  for (auto view = shaped.views.begin() + 1; view != shaped.views.end(); ++view) {
    const double width = view->width / std::max(widens, 1.0), height = view->height * std::min(widens, 1.0);
    view->left = begins(view->left, view->width, width);
    view->top = begins(view->top, view->height, height);
    view->width = width;
    view->height = height;
  }
  return shaped;
}

}  // namespace septet::screen
