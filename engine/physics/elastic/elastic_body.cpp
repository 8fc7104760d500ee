#include "engine/physics/elastic/elastic_body.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>

namespace septet::elastic {
namespace {

Expected<void> validate(const ElasticMaterial& m) {
  if (!(m.young_modulus_pa > 0) || !std::isfinite(m.young_modulus_pa))
    return failure(fmt::format("Young's modulus is {} Pa", m.young_modulus_pa), "elastic material",
                   "give a positive number");
  if (!(m.poisson_ratio >= 0 && m.poisson_ratio <= 0.5))
    return failure(fmt::format("Poisson's ratio is {}", m.poisson_ratio), "elastic material",
                   "give a number from 0 to 0.5, which is incompressible");
  if (!(m.density_kgpm3 > 0) || !std::isfinite(m.density_kgpm3))
    return failure(fmt::format("density is {} kg/m³", m.density_kgpm3), "elastic material", "give a positive number");
  return {};
}

std::vector<std::pair<int, int>> edges_of(const std::vector<Tetrahedron>& tetrahedra,
                                          const std::vector<ShellCell>& cells = {}) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(6 * tetrahedra.size() + 28 * cells.size());
  const auto add_pairs = [&](const auto& nodes) {
    for (std::size_t a = 1; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        edges.emplace_back(std::max(nodes[a], nodes[b]), std::min(nodes[a], nodes[b]));
  };
  for (const auto& t : tetrahedra) add_pairs(t);
  for (const auto& cell : cells) add_pairs(cell.nodes);
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

Expected<ElasticBody> make_elastic_body(const TetrahedralMesh& mesh, const ElasticMaterial& material) {
  if (const auto valid = validate(mesh); !valid) return tl::unexpected(valid.error());
  if (const auto valid = validate(material); !valid) return tl::unexpected(valid.error());
  ElasticBody body;
  body.material = material;
  const int n = static_cast<int>(mesh.nodes_m.size());
  const auto order = fill_reducing_order(n, edges_of(mesh.tetrahedra));
  body.body_node_of_mesh_node.resize(order.size());
  for (int k = 0; k < n; ++k) {
    body.body_node_of_mesh_node[order[k]] = k;
    body.rest_position_m.push_back(mesh.nodes_m[order[k]]);
  }
  body.position_m = body.rest_position_m;
  const auto size = static_cast<std::size_t>(n);
  body.velocity_mps.assign(size, Eigen::Vector3d::Zero());
  body.force_n.assign(size, Eigen::Vector3d::Zero());
  body.fixed.assign(size, 0);
  body.contact_impulse_ns.assign(size, 0.0);
  body.mass_kg.assign(size, 0.0);
  body.rotation.assign(size, Eigen::Matrix3d::Identity());

  for (auto t : mesh.tetrahedra) {
    for (int& node : t) node = body.body_node_of_mesh_node[node];
    std::ranges::sort(t);
    Element element;
    element.nodes = t;
    const auto& x = body.rest_position_m;
    Eigen::Matrix3d edges;
    edges << x[t[1]] - x[t[0]], x[t[2]] - x[t[0]], x[t[3]] - x[t[0]];
    element.rest_inverse = edges.inverse();
    element.rest_volume_m3 = std::abs(edges.determinant()) / 6.0;
    for (const int node : t) body.mass_kg[node] += element.rest_volume_m3 * material.density_kgpm3 / 4.0;
    body.elements.push_back(element);
  }
  derive_structure(body);
  return body;
}

void derive_structure(ElasticBody& body) {
  std::vector<Tetrahedron> tetrahedra;
  for (const Element& element : body.elements) tetrahedra.push_back(element.nodes);
  derive_cells(body);
  body.pattern = block_pattern(body.node_count(), edges_of(tetrahedra, body.shell.cells));
  body.factor_structure = factor_pattern(body.pattern);
  for (Element& element : body.elements) {
    std::size_t slot = 0;
    for (int a = 1; a < 4; ++a)
      for (int b = 0; b < a; ++b)
        element.slots[slot++] =
            body.pattern.slot(element.nodes[static_cast<std::size_t>(a)], element.nodes[static_cast<std::size_t>(b)]);
  }
  for (ShellCell& cell : body.shell.cells) {
    std::size_t slot = 0;
    for (std::size_t a = 1; a < cell.nodes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        cell.slots[slot++] =
            body.pattern.slot(std::max(cell.nodes[a], cell.nodes[b]), std::min(cell.nodes[a], cell.nodes[b]));
  }
  invalidate_rest_factor(body);
}

void invalidate_rest_factor(ElasticBody& body) { body.rest_factor.valid = false; }

}  // namespace septet::elastic
