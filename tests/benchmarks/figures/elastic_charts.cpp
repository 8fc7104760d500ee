#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/document/chart_page.hpp"
#include "engine/document/text_file.hpp"
#include "tests/benchmarks/figures/elastic_figures.hpp"
#include "tests/benchmarks/figures/swinging_cube.hpp"
#include "tests/benchmarks/figures/thread_time.hpp"
#include "tests/engine/physics/elastic/beam.hpp"
#include "tests/engine/physics/elastic/beam_geometries.hpp"

namespace septet::figures {
namespace {

using namespace septet::elastic;
using document::Range;
using document::Series;
using document::Stroke;

struct Plot {
  std::string title, x_label, y_label;
  std::string claim;     ///< The paper's claim.
  std::string measured;  ///< The result.
  std::vector<Series> series;
  std::optional<Range> y;
};

std::string to_svg(const Plot& plot) {
  document::LineChart chart;
  chart.x_label = plot.x_label;
  chart.y_label = plot.y_label;
  chart.series = plot.series;
  chart.y = plot.y;
  return document::to_svg(document::ChartPage{.title = plot.title,
                                              .lines = {"Paper: " + plot.claim, "Here: " + plot.measured},
                                              .charts = {chart},
                                              .notes = {}});
}

Plot swinging_cube_figure() {
  using swinging_cube::Stepper;
  Plot plot{"Figure 3: height of the corner of a swinging cube",
            "time, s",
            "height, m",
            "linear implicit Euler takes 35 % longer at 0.05 s, the regularised stepper keeps time",
            "",
            {},
            {}};
  double regularised_s = 0.0, implicit_s = 0.0;
  std::vector<double> heights;
  for (const auto& [name, stepper, dt, mark] :
       {std::tuple{"implicit Euler, 0.05 s", Stepper::implicit_euler, 0.05, Stroke::dots},
        std::tuple{"implicit Euler, 0.005 s", Stepper::implicit_euler, 0.005, Stroke::dashed},
        std::tuple{"regularised, 0.05 s", Stepper::regularised, 0.05, Stroke::dots},
        std::tuple{"regularised, 0.005 s", Stepper::regularised, 0.005, Stroke::line}}) {
    heights = swinging_cube::heights(stepper, dt, 3.0, 2.0);
    Series series{name, {}, mark};
    for (std::size_t i = 0; i < heights.size(); ++i) series.points.push_back({dt * static_cast<double>(i), heights[i]});
    if (dt == 0.05)
      (stepper == Stepper::regularised ? regularised_s : implicit_s) = swinging_cube::time_of_minimum_s(heights, dt);
    plot.series.push_back(std::move(series));
  }
  const double reference_s = swinging_cube::time_of_minimum_s(heights, 0.005);
  plot.measured = fmt::format("time to the minimum at 0.05 s: {:+.0f} % with implicit Euler, {:+.1f} % regularised",
                              100 * (implicit_s / reference_s - 1), 100 * (regularised_s / reference_s - 1));
  return plot;
}

Plot pull_figure() {
  Plot plot{"Figure 8: pull and push of a beam",
            "F / YA",
            "ΔL / L",
            "five geometries fit Hooke's law, with a clear dependence on the mesh",
            "",
            {},
            {}};
  Series hooke{"Hooke: F / YA", {}, Stroke::dashed};
  Series exact{"St. Venant-Kirchhoff: s(s²-1)/2 = F / YA", {}, Stroke::line};
  for (int k = -10; k <= 10; ++k) {
    const double load = 0.01 * k;
    hooke.points.push_back({load, load});
    exact.points.push_back({load, beam::st_venant_kirchhoff_strain(load)});
  }
  double worst = 0.0;
  plot.series = {hooke, exact};
  for (const beam::Geometry& geometry : beam::five_geometries()) {
    Series series{geometry.name, {}, Stroke::dots};
    for (const double load : {0.001, 0.02, 0.04, 0.06, 0.08, 0.1}) {
      ElasticBody body = *make_elastic_body(geometry.mesh, {1e8, 0.25, 1000.0});
      series.points.push_back({load, beam::static_stretch(body, 1e8 * load, false)});
      worst = std::max(worst, std::abs(series.points.back().y / beam::st_venant_kirchhoff_strain(load) - 1));
    }
    plot.series.push_back(std::move(series));
  }
  Series push{"pushed block of 40 tetrahedra", {}, Stroke::dots};
  for (const double load : {-0.02, -0.04, -0.06, -0.08, -0.1}) {
    push.points.push_back({load, beam::static_push_strain(2, load)});
    worst = std::max(worst, std::abs(push.points.back().y / beam::st_venant_kirchhoff_strain(load) - 1));
  }
  plot.series.push_back(std::move(push));
  plot.measured = fmt::format(
      "all five within {:.1f} % of St. Venant-Kirchhoff; Hooke's law itself only at small strain", 100 * worst);
  return plot;
}

Plot twist_figure() {
  Plot plot{"Figure 9: twist of a beam",
            "τL / μK, rad",
            "twist of the end, rad",
            "105 tetrahedra fit theory, with a clear dependence on the mesh",
            "",
            {},
            {}};
  plot.series.push_back({"theory: τL / μK", {{0, 0}, {0.001, 0.001}}, Stroke::dashed});
  const auto add = [&](const std::string& name, double ratio, Stroke stroke) {
    plot.series.push_back({name, {{0, 0}, {0.001, 0.001 * ratio}}, stroke});
  };
  std::string finer;
  for (const auto& [cells, count] : {std::pair{2, 840}, std::pair{4, 6720}}) {
    const double ratio = beam::static_twist_ratio(cells);
    finer += fmt::format(", {} reach {:.2f}", count, ratio);
    add(fmt::format("{} tetrahedra", count), ratio, Stroke::dashed);
  }
  double least = 1.0, most = 0.0;
  for (const beam::Geometry& g : beam::five_geometries()) {
    const double ratio = beam::static_twist_ratio(*make_elastic_body(g.mesh, {1e8, 0.25, 1000.0}),
                                                  {g.width_m / 2, beam::side_m / 2}, g.torsion_constant());
    least = std::min(least, ratio), most = std::max(most, ratio);
    add(g.name, ratio, Stroke::line);
  }
  plot.measured = fmt::format("the five reach {:.3f} to {:.3f} of theory{}", least, most, finer);
  return plot;
}

Plot energy_figure() {
  Plot plot{"Figure 10: deformation energy of a soft swinging beam",
            "time, s",
            "energy, J",
            "dissipation increases with decreasing time step",
            "",
            {},
            {}};
  std::string kept;
  for (const double dt : {0.02, 0.01, 0.005, 0.0025}) {
    ElasticBody body = beam::make(1, {8e3, 0.25, 10.0 / (beam::area_m2 * beam::length_m)});
    beam::clamp_start(body);
    StepSettings settings;
    settings.step_s = dt;
    settings.damping_ratio = 0.0;  // As published: no damping but the stepper's own.
    settings.gravity_mps2 = {0, -9.81, 0};
    Series series{fmt::format("Δt = {} ms", 1e3 * dt), {}, Stroke::line};
    double late = 0.0;
    for (double t = 0.0; t < 12.0; t += dt) {
      step_elastic(body, settings);
      series.points.push_back({t + dt, elastic_energy_j(body)});
      if (t > 9.0) late = std::max(late, kinetic_energy_j(body));
    }
    kept += fmt::format("{}{:.2g} J", kept.empty() ? "" : ", ", late);
    plot.series.push_back(std::move(series));
  }
  plot.measured = "largest kinetic energy after 9 s, by time step from the coarsest: " + kept;
  return plot;
}

double median_step_ms(int cells_long, Solver solver) {
  auto made = make_elastic_body(lattice_mesh({1, 1, cells_long}, {0.1, 0.1, 0.1 * cells_long}), {1e8, 0.25, 1000.0});
  ElasticBody& body = *made;
  beam::clamp_start(body);
  StepSettings settings;
  settings.solver = solver;
  settings.gravity_mps2 = {0, -9.81, 0};
  std::vector<double> times;
  for (int k = 0; k < 31; ++k) {
    const double start = thread_time_s();
    step_elastic(body, settings);
    if (k > 0) times.push_back(1e3 * (thread_time_s() - start));
  }
  std::ranges::sort(times);
  return times[times.size() / 2];
}

Plot time_figure() {
  Plot plot{"Figure 11: time of a step against the size of a beam",
            "tetrahedra",
            "time, ms",
            "linear in the number of tetrahedra; 15 ms at 200 of them (Pentium 4, eq. 21)",
            "",
            {},
            {}};
  Series direct{"direct", {}, Stroke::line}, factor{"factor at rest", {}, Stroke::line};
  for (const int cells : {10, 20, 40, 80, 120, 160, 200, 300, 400}) {
    for (Series* s : {&direct, &factor}) {
      s->points.push_back({5.0 * cells, median_step_ms(cells, s == &direct ? Solver::direct : Solver::rest_factor)});
    }
  }
  plot.measured =
      fmt::format("{:.3f} ms at 200, {:.2f} ms at 2000 tetrahedra, direct; {:.2f} ms with the factor at rest",
                  direct.points[2].y, direct.points.back().y, factor.points.back().y);
  plot.series = {direct, factor};
  plot.y = Range{0.0, 1.1 * std::max(direct.points.back().y, factor.points.back().y)};
  return plot;
}

}  // namespace

Expected<ElasticFigures> draw_elastic_charts(const std::filesystem::path& folder) {
  ElasticFigures figures;
  for (const auto& [number, name, make] :
       {std::tuple{"3", "elastic-3-swinging-cube", &swinging_cube_figure},
        std::tuple{"8", "elastic-8-pull", &pull_figure}, std::tuple{"9", "elastic-9-twist", &twist_figure},
        std::tuple{"10", "elastic-10-energy", &energy_figure}, std::tuple{"11", "elastic-11-time", &time_figure}}) {
    const Plot plot = make();
    figures.push_back({number, std::string(name) + ".svg", plot.claim, plot.measured});
    if (const auto written = document::write_text_file(folder / figures.back().file, to_svg(plot)); !written)
      return tl::unexpected(written.error());
  }
  return figures;
}

}  // namespace septet::figures
