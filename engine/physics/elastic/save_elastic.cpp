#include "engine/physics/elastic/save_elastic.hpp"

#include <cmath>

#include "engine/physics/elastic/tetrahedral_mesh.hpp"

namespace septet::elastic {

// Left out are the positions in the equations.
SEPTET_MEMBER_GROUPS(Element, hashed(nodes, rest_inverse, rest_volume_m3), left_out(slots))
// Left out are what is made of a part's recipe, and the cells.
SEPTET_MEMBER_GROUPS(Shell, left_out(across, height_m, thickness_m, yield_npm), hashed(natural), left_out(cells))
// Left out are the material and data derived from the elements; the factor at rest is made again when it is needed, and
// the stress that keeps the volume is of incompressible solids, which debris is not made of.
// Kept are the body's construction, and results of hashed members.
SEPTET_MEMBER_GROUPS(ElasticBody, hashed(position_m, velocity_mps),
                     kept(force_n, fixed, contact_impulse_ns, step_stress_pa), left_out(volume_stress_pa, material),
                     kept(rest_position_m, mass_kg, elements, body_node_of_mesh_node, shell),
                     left_out(pattern, factor_structure), kept(rotation), left_out(rest_factor, workspace))

namespace {

/// Bound far beyond every number of a body of debris, in SI units except for stresses and stiffness.
constexpr double most = 1e7;

template <class Matrix>
bool is_bounded(const std::vector<Matrix>& matrices) {
  for (const Matrix& matrix : matrices)
    if (!(matrix.cwiseAbs().maxCoeff() <= most)) return false;
  return true;
}

void require_whole(const ElasticBody& body, std::size_t most_elements, StateReader& reader) {
  constexpr auto wrong = "an elastic body in it does not fit together";
  const std::size_t nodes = body.position_m.size(), elements = body.elements.size();
  reader.require(elements >= 1 && elements <= most_elements && nodes <= 4 * elements, wrong);
  for (const auto* vectors : {&body.velocity_mps, &body.force_n, &body.rest_position_m})
    reader.require(vectors->size() == nodes, wrong);
  for (const auto* numbers : {&body.contact_impulse_ns, &body.mass_kg}) reader.require(numbers->size() == nodes, wrong);
  reader.require(body.fixed.size() == nodes && body.rotation.size() == nodes &&
                     body.body_node_of_mesh_node.size() == nodes &&
                     (body.step_stress_pa.empty() || body.step_stress_pa.size() == elements),
                 wrong);
  reader.require(is_bounded(body.position_m) && is_bounded(body.velocity_mps) && is_bounded(body.force_n) &&
                     is_bounded(body.rest_position_m) && is_bounded(body.rotation),
                 wrong);
  for (const double mass : body.mass_kg) reader.require(mass > 1.0 / most && mass < most, wrong);
  for (const double impulse : body.contact_impulse_ns) reader.require(std::abs(impulse) < most, wrong);
  for (const Element& element : body.elements) {
    reader.require(element.rest_volume_m3 > 0.0 && element.rest_volume_m3 < most &&
                       element.rest_inverse.cwiseAbs().maxCoeff() <= most,
                   wrong);
    const Tetrahedron& t = element.nodes;
    const bool has_nodes =
        0 <= t[0] && t[0] < t[1] && t[1] < t[2] && t[2] < t[3] && static_cast<std::size_t>(t[3]) < nodes;
    // A piece that breaks is made anew from its shape at rest.
    reader.require(has_nodes && reader.ok() && !is_flat(body.rest_position_m, t), wrong);
  }
}

void require_whole(const Shell& shell, std::size_t elements, StateReader& reader) {
  constexpr auto wrong = "an elastic sheet in it does not fit together";
  const std::size_t cells = shell.thickness_m > 0.0 ? elements / tetrahedra_per_cell : 0;
  reader.require(shell.cells.size() == cells && shell.natural.size() == cells, wrong);
  for (const CellStrain& natural : shell.natural)
    for (const ShellStrain& strain : natural) reader.require(strain.cwiseAbs().maxCoeff() <= most, wrong);
}

}  // namespace

void save_body(const ElasticBody& body, StateWriter& writer) { transfer(writer, body); }

void add_to_hash(const ElasticBody& body, StateHash& hash) {
  hash_members(hash, body);
  if (!body.shell.empty()) hash_members(hash, body.shell);
}

void restore_body(StateReader& reader, std::size_t most_elements, ElasticBody& body) {
  transfer(reader, body);
  require_whole(body, most_elements, reader);
  if (!reader.ok()) return;
  derive_structure(body);
  require_whole(body.shell, body.elements.size(), reader);
}

}  // namespace septet::elastic
