#include "engine/effects/debris/sheet_crack.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "engine/effects/debris/breakable_part.hpp"

namespace septet::debris {
namespace {

Eigen::Vector3d middle_of(const Piece& piece, const InnerFace& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int node : face.nodes) sum += piece.body.rest_position_m[static_cast<std::size_t>(node)] / 3.0;
  return sum;
}

/// Middles of the splinters at rest, by their number.
std::vector<Eigen::Vector3d> splinter_middles_m(const Piece& piece) {
  const auto count = static_cast<std::size_t>(part_recipe(piece.part).splinters);
  std::vector<Eigen::Vector3d> middle(count, Eigen::Vector3d::Zero());
  std::vector<double> volume_m3(count, 0.0);
  for (std::size_t e = 0; e < piece.body.elements.size(); ++e) {
    const elastic::Element& element = piece.body.elements[e];
    const auto splinter = static_cast<std::size_t>(piece.splinter[e]);
    volume_m3[splinter] += element.rest_volume_m3;
    for (const int node : element.nodes)
      middle[splinter] += 0.25 * element.rest_volume_m3 * piece.body.rest_position_m[static_cast<std::size_t>(node)];
  }
  for (std::size_t k = 0; k < count; ++k)
    if (volume_m3[k] > 0.0) middle[k] /= volume_m3[k];
  return middle;
}

}  // namespace

SheetLoad sheet_load(const SheetStress& sheet, const Piece& piece, const InnerFace& face, double least) {
  const Eigen::Vector3d normal = normal_within(sheet, piece, face.nodes);
  const double least_across = cube_of(sheet, piece, face.first) == cube_of(sheet, piece, face.second) ? 0.41 : 0.5;
  SheetLoad load;
  for (const int element : {face.first, face.second})
    for (const int node : face.nodes)
      for (const Eigen::Matrix3d& stress : surface_stress_pa(sheet, piece, element, node)) {
        if (stress.norm() < least * piece.material.strength_pa) continue;
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
        eigen.computeDirect(stress);
        const double greatest = eigen.eigenvalues()[2], pull = greatest / piece.material.strength_pa;
        if (normal.dot(stress * normal) > least_across * greatest) load.overload = std::max(load.overload, pull);
        if (pull <= load.pull) continue;
        load.pull = pull;
        load.way = eigen.eigenvectors().col(2);
      }
  return load;
}

std::vector<std::size_t> run_through(const Piece& piece, const std::vector<InnerFace>& faces,
                                     const std::vector<SheetLoad>& loads) {
  const auto worst =
      static_cast<std::size_t>(std::ranges::max_element(loads, {}, &SheetLoad::overload) - loads.begin());
  if (worst == loads.size() || loads[worst].overload < 1.0) return {};
  const auto middles_m = splinter_middles_m(piece);
  const Eigen::Vector3d start_m = middle_of(piece, faces[worst]);
  const auto beyond = [&](int element) {
    const auto splinter = static_cast<std::size_t>(piece.splinter[static_cast<std::size_t>(element)]);
    return loads[worst].way.dot(middles_m[splinter] - start_m) > 0.0;
  };
  std::vector<std::size_t> parted;
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (k == worst || (loads[k].pull >= least_running_share && beyond(faces[k].first) != beyond(faces[k].second)))
      parted.push_back(k);
  return parted;
}

}  // namespace septet::debris
