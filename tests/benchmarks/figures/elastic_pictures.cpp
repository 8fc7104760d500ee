#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "engine/core/check.hpp"
#include "engine/document/text_file.hpp"
#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/benchmarks/figures/body_picture.hpp"
#include "tests/benchmarks/figures/elastic_figures.hpp"
#include "tests/benchmarks/figures/swinging_cube.hpp"
#include "tests/benchmarks/figures/thread_time.hpp"
#include "tests/engine/physics/elastic/beam.hpp"
#include "tests/engine/physics/elastic/beam_geometries.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"
#include "tests/engine/physics/elastic/equilibrium.hpp"
#include "tests/engine/physics/elastic/twisted_beam.hpp"

namespace septet::figures {
namespace {

using namespace septet::elastic;

struct Picture {
  PicturePage page;
  ElasticFigure figure;
};

constexpr Colour black{40, 40, 40}, red{200, 64, 42};

ElasticBody must(Expected<ElasticBody> made) {
  SEPTET_CHECK(made.has_value(), "{}", made.error().what);
  return std::move(*made);
}

/// Figure 1 --------------------------------------------------------------------------------------------------------

/// A ball about the origin: a lattice whose cubes about the middle become shells.
TetrahedralMesh ball_mesh(int cells, double radius_m) {
  TetrahedralMesh mesh = lattice_mesh({cells, cells, cells}, {2.0, 2.0, 2.0});
  for (Eigen::Vector3d& node : mesh.nodes_m) {
    node.array() -= 1.0;
    if (node.norm() > 0.0) node *= radius_m * node.cwiseAbs().maxCoeff() / node.norm();
  }
  return mesh;
}

std::vector<NodeContact> floor_contacts(const ElasticBody& body) {
  std::vector<NodeContact> contacts;
  for (int i = 0; i < body.node_count(); ++i)
    if (body.position_m[i].z() < 0.1) contacts.push_back({.node = i, .gap_m = body.position_m[i].z(), .friction = 0.6});
  return contacts;
}

Picture beam_and_ball() {
  ElasticBody ball = must(make_elastic_body(ball_mesh(6, 0.3), {1e5, 0.3, 1000.0}));
  for (auto& x : ball.position_m) x += Eigen::Vector3d(0.6, -0.5, 0.75);
  ElasticBody beam = must(make_elastic_body(lattice_mesh({21, 1, 1}, {2.1, 0.1, 0.1}), {1e6, 0.25, 1000.0}));
  const Eigen::Matrix3d tipped = Eigen::AngleAxisd(-0.45, Eigen::Vector3d::UnitY()).toRotationMatrix();
  for (auto& x : beam.position_m) x = tipped * x + Eigen::Vector3d(-1.1, 0.2, 0.15);
  Picture picture{{"Figure 1: a deformable beam and a solid sphere in an interactive simulation",
                   {},
                   {},
                   3,
                   {0.35, 1.0, -0.35},
                   {0.0, 0.0, 1.0}},
                  {"1", "elastic-1-beam-and-sphere.svg",
                   "a snapshot of an interactive simulation of a deformable beam and a solid sphere", ""}};
  const StepSettings settings;
  std::vector<double> times_ms;
  for (int k = 0; k <= 80; ++k) {
    if (k == 0 || k == 26 || k == 38) {
      Panel panel{fmt::format("t = {:.2f} s", k * settings.step_s), surface_of(ball, orange), {}, {}};
      const auto facets = surface_of(beam, blue);
      panel.facets.insert(panel.facets.end(), facets.begin(), facets.end());
      for (int n = -4; n <= 4; ++n) {
        panel.behind.push_back({{0.3 * n, -0.9, 0.0}, {0.3 * n, 0.6, 0.0}, {200, 200, 200}});
        if (n >= -3 && n <= 2) panel.behind.push_back({{-1.2, 0.3 * n, 0.0}, {1.2, 0.3 * n, 0.0}, {200, 200, 200}});
      }
      picture.page.panels.push_back(std::move(panel));
    }
    const double start = thread_time_s();
    for (ElasticBody* body : {&ball, &beam}) {
      auto contacts = floor_contacts(*body);
      step_elastic(*body, settings, contacts);
    }
    times_ms.push_back(1e3 * (thread_time_s() - start));
  }
  std::ranges::sort(times_ms);
  picture.figure.here =
      fmt::format("a beam of {} tetrahedra and a sphere of {} fall on a floor: {:.2f} ms for a step of 15 ms",
                  beam.elements.size(), ball.elements.size(), times_ms[times_ms.size() / 2]);
  return picture;
}

/// Figure 2 --------------------------------------------------------------------------------------------------------

Panel cube_panel(swinging_cube::Stepper stepper, std::string caption, const std::vector<double>& times_s) {
  Panel panel{std::move(caption), {}, {}, {}};
  swinging_cube::Cube cube = swinging_cube::make_cube();
  constexpr double dt = 0.05;
  int step = 0;
  for (std::size_t n = 0; n < times_s.size(); ++n) {
    for (; step < std::lround(times_s[n] / dt); ++step) swinging_cube::step(cube, stepper, dt, 2.0);
    const auto grey = static_cast<std::uint8_t>(190 - 190 * n / 3);
    const auto corner = [&](int c) { return Eigen::Vector3d(cube.x.segment<3>(3 * c)); };
    for (const auto& [a, b] : cube.edges) panel.lines.push_back({corner(a), corner(b), {grey, grey, grey}});
    const Eigen::Vector3d tip = corner(swinging_cube::opposite_corner);
    panel.lines.push_back({tip, tip + Eigen::Vector3d(0.0, 0.0, 0.12), red});
  }
  return panel;
}

/// The first step at which an edge is longer than twice its rest, at Δt = 0.05 s.
int step_of_bursting(swinging_cube::Stepper stepper) {
  swinging_cube::Cube cube = swinging_cube::make_cube();
  for (int k = 1; k <= 60; ++k) {
    swinging_cube::step(cube, stepper, 0.05, 2.0);
    for (std::size_t e = 0; e < cube.edges.size(); ++e) {
      const auto [a, b] = cube.edges[e];
      const double length = (cube.x.segment<3>(3 * a) - cube.x.segment<3>(3 * b)).norm();
      if (!(length < 2.0 * cube.length[e])) return k;
    }
  }
  return 0;
}

Picture swinging_cubes() {
  using swinging_cube::Stepper;
  const std::vector<double> times_s{0.0, 0.2, 0.4, 0.8};
  Picture picture{
      {"Figure 2: an elastic cube anchored at one node falls under gravity",
       {},
       {},
       3,
       {0.8, 1.0, -0.25},
       {0.0, 0.0, 1.0}},
      {"2", "elastic-2-three-steppers.svg",
       "at 0.05 s symplectic Euler explodes almost instantly; with implicit Euler the cube falls slower than "
       "with the regularised stepper",
       ""}};
  picture.page.panels = {cube_panel(Stepper::symplectic_euler, "a) symplectic Euler: the start only", {0.0}),
                         cube_panel(Stepper::implicit_euler, "b) linearly implicit Euler", times_s),
                         cube_panel(Stepper::regularised, "c) regularised", times_s)};
  picture.page.lines = {
      "At 0, 0.2, 0.4 and 0.8 s, from light to dark; steps of 0.05 s. A red stroke marks the corner opposite to the "
      "held one."};
  const auto fallen_m = [](Stepper stepper) {
    const auto heights = swinging_cube::heights(stepper, 0.05, 0.4, 2.0);
    return heights.front() - heights.back();
  };
  picture.figure.here = fmt::format(
      "symplectic Euler has an edge of twice its length at step {}; after 0.4 s the corner has fallen by {:.2f} m with "
      "implicit Euler and by {:.2f} m regularised",
      step_of_bursting(Stepper::symplectic_euler), fallen_m(Stepper::implicit_euler), fallen_m(Stepper::regularised));
  return picture;
}

/// Figures 4 to 7 --------------------------------------------------------------------------------------------------

constexpr ElasticMaterial soft{1e6, 0.25, 1000.0};

/// Twists a beam of 105 linear tetrahedra by three radians, where strain is small.
const double moment_nm =
    3.0 / beam::static_twist_ratio(1) * lame_constants(soft).mu_pa * beam::torsion_constant_m4 / beam::length_m;

Picture twisted_beam() {
  ElasticBody body = beam::make(1, soft);
  const double before = volume_m3(body);
  beam::settle_twisted(body, moment_nm);
  return {
      {"Figure 4: a beam twisted by moments on its short ends",
       {},
       {{"Green's strain", surface_of(body, orange), {}, {}}}},
      {"4", "elastic-4-twisted.svg", "88 nodes, 105 tetrahedra: large deformations without kinks or collapsing regions",
       fmt::format("twisted by {:.2f} rad; volume {:+.1f} %, the flattest tetrahedron keeps {:.2f} of its own",
                   beam::twist_rad(body), 100 * (volume_m3(body) / before - 1), least_determinant_of(body))}};
}

Picture twisted_beam_of_small_strain() {
  ElasticBody body = beam::make(1, soft);
  const double before = volume_m3(body);
  beam::twist_ends(body, moment_nm);
  SEPTET_CHECK(move_by_small_strain(body), "the beam has no stiffness");
  return {{"Figure 5: the same moments, without the strain's square",
           {},
           {{"Linear strain", surface_of(body, orange), {}, {}}}},
          {"5", "elastic-5-linear-strain.svg", "the result is an unrealistic volume deformation",
           fmt::format("the same moments; volume {:+.0f} %", 100 * (volume_m3(body) / before - 1))}};
}

struct Supported {
  Panel panel;
  double sag_m = 0.0, theory_m = 0.0;
};

/// A beam of 1.4 × 1.4 × 21 m lies on edges at its ends; the paper does not tell its measures.
Supported supported_beam(double mass_kg, const std::string& caption) {
  constexpr double side = 1.4, length = 21.0, young_pa = 1e9;
  ElasticBody body = must(make_elastic_body(lattice_mesh({2, 2, 30}, {side, side, length}),
                                            {young_pa, 0.25, mass_kg / (side * side * length)}));
  StepSettings settings;
  settings.gravity_mps2 = {-9.81, 0.0, 0.0};
  settings.damping_ratio = 0.5;
  std::vector<int> edges;
  for (int i = 0; i < body.node_count(); ++i) {
    const auto& x = body.rest_position_m[i];
    if (x.x() < 1e-9 && (x.z() < 1e-9 || x.z() > length - 1e-9)) edges.push_back(i);
  }
  for (int k = 0; k < 3000; ++k) {
    std::vector<NodeContact> contacts;
    for (const int i : edges)
      contacts.push_back({.node = i, .normal = {1.0, 0.0, 0.0}, .gap_m = body.position_m[i].x()});
    step_elastic(body, settings, contacts);
    for (auto& v : body.velocity_mps) v *= 0.97;
  }
  Supported result{{caption, surface_of(body, orange), {}, {}}};
  double lowest = 0.0;
  for (const auto& x : body.position_m) lowest = std::min(lowest, x.x());
  result.sag_m = -lowest;
  const double load_npm = mass_kg * 9.81 / length, bending_m4 = std::pow(side, 4) / 12.0;
  result.theory_m = 5.0 * load_npm * std::pow(length, 4) / (384.0 * young_pa * bending_m4);
  for (const int i : edges) {
    const Eigen::Vector3d& x = body.position_m[i];
    if (body.rest_position_m[i].y() > 1e-9) continue;
    for (const double aside : {-0.5, 0.5})
      result.panel.lines.push_back({x, x + Eigen::Vector3d(-0.9, 0.0, aside), black});
    result.panel.lines.push_back({x + Eigen::Vector3d(-0.9, 0.0, -0.5), x + Eigen::Vector3d(-0.9, 0.0, 0.5), black});
  }
  return result;
}

Picture supported_beam_picture(const char* number, double mass_t) {
  Supported beam = supported_beam(1e3 * mass_t, "1.4 × 1.4 × 21 m, 600 tetrahedra");
  return {
      {fmt::format("Figure {}: a supported beam of {:.0f} t, Y = 1 GPa, σ = 0.25", number, mass_t),
       {},
       {std::move(beam.panel)}},
      {number, fmt::format("elastic-{}-supported-{:.0f}t.svg", number, mass_t),
       fmt::format("a supported beam of {:.0f} t, Y = 1.0 GPa, σ = 0.25, bends under gravity", mass_t),
       fmt::format("sags by {:.2f} m of 21 m (a slender beam of small strain: {:.2f} m)", beam.sag_m, beam.theory_m)}};
}

/// Of figures 8 and 9 ----------------------------------------------------------------------------------------------

Picture five_geometries() {
  Picture picture{{"Figures 8 and 9: five slightly varying geometries", {}, {}},
                  {"8, 9", "elastic-8-9-geometries.svg",
                   "a beam of 88 nodes and 105 tetrahedra in five slightly varying geometries", ""}};
  for (const beam::Geometry& geometry : beam::five_geometries()) {
    const ElasticBody body = must(make_elastic_body(geometry.mesh, {}));
    picture.page.panels.push_back({geometry.name, surface_of(body, blue), {}, {}});
    picture.figure.here += fmt::format(
        "{}{}", picture.figure.here.empty() ? "five of 88 nodes and 105 tetrahedra: " : "; ", geometry.name);
  }
  return picture;
}

}  // namespace

Expected<ElasticFigures> draw_elastic_pictures(const std::filesystem::path& folder) {
  ElasticFigures figures;
  for (const Picture& picture :
       {beam_and_ball(), swinging_cubes(), twisted_beam(), twisted_beam_of_small_strain(),
        supported_beam_picture("6", 100.0), supported_beam_picture("7", 900.0), five_geometries()}) {
    PicturePage page = picture.page;
    page.lines.insert(page.lines.begin(),
                      {"Paper: " + picture.figure.published + ".", "Here: " + picture.figure.here + "."});
    if (const auto written = document::write_text_file(folder / picture.figure.file, to_svg(page)); !written)
      return tl::unexpected(written.error());
    figures.push_back(picture.figure);
  }
  return figures;
}

}  // namespace septet::figures
