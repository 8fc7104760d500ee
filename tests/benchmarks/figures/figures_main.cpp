// septet-figures: figures of papers from Septet's own functions, each with the paper's claim and the result.

#include <filesystem>
#include <initializer_list>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "engine/core/expected.hpp"
#include "tests/benchmarks/figures/elastic_figures.hpp"
#include "tests/benchmarks/figures/ice_figures.hpp"
#include "tests/benchmarks/figures/motion_figures.hpp"
#include "tests/benchmarks/figures/smoke_figures.hpp"

int main(int argc, char** argv) {
  using namespace septet::figures;
  CLI::App app{
      "Draws figures of the papers on elastic materials, ice, turning, face normals and smoke from measurements"};
  std::string folder;
  app.add_option("folder", folder, "where the files go")->required();
  bool elastic_alone = false, ice_alone = false, motion_alone = false, smoke_alone = false;
  app.add_flag("--elastic", elastic_alone, "those of the paper on elastic materials alone");
  app.add_flag("--ice", ice_alone, "those of the paper on ice alone");
  app.add_flag("--motion", motion_alone, "those of the papers on turning and on face normals alone");
  app.add_flag("--smoke", smoke_alone, "those of the paper on smoke alone");
  CLI11_PARSE(app, argc, argv);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const auto draw_all = [&](std::initializer_list<septet::Expected<void> (*)(const std::filesystem::path&)> draws) {
    for (const auto draw : draws)
      if (const auto drawn = draw(folder); !drawn) {
        fmt::print(stderr, "{}\n", describe(drawn.error()));
        return 1;
      }
    return 0;
  };
  if (elastic_alone) return draw_all({draw_elastic});
  if (smoke_alone) return draw_all({draw_smoke_sampling, draw_smoke_room});
  if (motion_alone) return draw_all({draw_turns, draw_normals});
  if (ice_alone) return draw_all({draw_ice_pictures, draw_ice_times});
  return draw_all({draw_ice_pictures, draw_ice_times, draw_turns, draw_normals, draw_smoke_sampling, draw_smoke_room,
                   draw_elastic});
}
