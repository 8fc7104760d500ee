#include "tests/benchmarks/figures/elastic_figures.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "engine/document/text_file.hpp"
#include "tests/engine/physics/elastic/beam.hpp"

namespace septet::figures {
namespace {

/// How much of theory's twist and bend the beam reaches on finer and finer meshes, by Poisson's ratio.
std::string convergence_table() {
  std::string table =
      "| Poisson's ratio | twist: 105 tetrahedra | 840 | 6,720 | bend: 105 tetrahedra | 840 | 6,720 |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const double ratio : {0.25, 0.4998, 0.5}) {
    std::string twists, bends;
    for (const int cells : {1, 2, 4}) {
      twists += fmt::format(" {:.3f} |", elastic::beam::static_twist_ratio(cells, ratio));
      bends += fmt::format(" {:.3f} |", elastic::beam::static_bend_ratio(cells, ratio));
    }
    table += fmt::format("| {} |{}{}\n", ratio, twists, bends);
  }
  return table;
}

}  // namespace

Expected<void> draw_elastic(const std::filesystem::path& folder) {
  auto figures = draw_elastic_pictures(folder);
  if (!figures) return tl::unexpected(figures.error());
  const auto charts = draw_elastic_charts(folder);
  if (!charts) return tl::unexpected(charts.error());
  figures->insert(figures->end(), charts->begin(), charts->end());
  std::ranges::stable_sort(*figures, {}, [](const ElasticFigure& f) { return std::stoi(f.number); });
  std::string table = "| figure | published | here | picture |\n|---|---|---|---|\n";
  for (const ElasticFigure& f : *figures) {
    table += fmt::format("| {} | {} | {} | `{}` |\n", f.number, f.published, f.here, f.file);
    fmt::print("{}\n  paper: {}\n  here:  {}\n", (folder / f.file).string(), f.published, f.here);
  }
  return document::write_text_file(folder / "elastic.md", table + "\n" + convergence_table());
}

}  // namespace septet::figures
