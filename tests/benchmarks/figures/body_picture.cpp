#include "tests/benchmarks/figures/body_picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "engine/document/markup.hpp"
#include "engine/physics/elastic/tetrahedral_mesh.hpp"

namespace septet::figures {
namespace {

constexpr double page_width = 900.0, margin = 20.0, caption_height = 24.0, most_panel_height = 420.0;

/// Right, down and away from the eye.
Eigen::Matrix3d axes_of(const PicturePage& page) {
  Eigen::Matrix3d axes;
  const Eigen::Vector3d along = page.along.normalized(), right = along.cross(page.up).normalized();
  axes.row(0) = right;
  axes.row(1) = along.cross(right);
  axes.row(2) = along;
  return axes;
}

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;

  void include(const Eigen::Vector3d& p) {
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  }
};

Bounds bounds_of(const Panel& panel, const Eigen::Matrix3d& axes) {
  Bounds bounds;
  for (const Facet& facet : panel.facets)
    for (const auto& corner : facet.corners_m) bounds.include(axes * corner);
  for (const auto* segments : {&panel.behind, &panel.lines})
    for (const Segment& segment : *segments) {
      bounds.include(axes * segment.from_m);
      bounds.include(axes * segment.to_m);
    }
  return bounds;
}

/// From metres along the axes to a place on the page.
struct Placing {
  Eigen::Vector2d middle_m, middle_px;
  double px_per_m;

  Eigen::Vector2d operator()(const Eigen::Vector3d& seen_m) const {
    return middle_px + px_per_m * (seen_m.head<2>() - middle_m);
  }
};

std::string drawn(const std::vector<Segment>& segments, const Eigen::Matrix3d& axes, const Placing& place) {
  std::string svg;
  for (const Segment& s : segments) {
    const Eigen::Vector2d a = place(axes * s.from_m), b = place(axes * s.to_m);
    svg += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#{:02x}{:02x}{:02x}\" "
        "stroke-width=\"1.4\"/>\n",
        a.x(), a.y(), b.x(), b.y(), s.colour.red, s.colour.green, s.colour.blue);
  }
  return svg;
}

/// Facets that face the eye, the far ones first, shaded by a light from above the eye's shoulder.
std::string drawn(const std::vector<Facet>& facets, const Eigen::Matrix3d& axes, const Placing& place) {
  struct Seen {
    double depth_m;
    std::string polygon;
  };
  const Eigen::Vector3d light = Eigen::Vector3d(-0.3, -0.55, -0.78).normalized();
  std::vector<Seen> seen;
  for (const Facet& facet : facets) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = axes * facet.corners_m[c];
    const Eigen::Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    if (!(normal.z() < 0.0)) continue;
    const double shade = 0.45 + 0.55 * std::max(0.0, normal.dot(light));
    std::string points;
    for (const auto& corner : p) {
      const Eigen::Vector2d at = place(corner);
      points += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
    }
    const auto lit = [&](std::uint8_t of) { return static_cast<int>(std::lround(shade * of)); };
    seen.push_back({(p[0] + p[1] + p[2]).z() / 3.0,
                    fmt::format("<polygon points=\"{}\" fill=\"#{:02x}{:02x}{:02x}\" stroke=\"#333\" "
                                "stroke-width=\"0.4\" stroke-linejoin=\"round\"/>\n",
                                points, lit(facet.colour.red), lit(facet.colour.green), lit(facet.colour.blue))});
  }
  std::ranges::stable_sort(seen, std::greater{}, &Seen::depth_m);
  std::string svg;
  for (const Seen& s : seen) svg += s.polygon;
  return svg;
}

/// Words in lines of at most `most` bytes, broken at spaces.
std::vector<std::string> wrapped(const std::string& words, std::size_t most) {
  std::vector<std::string> lines;
  std::size_t from = 0;
  while (words.size() - from > most) {
    const std::size_t space = words.rfind(' ', from + most);
    if (space == std::string::npos || space <= from) break;
    lines.push_back(words.substr(from, space - from));
    from = space + 1;
  }
  lines.push_back(words.substr(from));
  return lines;
}

std::string text(double x, double y, int size_px, bool bold, const std::string& words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\"{}>{}</text>\n", x, y, size_px,
                     bold ? " font-weight=\"bold\"" : "", document::escaped(words));
}

}  // namespace

std::vector<Facet> surface_of(const elastic::ElasticBody& body, Colour colour) {
  std::vector<elastic::Tetrahedron> tetrahedra;
  for (const elastic::Element& e : body.elements) tetrahedra.push_back(e.nodes);
  std::vector<Facet> facets;
  for (const auto& face : elastic::surface_triangles(body.rest_position_m, tetrahedra))
    facets.push_back(
        {{body.position_m[face.nodes[0]], body.position_m[face.nodes[1]], body.position_m[face.nodes[2]]}, colour});
  return facets;
}

std::string to_svg(const PicturePage& page) {
  const Eigen::Matrix3d axes = axes_of(page);
  Eigen::Vector2d largest_m(0.0, 0.0);
  std::vector<Bounds> bounds;
  for (const Panel& panel : page.panels) {
    bounds.push_back(bounds_of(panel, axes));
    largest_m = largest_m.cwiseMax(bounds.back().high - bounds.back().low);
  }
  const double panel_width = (page_width - margin) / page.columns;
  const double px_per_m = std::min((panel_width - margin) / largest_m.x(), most_panel_height / largest_m.y());
  const double panel_height = px_per_m * largest_m.y() + caption_height + margin;
  std::vector<std::string> lines;
  for (const std::string& line : page.lines)
    for (std::string& part : wrapped(line, 118)) lines.push_back(std::move(part));
  const double head = 44.0 + 20.0 * static_cast<double>(lines.size());
  const auto columns = static_cast<std::size_t>(page.columns);
  const std::size_t rows = (page.panels.size() + columns - 1) / columns;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "font-family=\"DejaVu Sans, sans-serif\" fill=\"#222\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      page_width, head + panel_height * static_cast<double>(rows) + margin);
  svg += text(margin, 30.0, 20, true, page.title);
  for (std::size_t n = 0; n < lines.size(); ++n)
    svg += text(margin, 51.0 + 20.0 * static_cast<double>(n), 13, false, lines[n]);
  for (std::size_t n = 0; n < page.panels.size(); ++n) {
    const Panel& panel = page.panels[n];
    const double left = margin + panel_width * static_cast<double>(n % columns),
                 top = head + panel_height * static_cast<double>(n / columns);
    const Placing place{
        0.5 * (bounds[n].low + bounds[n].high),
        {left + 0.5 * (panel_width - margin), top + caption_height + 0.5 * (panel_height - caption_height)},
        px_per_m};
    svg += text(left, top + 16.0, 13, false, panel.caption);
    svg += drawn(panel.behind, axes, place) + drawn(panel.facets, axes, place) + drawn(panel.lines, axes, place);
  }
  return svg + "</svg>\n";
}

}  // namespace septet::figures
