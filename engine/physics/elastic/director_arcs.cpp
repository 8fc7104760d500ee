#include "engine/physics/elastic/director_arcs.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace septet::elastic {
namespace {

void turn_pair(const ElasticBody& body, std::size_t low, std::size_t high, std::vector<Eigen::Vector3d>& way_m,
               std::vector<Eigen::Vector3d>& velocity_mps) {
  const double high_share = body.mass_kg[high] / (body.mass_kg[low] + body.mass_kg[high]);
  const Eigen::Vector3d director_m = body.position_m[high] - body.position_m[low];
  const Eigen::Vector3d straight_m = way_m[high] - way_m[low];
  const double squared_m2 = director_m.squaredNorm();
  if (!(squared_m2 > 0.0)) return;
  const Eigen::Vector3d turn_rad = director_m.cross(straight_m) / squared_m2;
  const double angle_rad = turn_rad.norm();
  if (!(angle_rad > 0.0)) return;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle_rad, turn_rad / angle_rad).toRotationMatrix();
  const auto spread = [&](std::vector<Eigen::Vector3d>& of_nodes, const Eigen::Vector3d& change) {
    of_nodes[high] += (1.0 - high_share) * change;
    of_nodes[low] -= high_share * change;
  };
  const double longer = 1.0 + director_m.dot(straight_m) / squared_m2;
  spread(way_m, turn * (longer * director_m) - director_m - straight_m);
  const Eigen::Vector3d apart_mps = velocity_mps[high] - velocity_mps[low];
  spread(velocity_mps, turn * apart_mps - apart_mps);
}

}  // namespace

void turn_directors(const ElasticBody& body, std::vector<Eigen::Vector3d>& way_m,
                    std::vector<Eigen::Vector3d>& velocity_mps) {
  if (body.shell.empty()) return;
  std::vector<std::uint8_t> done = body.fixed;
  for (const ShellCell& cell : body.shell.cells)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto low = static_cast<std::size_t>(cell.nodes[k]), high = static_cast<std::size_t>(cell.nodes[k + 4]);
      if (done[low] != 0 || done[high] != 0) continue;
      done[low] = done[high] = 1;
      turn_pair(body, low, high, way_m, velocity_mps);
    }
}

}  // namespace septet::elastic
