#pragma once
/// Pictures of bodies as SVG: their surfaces seen from far away, in panels of one scale.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::figures {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
};
inline constexpr Colour orange{226, 150, 62}, blue{96, 150, 200};

/// A triangle, counter-clockwise seen from outside.
struct Facet {
  std::array<Eigen::Vector3d, 3> corners_m;
  Colour colour;
};

struct Segment {
  Eigen::Vector3d from_m, to_m;
  Colour colour;
};

struct Panel {
  std::string caption;
  std::vector<Facet> facets;
  std::vector<Segment> behind;  ///< Drawn below the facets.
  std::vector<Segment> lines;   ///< Drawn over them.
};

struct PicturePage {
  std::string title;
  std::vector<std::string> lines;  ///< Below the title.
  std::vector<Panel> panels;
  int columns = 1;
  Eigen::Vector3d along{-0.3, -1.0, 0.2},
      up{1.0, 0.0, 0.0};  ///< The direction of sight, and what is up in the picture.
};

/// The outer surface of a body at its present places.
std::vector<Facet> surface_of(const elastic::ElasticBody& body, Colour colour);

std::string to_svg(const PicturePage& page);

}  // namespace septet::figures
