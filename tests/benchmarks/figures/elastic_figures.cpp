#include "tests/benchmarks/figures/elastic_figures.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/document/text_file.hpp"

namespace septet::figures {

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
  return document::write_text_file(folder / "elastic.md", table);
}

}  // namespace septet::figures
