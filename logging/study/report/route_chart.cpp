#include "logging/study/report/route_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/core.h>

#include "engine/document/chart_axis.hpp"
#include "engine/document/markup.hpp"

namespace septet::logging {
namespace {

using document::escaped;

constexpr double route_width = 960.0, route_rim = 30.0, route_head = 30.0, route_foot = 34.0, route_least_inner = 24.0,
                 route_largest_inner = 460.0;
constexpr double route_least_step = 0.8;        ///< In the picture's units, between two drawn points.
constexpr double route_shared_dot = 9.0;        ///< Moments nearer than this to each other share a dot.
constexpr std::size_t most_told_at_a_dot = 12;  ///< Moments in the tip of one dot.
constexpr double route_least_extent_m = 20.0;   ///< A car that stands is no journey.

double kmh_of(const Sample& sample) { return std::isfinite(sample.speed_mps) ? std::abs(sample.speed_mps) * 3.6 : 0.0; }

bool has_place(const Sample& sample) { return std::isfinite(sample.x_m) && std::isfinite(sample.y_m); }

struct PicturePoint {
  double x = 0.0, y = 0.0;
};

double distance(const PicturePoint& a, const PicturePoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// From metres to the picture.
struct Projection {
  double low_x_m, high_y_m, scale, left, top, height;
  PicturePoint operator()(const Sample& sample) const {
    return {left + scale * (sample.x_m - low_x_m), top + scale * (high_y_m - sample.y_m)};
  }
};

std::optional<Projection> projection_of(std::span<const Sample> samples) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low_x = infinity, high_x = -infinity, low_y = infinity, high_y = -infinity;
  for (const Sample& sample : samples) {
    if (!has_place(sample)) continue;
    low_x = std::min(low_x, sample.x_m), high_x = std::max(high_x, sample.x_m);
    low_y = std::min(low_y, sample.y_m), high_y = std::max(high_y, sample.y_m);
  }
  const double wide_m = high_x - low_x, high_m = high_y - low_y;
  if (!(std::max(wide_m, high_m) > 0.0) || !std::isfinite(wide_m + high_m)) return std::nullopt;
  constexpr double inner = route_width - 2.0 * route_rim;
  const double scale = std::min(
      {inner / std::max(wide_m, 1e-9), route_largest_inner / std::max(high_m, 1e-9), inner / route_least_extent_m});
  const double inner_height = std::max(route_least_inner, scale * high_m);
  return Projection{low_x,
                    high_y,
                    scale,
                    route_rim + (inner - scale * wide_m) / 2.0,
                    route_head + route_rim + (inner_height - scale * high_m) / 2.0,
                    route_head + 2.0 * route_rim + inner_height + route_foot};
}

std::string range_text(std::size_t speed_class, double width_kmh) {
  return fmt::format("{:g} to {:g} km/h", width_kmh * static_cast<double>(speed_class),
                     width_kmh * static_cast<double>(speed_class + 1));
}

/// The path as one line for each stretch of a class; a leap, as back to the start, is not drawn.
std::string stretches(std::span<const Sample> samples, const Projection& at, double width_kmh) {
  std::string svg, points;
  const Sample* last = nullptr;
  std::size_t last_class = 0;
  const auto put = [&](const Sample& sample) {
    const PicturePoint point = at(sample);
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", point.x, point.y);
  };
  const auto end = [&] {
    if (points.find(' ') != points.npos)
      svg += fmt::format("<polyline class=\"route v{}\" points=\"{}\"><title>{}</title></polyline>\n", last_class,
                         points, range_text(last_class, width_kmh));
    points.clear();
  };
  for (const Sample& sample : samples) {
    if (!has_place(sample)) continue;
    const auto its_class = std::min(static_cast<std::size_t>(kmh_of(sample) / width_kmh), route_speed_classes - 1);
    if (last) {
      if (distance(at(*last), at(sample)) < route_least_step && &sample != &samples.back()) continue;
      const double passed_s = std::abs(sample.simulated_time_s - last->simulated_time_s);
      const double moved_m = std::hypot(sample.x_m - last->x_m, sample.y_m - last->y_m);
      const bool leapt = moved_m > 20.0 + 3.0 * passed_s * std::max(kmh_of(sample), kmh_of(*last)) / 3.6;
      if (leapt || its_class != last_class) {
        if (!leapt) put(sample);
        end();
      }
    }
    last_class = its_class;
    put(sample);
    last = &sample;
  }
  end();
  return svg;
}

std::string legend(std::size_t classes, double width_kmh) {
  std::string svg;
  for (std::size_t i = 0; i < classes; ++i) {
    const double x = route_rim + 118.0 * static_cast<double>(i);
    svg += fmt::format(
        "<path class=\"route v{}\" d=\"M{:.1f} 34h22\"/><text class=\"legend\" x=\"{:.1f}\" y=\"38\">{}</text>\n", i, x,
        x + 28.0, range_text(i, width_kmh));
  }
  return svg;
}

/// A length in metres that is round and about a sixth of the picture.
std::string scale_bar(const Projection& at) {
  const double sixth_m = route_width / 6.0 / at.scale;
  double round_m = std::pow(10.0, std::floor(std::log10(sixth_m)));
  for (const double factor : {5.0, 2.0})
    if (round_m * factor <= sixth_m) {
      round_m *= factor;
      break;
    }
  const double y = at.height - 14.0, long_units = round_m * at.scale;
  return fmt::format(
      "<path class=\"axis\" d=\"M{:.1f} {:.1f}v-6v3h{:.1f}v-3v6\"/><text class=\"legend\" x=\"{:.1f}\" "
      "y=\"{:.1f}\">{}</text>\n",
      route_rim, y, long_units, route_rim + long_units + 8.0, y + 1.0,
      round_m >= 1000.0 ? fmt::format("{:g} km", round_m / 1000.0) : fmt::format("{:g} m", round_m));
}

/// Moments that share a dot.
struct Dot {
  PicturePoint point;
  std::vector<const RouteMark*> marks;
};

std::vector<Dot> dots_of(std::span<const Sample> samples, std::span<const RouteMark> marks, const Projection& at) {
  std::vector<Dot> dots;
  for (const RouteMark& mark : marks) {
    const auto found = std::ranges::lower_bound(samples, mark.time_s, {}, &Sample::simulated_time_s);
    const Sample& sample = found == samples.end() ? samples.back() : *found;
    if (!has_place(sample)) continue;
    const PicturePoint point = at(sample);
    const auto near =
        std::ranges::find_if(dots, [&](const Dot& dot) { return distance(dot.point, point) < route_shared_dot; });
    if (near == dots.end())
      dots.push_back({point, {&mark}});
    else
      near->marks.push_back(&mark);
  }
  return dots;
}

std::string drawn(const Dot& dot) {
  std::string tip, label;
  std::size_t labels = 0;
  for (std::size_t i = 0; i < dot.marks.size(); ++i) {
    const RouteMark& mark = *dot.marks[i];
    if (i < most_told_at_a_dot) tip += (i ? "\n" : "") + mark.tip;
    // A repeated sign adds nothing.
    const bool is_new = std::none_of(dot.marks.begin(), dot.marks.begin() + static_cast<std::ptrdiff_t>(i),
                                     [&](const RouteMark* other) { return other->label == mark.label; });
    if (!mark.label.empty() && is_new && labels++ < 4) label += (label.empty() ? "" : ", ") + mark.label;
  }
  if (dot.marks.size() > most_told_at_a_dot) tip += fmt::format("\nand {} more", dot.marks.size() - most_told_at_a_dot);
  std::string svg =
      fmt::format("<g><title>{}</title><circle class=\"moment{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", escaped(tip),
                  label.empty() ? "" : " told", dot.point.x, dot.point.y, label.empty() ? 3 : 5);
  if (!label.empty())
    svg += fmt::format("<text class=\"mark-label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", dot.point.x,
                       dot.point.y - 10.0, escaped(label));
  return svg + "</g>\n";
}

std::string end_of_way(const PicturePoint& point, std::string_view name) {
  return fmt::format(
      "<circle class=\"way-end\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/><text class=\"x-tick\" x=\"{:.1f}\" "
      "y=\"{:.1f}\">{}</text>\n",
      point.x, point.y, std::clamp(point.x, route_rim, route_width - route_rim), point.y + 20.0, name);
}

}  // namespace

double speed_class_width_kmh(double largest_kmh) {
  constexpr double classes = route_speed_classes;
  for (double hundred = 1.0; hundred < 1e6; hundred *= 10.0)
    for (const double step : {5.0, 10.0, 20.0, 25.0})
      if (step * hundred * classes >= largest_kmh) return step * hundred;
  return largest_kmh;
}

std::string route_svg(std::span<const Sample> samples, std::span<const RouteMark> marks, std::string_view title) {
  const auto at = projection_of(samples);
  if (!at) return "";
  double largest_kmh = 0.0;
  for (const Sample& sample : samples) largest_kmh = std::max(largest_kmh, kmh_of(sample));
  const double width_kmh = speed_class_width_kmh(largest_kmh);
  const std::size_t classes = std::min(static_cast<std::size_t>(largest_kmh / width_kmh) + 1, route_speed_classes);
  std::string svg = fmt::format(
      "<svg class=\"way\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n<text class=\"title\" "
      "x=\"{}\" "
      "y=\"16\">{}</text>\n",
      route_width, at->height, escaped(title), route_rim, escaped(title));
  svg += legend(classes, width_kmh) + stretches(samples, *at, width_kmh);
  const auto first = std::ranges::find_if(samples, has_place);
  const auto last = std::find_if(samples.rbegin(), samples.rend(), has_place);
  const bool is_loop = distance((*at)(*first), (*at)(*last)) < 40.0;
  svg += end_of_way((*at)(*first), is_loop ? "start, end" : "start");
  if (!is_loop) svg += end_of_way((*at)(*last), "end");
  for (const Dot& dot : dots_of(samples, marks, *at)) svg += drawn(dot);
  return svg + scale_bar(*at) + "</svg>\n";
}

}  // namespace septet::logging
