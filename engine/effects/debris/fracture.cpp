#include "engine/effects/debris/fracture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "engine/core/check.hpp"
#include "engine/effects/debris/inner_face.hpp"
#include "engine/effects/debris/laminate.hpp"
#include "engine/effects/debris/sheet_crack.hpp"
#include "engine/effects/debris/sheet_flow.hpp"
#include "engine/effects/debris/sheet_stress.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/element.hpp"

namespace septet::debris {
namespace {

using elastic::Element;

/// Sets with a representative (path halving; the smaller index represents).
struct DisjointSets {
  std::vector<int> parent;
  explicit DisjointSets(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }
  int find(int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
};

bool cracks_slowly(const Piece& piece) { return part_recipe(piece.part).material == Material::ice; }

/// Share of its strength below which nothing happens to a piece.
double least_overload(const Piece& piece) { return cracks_slowly(piece) ? least_cracking_share : 1.0; }

/// Ratio of a stress to the strength of a face with this normal; below one it holds. Values below `least` may be
/// returned as 0.
double tensile_overload(const Eigen::Matrix3d& stress, double strength_pa, const Eigen::Vector3d& normal,
                        double least) {
  if (stress.norm() < least * strength_pa) return 0.0;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(stress, Eigen::EigenvaluesOnly);
  const double greatest = eigen.eigenvalues()[2];
  const bool across = normal.dot(stress * normal) > 0.5 * greatest;  // Within 45° of the pull.
  return across ? greatest / strength_pa : 0.0;
}

double splitting_overload(const Eigen::Matrix3d& stress, double strength_pa, const Eigen::Vector3d& normal,
                          double least) {
  if (stress.norm() < least * strength_pa) return 0.0;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(stress);
  const double along = normal.dot(eigen.eigenvectors().col(0));
  return along * along < 0.5 ? -eigen.eigenvalues()[0] / strength_pa : 0.0;
}

/// True where there is energy for cracks.
bool strikes(const Blow& blow) { return blow.lost_j + blow.pressed_j > 0.0; }

struct Overload {
  double lasting = 0.0;  ///< Overload by the shape and by the step's own stress.
  double blow = 0.0;     ///< Overload by the impact's peak.
};

/// The step's stress at each node, the mean of the elements around it by their volume: within one cube its tetrahedra
/// differ by a factor of three, and only their mean is the stress of the cube.
std::vector<Eigen::Matrix3d> stress_at_nodes_pa(const elastic::ElasticBody& body) {
  std::vector<Eigen::Matrix3d> stress(static_cast<std::size_t>(body.node_count()), Eigen::Matrix3d::Zero());
  std::vector<double> volume(stress.size(), 0.0);
  for (std::size_t e = 0; e < body.step_stress_pa.size(); ++e)
    for (const int node : body.elements[e].nodes) {
      const auto n = static_cast<std::size_t>(node);
      stress[n] += body.elements[e].rest_volume_m3 * body.step_stress_pa[e];
      volume[n] += body.elements[e].rest_volume_m3;
    }
  for (std::size_t n = 0; n < stress.size(); ++n)
    if (volume[n] > 0.0) stress[n] /= volume[n];
  return stress;
}

/// Stress jumps from one linear tetrahedron to the next: the greatest of a face's two and of the mean around it
/// decides.
Overload overload_of(const Piece& piece, const InnerFace& face, const Blow& blow,
                     const std::vector<Eigen::Matrix3d>& at_nodes_pa, const Eigen::Vector3d& normal) {
  Overload most;
  const auto& m = piece.material;
  const double least = least_overload(piece);
  // Pressure splits a brittle material where it bulges by more than its strength allows.
  const double splitting_pa = m.yield_pa > 0.0
                                  ? m.compressive_strength_pa
                                  : std::min(m.compressive_strength_pa, m.strength_pa / m.elastic.poisson_ratio);
  const auto struck = [&](const Eigen::Matrix3d& peak) {
    most.blow = std::max({most.blow, tensile_overload(peak, m.strength_pa, normal, least),
                          splitting_overload(peak, splitting_pa, normal, least)});
  };
  for (const int element : {face.first, face.second}) {
    most.lasting = std::max(
        most.lasting, tensile_overload(elastic::cauchy_stress_pa(piece.body, element), m.strength_pa, normal, least));
    if (piece.body.step_stress_pa.empty()) continue;
    const Eigen::Matrix3d& carried = piece.body.step_stress_pa[element];
    most.lasting = std::max(most.lasting, tensile_overload(carried, m.strength_pa, normal, least));
    if (strikes(blow)) struck(blow.stress_factor * carried);
  }
  if (strikes(blow)) {
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    for (const int node : face.nodes) mean += at_nodes_pa[static_cast<std::size_t>(node)] / 3.0;
    struck(blow.stress_factor * mean);
  }
  return most;
}

/// Outcome for each inner face.
struct FaceFates {
  std::vector<bool> opened;
  std::vector<double> reach;  ///< Reach of its crack.
  double left_j = 0.0;        ///< Energy lost in the impact that the cracks leave.
  double cracked_j = 0.0;     ///< In the surfaces that have parted.
  double paid_j = 0.0;        ///< By the impact.
};

/// Reach of each face's earlier crack.
std::vector<double> reach_before(const Piece& piece, const std::vector<InnerFace>& faces) {
  std::vector<double> reach(faces.size(), 0.0);
  if (piece.cracks.empty()) return reach;
  std::map<std::pair<int, int>, double> of;
  for (const FaceCrack& crack : piece.cracks) of[{crack.first, crack.second}] = crack.reach;
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (const auto found = of.find({faces[k].first, faces[k].second}); found != of.end()) reach[k] = found->second;
  return reach;
}

FaceFates fates_of(const Piece& piece, const std::vector<InnerFace>& faces, const std::optional<SheetStress>& sheet,
                   const Blow& blow, double step_s) {
  const auto& x = piece.body.position_m;
  FaceFates fates{std::vector<bool>(faces.size(), false), reach_before(piece, faces), 0.0};
  const auto before = fates.reach;
  std::vector<double> area_m2(faces.size(), 0.0);
  const double energy_jpm2 = piece.material.fracture_energy_jpm2;
  struct Candidate {
    double overload, cost_j;
    std::size_t face;
  };
  std::vector<Candidate> candidates;
  const bool slowly = cracks_slowly(piece);
  std::vector<SheetLoad> loads(sheet ? faces.size() : 0);
  // Only an impact is judged by the mean around a face, and most steps have none.
  const auto at_nodes_pa = strikes(blow) ? stress_at_nodes_pa(piece.body) : std::vector<Eigen::Matrix3d>{};
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const InnerFace& face = faces[k];
    if (piece.splinter[face.first] == piece.splinter[face.second] || fates.reach[k] >= cracked_through) continue;
    const Eigen::Vector3d normal = (x[face.nodes[1]] - x[face.nodes[0]]).cross(x[face.nodes[2]] - x[face.nodes[0]]);
    const double whole = 1.0 - fates.reach[k];
    area_m2[k] = 0.5 * normal.norm();
    Overload overload = overload_of(piece, face, blow, at_nodes_pa, normal.normalized());
    overload.lasting /= whole, overload.blow /= whole;
    fates.opened[k] = overload.lasting >= 1.0;
    if (sheet) {
      loads[k] = sheet_load(*sheet, piece, face, least_running_share * whole);
      loads[k].overload /= whole, loads[k].pull /= whole;
      overload.lasting = std::max(overload.lasting, loads[k].overload);
    }
    if (fates.opened[k]) continue;
    if (overload.blow >= 1.0) candidates.push_back({overload.blow, whole * area_m2[k] * energy_jpm2, k});
    if (slowly && overload.lasting >= least_cracking_share) {
      fates.reach[k] += step_s / crack_time_s * std::pow(overload.lasting, crack_exponent);
      fates.opened[k] = fates.reach[k] >= 1.0;
    }
  }
  for (const std::size_t k : run_through(piece, faces, loads)) fates.opened[k] = true;
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::overload);
  fates.left_j = blow.lost_j + blow.pressed_j;
  for (const Candidate& c : candidates) {
    if (c.cost_j > fates.left_j) {
      if (!slowly || fates.opened[c.face]) break;
      fates.reach[c.face] += (1.0 - fates.reach[c.face]) * fates.left_j / c.cost_j;
      fates.paid_j += fates.left_j;
      fates.left_j = 0.0;
      break;
    }
    fates.left_j -= c.cost_j;
    fates.paid_j += c.cost_j;
    fates.opened[c.face] = true;
  }
  fates.left_j = std::min(fates.left_j, blow.lost_j);
  for (std::size_t k = 0; k < faces.size(); ++k)
    fates.cracked_j += energy_jpm2 * area_m2[k] * ((fates.opened[k] ? 1.0 : fates.reach[k]) - before[k]);
  return fates;
}

/// The glass parts, and the film holds.
void hold_together(FaceFates& fates) {
  for (std::size_t k = 0; k < fates.opened.size(); ++k)
    if (fates.opened[k]) fates.opened[k] = false, fates.reach[k] = cracked_through;
}

/// Once it begins anywhere, everywhere. The tension that tempering left within the glass pays for the cracks.
void crumble(const Piece& piece, const std::vector<InnerFace>& faces, FaceFates& fates) {
  if (std::ranges::find(fates.opened, true) == fates.opened.end()) return;
  for (std::size_t k = 0; k < faces.size(); ++k)
    fates.opened[k] = piece.splinter[faces[k].first] != piece.splinter[faces[k].second];
  fates.left_j += fates.paid_j;
  fates.cracked_j = fates.paid_j = 0.0;
}

std::vector<FaceCrack> cracks_of(const std::vector<InnerFace>& faces, const FaceFates& fates) {
  std::vector<FaceCrack> cracks;
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (!fates.opened[k] && fates.reach[k] > 0.0) cracks.push_back({faces[k].first, faces[k].second, fates.reach[k]});
  std::ranges::sort(cracks, {}, [](const FaceCrack& crack) { return std::pair{crack.first, crack.second}; });
  return cracks;
}

/// The plastic part of the rest shape: edges(rest) · rest_inverse = Fp⁻¹.
Eigen::Matrix3d inverse_flow(const elastic::ElasticBody& body, const Element& e) {
  Eigen::Matrix3d edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = body.rest_position_m[e.nodes[a + 1]] - body.rest_position_m[e.nodes[0]];
  return edges * e.rest_inverse;
}

/// Work of the mean stress as the elastic strain falls from `first` to `last`.
double mean_stress_work_jpm3(const Eigen::Matrix3d& first, const Eigen::Matrix3d& last,
                             const elastic::LameConstants& lame) {
  return elastic::second_piola_stress(0.5 * (first + last), lame).cwiseProduct(first - last).sum();
}

/// Cuts out the elements of one island as a separate piece.
Piece cut_out(const Piece& from, const std::vector<int>& elements, const std::vector<FaceCrack>& cracks,
              const std::vector<std::array<int, 4>>& corner_group) {
  const auto& old = from.body;
  elastic::TetrahedralMesh mesh;
  std::map<int, int> node_of_group;
  std::vector<int> source;
  for (const int e : elements) {
    elastic::Tetrahedron t;
    for (std::size_t a = 0; a < 4; ++a) {
      const auto [place, fresh] = node_of_group.try_emplace(corner_group[e][a], static_cast<int>(mesh.nodes_m.size()));
      if (fresh) {
        source.push_back(old.elements[e].nodes[a]);
        mesh.nodes_m.push_back(old.rest_position_m[source.back()]);
      }
      t[a] = place->second;
    }
    mesh.tetrahedra.push_back(t);
  }
  auto made = elastic::make_elastic_body(mesh, old.material);
  SEPTET_CHECK(made.has_value(), "a broken piece is no body: {}", made.error().what);
  Piece piece;
  piece.part = from.part;
  piece.origin = from.origin;
  piece.height_m = from.height_m;
  piece.melted_m = from.melted_m;
  piece.material = from.material;
  piece.body = std::move(*made);
  for (std::size_t i = 0; i < source.size(); ++i) {
    const int node = piece.body.body_node_of_mesh_node[i];
    piece.body.position_m[node] = old.position_m[source[i]];
    piece.body.velocity_mps[node] = old.velocity_mps[source[i]];
    piece.body.fixed[node] = old.fixed[source[i]];
  }
  for (std::size_t k = 0; k < elements.size(); ++k) {
    Element& e = piece.body.elements[k];
    e.rest_inverse = e.rest_inverse * inverse_flow(old, old.elements[elements[k]]);
    piece.splinter.push_back(from.splinter[elements[k]]);
    piece.plastic_strain.push_back(from.plastic_strain[elements[k]]);
  }
  if (!old.shell.empty()) {
    elastic::Shell& shell = piece.body.shell = shell_of(part_recipe(from.part));
    for (std::size_t k = 0; k < elements.size(); k += elastic::tetrahedra_per_cell)
      shell.natural.push_back(old.shell.natural[static_cast<std::size_t>(elements[k] / elastic::tetrahedra_per_cell)]);
    elastic::derive_structure(piece.body);
    SEPTET_CHECK(!shell.empty(), "a broken sheet of {} elements is none", elements.size());
  }
  // Elements ascend, so that those of a crack do as well.
  const auto now = [&](int element) {
    const auto found = std::ranges::lower_bound(elements, element);
    return found != elements.end() && *found == element ? static_cast<int>(found - elements.begin()) : -1;
  };
  for (const FaceCrack& crack : cracks)
    if (now(crack.first) >= 0 && now(crack.second) >= 0)
      piece.cracks.push_back({now(crack.first), now(crack.second), crack.reach});
  std::vector<elastic::Tetrahedron> tetrahedra;
  for (const auto& e : piece.body.elements) tetrahedra.push_back(e.nodes);
  piece.surface = elastic::surface_triangles(piece.body.rest_position_m, tetrahedra);
  return piece;
}

}  // namespace

double strain_paid_by(double energy_j, double flow_stress_pa, double mu_pa, double volume_m3) {
  const double energy_jpm3 = energy_j / volume_m3;
  return 2.0 * energy_jpm3 / (flow_stress_pa + std::sqrt(flow_stress_pa * flow_stress_pa + 4.0 * mu_pa * energy_jpm3));
}

FractureResult fracture(const Piece& piece, const Blow& blow, double step_s) {
  FractureResult result;
  result.cracks = piece.cracks;
  const auto& body = piece.body;
  const double strength = least_overload(piece) * piece.material.strength_pa;
  const auto strained = [&](int e) {
    return elastic::cauchy_stress_pa(body, e).norm() >= strength ||
           (!body.step_stress_pa.empty() && blow.stress_factor * body.step_stress_pa[e].norm() >= strength);
  };
  const auto sheet = sheet_stress(piece);
  bool any_strained = sheet && greatest_surface_stress_pa(*sheet) >= strength;
  for (int e = 0; e < static_cast<int>(body.elements.size()); ++e) any_strained = any_strained || strained(e);
  if (!any_strained) return result;
  const auto faces = inner_faces(body);
  const std::size_t count = body.elements.size();
  DisjointSets islands(count), corners(4 * count);
  FaceFates fates = fates_of(piece, faces, sheet, blow, step_s);
  const Breakage breakage = part_recipe(piece.part).breakage;
  if (breakage == Breakage::holds) hold_together(fates);
  if (breakage == Breakage::crumbles) crumble(piece, faces, fates);
  result.cracks = cracks_of(faces, fates);
  result.cracked_j = fates.cracked_j;
  result.paid_j = fates.paid_j;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const InnerFace& face = faces[k];
    if (fates.opened[k]) {
      ++result.opened_faces;
      continue;
    }
    islands.join(face.first, face.second);
    for (const int node : face.nodes) {
      const auto place = [&](int e) {
        const auto& t = body.elements[e].nodes;
        return 4 * e + static_cast<int>(std::ranges::find(t, node) - t.begin());
      };
      corners.join(place(face.first), place(face.second));
    }
  }
  if (result.opened_faces == 0) return result;
  std::vector<std::array<int, 4>> group(count);
  std::map<int, std::vector<int>> members;
  for (int e = 0; e < static_cast<int>(count); ++e) {
    for (int a = 0; a < 4; ++a) group[e][a] = corners.find(4 * e + a);
    members[islands.find(e)].push_back(e);
  }
  for (const auto& [representative, elements] : members)
    result.pieces.push_back(cut_out(piece, elements, result.cracks, group));
  result.scattered_j = scatter(result.pieces, blow.normal, scatter_share * fates.left_j);
  return result;
}

Flow flow(Piece& piece, const Blow& blow) {
  constexpr double most_plastic_strain = 0.5;
  const double yield = piece.material.yield_pa;
  Flow result;
  if (yield <= 0.0) return result;
  if (!piece.body.shell.empty()) return flow_sheet(piece, blow);
  const auto lame = elastic::lame_constants(piece.body.material);
  std::vector<std::size_t> struck;
  double struck_volume_m3 = 0.0;
  for (std::size_t k = 0; k < piece.body.elements.size(); ++k) {
    Element& e = piece.body.elements[k];
    const Eigen::Matrix3d f = elastic::deformation_gradient(e, piece.body.position_m);
    if (f.determinant() <= 0.0 || piece.plastic_strain[k] >= most_plastic_strain) continue;
    if (blow.lost_j > 0.0 && !piece.body.step_stress_pa.empty() &&
        std::sqrt(1.5) * blow.stress_factor * elastic::without_pressure(piece.body.step_stress_pa[k]).norm() > yield) {
      struck.push_back(k);
      struck_volume_m3 += e.rest_volume_m3;
    }
    const Eigen::Matrix3d strain = elastic::green_strain(f), deviator = elastic::without_pressure(strain);
    const double von_mises = 2.0 * lame.mu_pa * std::sqrt(1.5) * deviator.norm();
    if (von_mises <= yield) continue;
    const double share = 1.0 - yield / von_mises;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(f.transpose() * f);
    const Eigen::Vector3d stretch = eigen.eigenvalues().cwiseMax(1e-6).cwiseSqrt();
    const double volume_root = std::cbrt(stretch.prod());
    const Eigen::Vector3d undone = (stretch / volume_root).array().pow(-share);
    e.rest_inverse = e.rest_inverse * eigen.eigenvectors() * undone.asDiagonal() * eigen.eigenvectors().transpose();
    piece.plastic_strain[k] += share * deviator.norm();
    ++result.elements;
    const Eigen::Matrix3d left = elastic::green_strain(elastic::deformation_gradient(e, piece.body.position_m));
    result.plastic_j += e.rest_volume_m3 * mean_stress_work_jpm3(strain, left, lame);
  }
  const double flow_stress_pa = std::sqrt(2.0 / 3.0) * yield;  // At yield, the norm of the deviator.
  const double strain =
      struck.empty()
          ? 0.0
          : std::min(most_strain_of_blow, strain_paid_by(blow.lost_j, flow_stress_pa, lame.mu_pa, struck_volume_m3));
  for (const std::size_t k : struck) {
    Element& e = piece.body.elements[k];
    const Eigen::Matrix3d f = elastic::deformation_gradient(e, piece.body.position_m);
    // The stress turned back to the rest frame.
    const Eigen::Matrix3d at_rest = f.transpose() * elastic::without_pressure(piece.body.step_stress_pa[k]) * f;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(elastic::without_pressure(at_rest));
    const Eigen::Vector3d way = eigen.eigenvalues().normalized();
    const Eigen::Vector3d undone = (-strain * way).array().exp();
    e.rest_inverse = e.rest_inverse * eigen.eigenvectors() * undone.asDiagonal() * eigen.eigenvectors().transpose();
    piece.plastic_strain[k] += strain;
    ++result.elements;
    const Eigen::Matrix3d first = elastic::green_strain(f);
    const Eigen::Matrix3d last = elastic::green_strain(elastic::deformation_gradient(e, piece.body.position_m));
    const double work_j = e.rest_volume_m3 * flow_stress_pa * strain;
    result.plastic_j += work_j;
    result.paid_j += work_j + e.rest_volume_m3 * mean_stress_work_jpm3(last, first, lame);
  }
  if (result.elements > 0) elastic::invalidate_rest_factor(piece.body);
  return result;
}

}  // namespace septet::debris
