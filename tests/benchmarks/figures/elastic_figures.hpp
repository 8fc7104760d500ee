#pragma once
/// Figures of Servin, Lacoursière and Melin (2006) from Septet's own stepper, each with what the paper tells of it.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::figures {

/// One row of the table of the figures.
struct ElasticFigure {
  std::string number;     ///< As the paper counts them.
  std::string file;       ///< Name of the picture.
  std::string published;  ///< What the paper tells.
  std::string here;       ///< The result.
};

using ElasticFigures = std::vector<ElasticFigure>;

/// Figures 1, 2 and 4 to 7, and the five geometries of figures 8 and 9.
Expected<ElasticFigures> draw_elastic_pictures(const std::filesystem::path& folder);
/// Figures 3 and 8 to 11.
Expected<ElasticFigures> draw_elastic_charts(const std::filesystem::path& folder);
/// All of them, and in `elastic.md` their table and that of the beam's convergence.
Expected<void> draw_elastic(const std::filesystem::path& folder);

}  // namespace septet::figures
