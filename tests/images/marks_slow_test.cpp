/// The motorway's lines in its pictures, measured in the radiance before exposure.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <doctest/doctest.h>
#include <glm/gtc/quaternion.hpp>

#include "engine/render/renderer.hpp"
#include "engine/road/lane_geometry.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {
namespace {

/// Where a view shows a place, pixels; nothing beside its picture.
std::optional<glm::dvec2> pixel_of(const instant::FrameView& view, const Vec3& place_m) {
  const Vec3 from_eye = glm::conjugate(view.world_from_car.orientation) * (place_m - instant::world_eye(view));
  const glm::dvec4 clip = view.projection.clip_from_eye_relative * glm::dvec4(from_eye, 1.0);
  const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(view.viewport.width, view.viewport.height);
  const bool inside =
      clip.w > 0.0 && at.x > 1.0 && at.x < view.viewport.width - 1.0 && at.y > 8.0 && at.y < view.viewport.height - 8.0;
  return inside ? std::optional(at) : std::nullopt;
}

/// t of the unbroken line to the right of the centre that is nearest to it, and its width.
struct EdgeLine {
  double t_m = -1e9, width_m = 0.0;
};
EdgeLine edge_line(const road::Road& road, double s_m) {
  EdgeLine edge;
  const road::LaneSection& section = road::section_at(road, s_m);
  for (const road::Lane& lane : section.lanes)
    for (const road::RoadMark& mark : lane.marks)
      for (const road::RoadMarkLine& line : mark.lines) {
        const double t_m = road::outer_border_t_m(road, section, lane.id, s_m) + line.t_offset_m;
        if (lane.id < 0 && line.space_m == 0.0 && line.width_m > 0.0 && t_m > edge.t_m) edge = {t_m, line.width_m};
      }
  return edge;
}

}  // namespace

TEST_CASE(
    "the solid line at the edge of a motorway has no gap and the light of its breadth from ten to a hundred and fifty "
    "metres ahead") {
  const Motorway motorway;
  const road::Road& road = road::motorway().roads[0];
  for (const std::uint32_t magnified : {2u, 3u}) {
    const std::uint32_t wide = motorway_width_px * magnified, high = motorway_height_px * magnified;
    auto renderer = render::Renderer::create(
        {wide, high, render::DevicePreference::software, true, render::Antialiasing::none, nullptr});
    REQUIRE(renderer.has_value());
    REQUIRE(renderer->upload(motorway.scene()).has_value());
    constexpr double eye_s_m = 2400.0;
    instant::FrameInput input = motorway.frame({"edge line", eye_s_m, 0.0, false, false});
    input.environment.cloud_cover = 1.0;  // No shadow lies on it.
    input.participants.clear();
    input.views[0].viewport = {0, 0, wide, high};
    REQUIRE(renderer->draw(input).has_value());
    CHECK_MESSAGE(renderer->statistics().validation_messages == 0, renderer->statistics().first_validation_message);
    const render::RadianceImage light = *renderer->read_radiance();
    std::vector<double> shares;
    double last_x = 1e9;
    for (double ahead_m = 10.0; ahead_m < 150.0; ahead_m += 0.25) {
      const double s_m = eye_s_m + ahead_m;
      const EdgeLine edge = edge_line(road, s_m);
      const auto place_m = [&](double t_m) { return road::evaluate(road::motorway(), {0, s_m, t_m}).position_m; };
      const auto middle = pixel_of(input.views[0], place_m(edge.t_m)),
                 nearer = pixel_of(input.views[0], place_m(edge.t_m + 0.5 * edge.width_m)),
                 further = pixel_of(input.views[0], place_m(edge.t_m - 0.5 * edge.width_m)),
                 onwards =
                     pixel_of(input.views[0], road::evaluate(road::motorway(), {0, s_m + 1.0, edge.t_m}).position_m);
      if (!middle || !nearer || !further || !onwards || std::abs(middle->x - last_x) < 1.0) continue;
      last_x = middle->x;
      // Its breadth down a column, and the light that the column has there more than the asphalt on this side.
      const double climb = (onwards->y - middle->y) / (onwards->x - middle->x);
      const double breadth_px = std::abs((nearer->y - further->y) - (nearer->x - further->x) * climb);
      const auto x = static_cast<std::uint32_t>(middle->x), y = static_cast<std::uint32_t>(middle->y);
      const auto reach = static_cast<std::uint32_t>(std::ceil(0.5 * breadth_px));
      const double asphalt = light.at(x, y + reach + 1).g;
      double more = 0.0;
      for (std::uint32_t row = y - reach; row <= y + reach; ++row) more += light.at(x, row).g / asphalt - 1.0;
      shares.push_back(more / breadth_px);
    }
    REQUIRE(shares.size() > 30 * magnified);
    std::vector<double> sorted = shares;
    std::sort(sorted.begin(), sorted.end());
    const double usual = sorted[sorted.size() / 2];
    CAPTURE(magnified);
    CAPTURE(usual);
    CAPTURE(sorted.back());
    CHECK(usual > 2.0);  // Paint against asphalt.
    CHECK(sorted.front() > 0.4 * usual);
    CHECK(sorted.back() < 1.6 * usual);
  }
}

}  // namespace septet
