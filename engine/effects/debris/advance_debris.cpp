#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <glm/geometric.hpp>

#include "engine/effects/debris/air_force.hpp"
#include "engine/effects/debris/blow.hpp"
#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/energy_bound.hpp"
#include "engine/effects/debris/energy_ledger.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/laminate.hpp"
#include "engine/effects/debris/melt.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/effects/debris/shards.hpp"
#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/bad_nodes.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/step.hpp"
#include "engine/physics/elastic/step_energy.hpp"

namespace septet::debris {
namespace {

/// A piece rests when its nodes' root mean square speed stays below this for a second.
constexpr double calm_speed_mps = 0.03, calm_time_s = 1.0;

void update_sleep(Piece& piece, double step_s, EnergyLedger* ledger) {
  const double speed = std::sqrt(2.0 * elastic::kinetic_energy_j(piece.body) / elastic::total_mass_kg(piece.body));
  piece.calm_s = speed < calm_speed_mps ? piece.calm_s + step_s : 0.0;
  if (piece.calm_s < calm_time_s) return;
  piece.asleep = true;
  rewrite(ledger, &EnergyLedger::settling_loss_j, piece,
          [&] { std::ranges::fill(piece.body.velocity_mps, Eigen::Vector3d::Zero()); });
}

/// Greatest speed of a node beside the piece's motion as a rigid body.
double deforming_mps(const Piece& piece) {
  const auto motion = elastic::rigid_motion(piece.body);
  double most_mps = 0.0;
  for (int i = 0; i < piece.body.node_count(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    const Eigen::Vector3d arm_m = piece.body.position_m[node] - motion.centre_m;
    const Eigen::Vector3d rigid_mps = motion.velocity_mps + motion.angular_velocity_radps.cross(arm_m);
    most_mps = std::max(most_mps, (piece.body.velocity_mps[node] - rigid_mps).norm());
  }
  return most_mps;
}

/// A step is linear in the motion; where contact would move a node by much of an element's size in one, or a sheet turns
/// so far within itself, the piece makes several.
int substeps_for(const Piece& piece, const std::vector<FoundContact>& contacts, double step_s) {
  // What turns by an angle in a step is stretched by half its square, which thin sheet bears less than a lattice does.
  const double share_of_element = piece.body.shell.empty() ? 0.15 : 0.03;
  constexpr int most = 24;
  double size = INFINITY, closing = 0.0;
  for (const auto& e : piece.body.elements) size = std::min(size, std::cbrt(6.0 * e.rest_volume_m3));
  for (const FoundContact& f : contacts) {
    const Eigen::Vector3d relative = piece.body.velocity_mps[f.contact.node] - f.contact.surface_velocity_mps;
    closing = std::max(closing, relative.norm());
  }
  if (!piece.body.shell.empty()) closing = std::max(closing, deforming_mps(piece));
  const double wanted = closing * step_s / (share_of_element * size);
  return std::clamp(static_cast<int>(std::ceil(std::min(wanted, double{most}))), 1, most);
}

/// Adds the impulses on the boxes. The press of two of them on each other through the piece is left out: their own
/// collision has it already, and between boxes that cannot yield it has no bound.
void give_to_boxes(std::span<const FoundContact> found, std::span<const elastic::NodeContact> contacts,
                   ContactWorld& world) {
  std::map<int, Vec3> given_ns;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].box >= 0) given_ns[found[i].box] -= from_eigen(contacts[i].impulse_ns);
  for (auto a = given_ns.begin(); a != given_ns.end(); ++a)
    for (auto b = std::next(a); b != given_ns.end(); ++b) {
      const Vec3 apart = a->second - b->second;
      if (!(glm::dot(a->second, b->second) < 0.0)) continue;
      const Vec3 way = glm::normalize(apart);
      const double both = std::min(glm::dot(a->second, way), -glm::dot(b->second, way));
      a->second -= both * way;
      b->second += both * way;
    }
  for (const auto& [box, impulse_ns] : given_ns) world.boxes[static_cast<std::size_t>(box)].impulse_ns += impulse_ns;
}

/// Books a step that began with `before`, against the surfaces as they are: the rebound is the contact's.
void book_step(EnergyLedger& ledger, const Piece& piece, const elastic::ElasticBody& before,
               const elastic::StepSettings& settings, std::vector<elastic::NodeContact> contacts,
               std::span<const double> closing_mps, double share) {
  for (std::size_t i = 0; i < contacts.size(); ++i)
    contacts[i].surface_velocity_mps -= piece.material.restitution * closing_mps[i] * contacts[i].normal;
  book(ledger, elastic::step_energy(before, piece.body, settings, contacts, share));
}

/// What an impact had lost pays for flow, cracks and scatter.
void book_flow(EnergyLedger& ledger, const Flow& flowed) {
  ledger.plastic_loss_j += flowed.plastic_j;
  ledger.pressing_loss_j -= flowed.paid_j;
}

void book_fracture(EnergyLedger& ledger, const FractureResult& result) {
  ledger.fracture_loss_j += result.cracked_j;
  ledger.pressing_loss_j -= result.paid_j + result.scattered_j;
}

/// One elastic step with its bound of energy, `ahead_s` after the tick's start, and the plastic flow; adds the impulses
/// on the boxes, and returns the contacts' effect on the piece.
Blow elastic_substep(Piece& piece, ContactWorld& world, double ahead_s, double step_s, StepReport& report,
                     EnergyLedger* ledger) {
  auto found = find_contacts(piece, world, step_s, ahead_s);
  const Frame frame = frame_of(piece, found, step_s);
  const auto closing_mps = add_restitution(piece, found, step_s);
  std::vector<elastic::NodeContact> contacts;
  contacts.reserve(found.size());
  for (const FoundContact& f : found) contacts.push_back(f.contact);
  elastic::StepSettings settings;
  settings.step_s = step_s;
  settings.solver = elastic::Solver::direct;
  settings.keep_stress = true;
  const auto position_m = piece.body.position_m, velocity_mps = piece.body.velocity_mps;
  std::optional<elastic::ElasticBody> before;
  if (ledger) before = piece.body;
  report.bad_numbers += elastic::step_elastic(piece.body, settings, contacts).bad_numbers;
  const double share = bound_blow(piece, frame, step_s, position_m, velocity_mps, contacts);
  if (ledger) book_step(*ledger, piece, *before, settings, contacts, closing_mps, share);
  const auto bound = [&] { bound_energy(piece, frame); };
  rewrite(ledger, &EnergyLedger::bound_loss_j, piece, bound);
  give_to_boxes(found, contacts, world);
  Blow blow = blow_of(piece, contacts, closing_mps, step_s);
  blow.lost_j = std::min(blow.lost_j, lost_j(piece, frame));
  const Flow flowed = flow(piece, blow);
  if (ledger) book_flow(*ledger, flowed);
  rewrite(ledger, &EnergyLedger::bound_loss_j, piece, bound);
  blow.lost_j = std::max(0.0, std::min(blow.lost_j - flowed.paid_j, lost_j(piece, frame)));
  return blow;
}

/// Steps a piece from substep `first` of a tick of `count`. Fragments continue by themselves for the rest of the tick;
/// all remaining pieces at its end are appended to `done`.
void step_piece(Piece piece, ContactWorld& world, int first, int count, double substep_s, StepReport& report,
                std::vector<Piece>& done, EnergyLedger* ledger) {
  for (int k = first; k < count; ++k) {
    const Blow blow = elastic_substep(piece, world, k * substep_s, substep_s, report, ledger);
    FractureResult result = fracture(piece, blow, substep_s);
    if (ledger) book_fracture(*ledger, result);
    if (result.opened_faces == 0) {
      const double unpaid_j = result.cracked_j - result.paid_j, slack_j = take_cracks(piece, result);
      // Of what the shape had stored the cracks take their energy, and the film damps the rest.
      if (ledger && slack_j > 0.0) ledger->viscous_loss_j += slack_j - std::min(unpaid_j, slack_j);
      continue;
    }
    report.fractures += result.opened_faces;
    take_from_deformation(result.pieces, result.cracked_j - result.paid_j);
    // The largest part keeps the id, so that a screen continues with the piece it shows.
    std::ranges::stable_sort(result.pieces, std::ranges::greater{},
                             [](const Piece& p) { return p.body.elements.size(); });
    result.pieces.front().id = piece.id;
    for (Piece& part : result.pieces) step_piece(std::move(part), world, k + 1, count, substep_s, report, done, ledger);
    return;
  }
  done.push_back(std::move(piece));
}

}  // namespace

std::uint32_t spawn_part(State& state, Part part, const RigidTransform& world_from_part, const Vec3& velocity_mps,
                         const Vec3& angular_velocity_radps, Random& random, double height_left) {
  Piece piece = make_part(part, world_from_part, velocity_mps, angular_velocity_radps, random, height_left);
  piece.id = state.next_id++;
  state.pieces.push_back(std::move(piece));
  return state.pieces.back().id;
}

StepReport advance_debris(State& state, ContactWorld& world, double step_s, EnergyLedger* ledger) {
  StepReport report;
  for (Box& box : world.boxes) box.impulse_ns = Vec3(0.0);
  const double before_melting_j = ledger && world.melted_m > 0.0 ? stored_energy(state).sum_j() : 0.0;
  melt_ice(state, world.melted_m);
  if (ledger && world.melted_m > 0.0) ledger->melting_loss_j += before_melting_j - stored_energy(state).sum_j();
  exchange_impulses(state.pieces, step_s, ledger);
  std::vector<Piece> kept, broken_off, done;
  for (Piece& piece : state.pieces) {
    if (piece.asleep && box_near(piece, world, step_s)) {
      piece.asleep = false;
      piece.calm_s = 0.0;
    }
    if (piece.asleep) {
      kept.push_back(std::move(piece));
      continue;
    }
    done.clear();
    feel_air(piece, to_eigen(world.wind_mps));
    const int substeps = substeps_for(piece, find_contacts(piece, world, step_s), step_s);
    step_piece(std::move(piece), world, 0, substeps, step_s / substeps, report, done, ledger);
    ++report.awake;
    for (Piece& part : done) {
      if (is_shard(part)) {
        state.shards.push_back(shard_of(part));
        if (ledger)
          ledger->stiffening_loss_j += stored_energy(part).sum_j() - stored_energy(state.shards.back()).sum_j();
        continue;
      }
      update_sleep(part, step_s, ledger);
      (part.id != 0 ? kept : broken_off).push_back(std::move(part));
    }
  }
  for (Piece& part : broken_off) {
    part.id = state.next_id++;
    kept.push_back(std::move(part));
  }
  state.pieces = std::move(kept);
  for (Piece& piece : state.pieces) report.bad_numbers += elastic::reset_bad_nodes(piece.body);
  report.bad_numbers += advance_shards(state, world, step_s, ledger);
  state.bad_numbers += static_cast<std::uint32_t>(report.bad_numbers);
  return report;
}

std::optional<double> highest_debris_m(const State& state, double x_m, double y_m, double radius_m) {
  std::optional<double> highest;
  for (const Piece& piece : state.pieces) {
    const Eigen::AlignedBox3d bounds = bounds_of(piece);
    if (x_m < bounds.min().x() - radius_m || x_m > bounds.max().x() + radius_m || y_m < bounds.min().y() - radius_m ||
        y_m > bounds.max().y() + radius_m || bounds.diagonal().z() < 0.01)
      continue;
    for (const auto& x : piece.body.position_m) {
      const double dx = x.x() - x_m, dy = x.y() - y_m;
      if (dx * dx + dy * dy > radius_m * radius_m) continue;
      highest = std::max(highest.value_or(x.z()), x.z());
    }
  }
  return highest;
}

}  // namespace septet::debris
