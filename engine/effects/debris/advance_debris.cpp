#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <glm/geometric.hpp>

#include "engine/effects/debris/blow.hpp"
#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/shards.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/step.hpp"

namespace septet::debris {
namespace {

/// A piece rests when its nodes' root mean square speed stays below this for a second.
constexpr double calm_speed_mps = 0.03, calm_time_s = 1.0;

void update_sleep(Piece& piece, double step_s) {
  const double speed = std::sqrt(2.0 * elastic::kinetic_energy_j(piece.body) /
                                 elastic::total_mass_kg(piece.body));
  piece.calm_s = speed < calm_speed_mps ? piece.calm_s + step_s : 0.0;
  if (piece.calm_s < calm_time_s) return;
  piece.asleep = true;
  std::ranges::fill(piece.body.velocity_mps, Eigen::Vector3d::Zero());
}

/// A step is linear in what moves; where contact would move a node by much of an element's size in
/// one, the piece makes several.
int substeps_for(const Piece& piece, const std::vector<FoundContact>& contacts, double step_s) {
  constexpr double share_of_element = 0.15;
  constexpr int most = 24;
  double size = INFINITY, closing = 0.0;
  for (const auto& e : piece.body.elements)
    size = std::min(size, std::cbrt(6.0 * e.rest_volume_m3));
  for (const FoundContact& f : contacts) {
    const Eigen::Vector3d relative =
        piece.body.velocity_mps[f.contact.node] - f.contact.surface_velocity_mps;
    closing = std::max(closing, relative.norm());
  }
  const double wanted = closing * step_s / (share_of_element * size);
  return std::clamp(static_cast<int>(std::ceil(std::min(wanted, double{most}))), 1, most);
}

/// The elastic step errs where elements turn or shear by much within it. Energy that nothing gave
/// is taken out of the deformation: of its velocity, and of its shape by going back towards the
/// rest shape in its best place. Mass, momentum and angular momentum stay.
void bound_energy(Piece& piece, double allowed_j) {
  auto& body = piece.body;
  const auto motion = elastic::rigid_motion(body);
  const double elastic_j = elastic::elastic_energy_j(body);
  const double rigid_j = 0.5 * elastic::total_mass_kg(body) * motion.velocity_mps.squaredNorm() +
                         0.5 * motion.angular_momentum_nms.dot(motion.angular_velocity_radps);
  const double moving_j = std::max(0.0, elastic::kinetic_energy_j(body) - rigid_j);
  const double budget = std::max(0.0, allowed_j - rigid_j);
  const double excess = elastic_j + moving_j;
  if (excess <= budget || excess <= 1e-6) return;
  const double keep = std::sqrt(budget / excess);
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rest_centre = Eigen::Vector3d::Zero();
  for (int i = 0; i < body.node_count(); ++i)
    rest_centre += body.mass_kg[i] * body.rest_position_m[i] / elastic::total_mass_kg(body);
  for (int i = 0; i < body.node_count(); ++i)
    correlation += body.mass_kg[i] * (body.position_m[i] - motion.centre_m) *
                   (body.rest_position_m[i] - rest_centre).transpose();
  Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  const Eigen::Matrix3d turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d home =
        motion.centre_m + turn * (body.rest_position_m[i] - rest_centre);
    if (elastic_j > budget) body.position_m[i] = home + keep * (body.position_m[i] - home);
    const Eigen::Vector3d arm = body.position_m[i] - motion.centre_m;
    const Eigen::Vector3d rigid =
        motion.velocity_mps + motion.angular_velocity_radps.cross(arm);
    body.velocity_mps[i] = rigid + keep * (body.velocity_mps[i] - rigid);
  }
  const auto now = elastic::rigid_motion(body);
  const Eigen::Vector3d change =
      now.inertia_kgm2.inverse() * (motion.angular_momentum_nms - now.angular_momentum_nms);
  for (int i = 0; i < body.node_count(); ++i)
    body.velocity_mps[i] += change.cross(body.position_m[i] - now.centre_m);
}

/// Two surfaces that close on a piece ask of it what no velocity can do, and the step answers with more than either gives.
/// Where that made it faster than `allowed_j` lets it be, the step's change of velocity, and with it the surfaces' impulses,
/// is taken only as far as that. `position_m` and `velocity_mps` are those before the step.
void bound_blow(Piece& piece, double allowed_j, double step_s, std::span<const Eigen::Vector3d> position_m,
                std::span<const Eigen::Vector3d> velocity_mps, std::vector<elastic::NodeContact>& contacts) {
  auto& body = piece.body;
  if (elastic::kinetic_energy_j(body) <= allowed_j) return;
  // K(s) = K₀ + bs + as² of v₀ + s Δv.
  double a = 0.0, b = 0.0, k0 = 0.0;
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d change = body.velocity_mps[i] - velocity_mps[i];
    a += 0.5 * body.mass_kg[i] * change.squaredNorm();
    b += body.mass_kg[i] * velocity_mps[i].dot(change);
    k0 += 0.5 * body.mass_kg[i] * velocity_mps[i].squaredNorm();
  }
  const double root = std::sqrt(std::max(0.0, b * b + 4.0 * a * (allowed_j - k0)));
  const double share = a > 0.0 ? std::clamp((root - b) / (2.0 * a), 0.0, 1.0) : 1.0;
  for (int i = 0; i < body.node_count(); ++i) {
    body.velocity_mps[i] = velocity_mps[i] + share * (body.velocity_mps[i] - velocity_mps[i]);
    body.position_m[i] = position_m[i] + step_s * body.velocity_mps[i];
  }
  for (auto& contact : contacts) contact.impulse_ns *= share;
}

/// One elastic step with its bound of energy, `ahead_s` after the tick's start; adds what the boxes
/// received, and answers what the contacts did to the piece.
Blow elastic_substep(Piece& piece, ContactWorld& world, double ahead_s, double step_s,
                     Report& report) {
  auto found = find_contacts(piece, world, step_s, ahead_s);
  std::vector<Eigen::Vector3d> surface_velocity_mps;
  for (const FoundContact& f : found)
    surface_velocity_mps.push_back(f.contact.surface_velocity_mps);
  const auto closing_mps = add_restitution(piece, found, step_s);
  std::vector<elastic::NodeContact> contacts;
  for (const FoundContact& f : found) contacts.push_back(f.contact);
  elastic::StepSettings settings;
  settings.step_s = step_s;
  settings.solver = elastic::Solver::direct;
  settings.keep_stress = true;
  const double mass = elastic::total_mass_kg(piece.body);
  const double before =
      elastic::kinetic_energy_j(piece.body) + elastic::elastic_energy_j(piece.body);
  const auto position_m = piece.body.position_m, velocity_mps = piece.body.velocity_mps;
  report.bad_numbers += elastic::step_elastic(piece.body, settings, contacts).bad_numbers;
  // What weight and the surfaces' own motion may have added, generously; but between two surfaces that close on it, as in a
  // crash, a piece gets no faster than a blow of the faster one makes it: V + e(V + v).
  const double speed = std::sqrt(2.0 * before / mass), weight_j = mass * 9.81 * step_s * (speed + 0.2);
  double work_j = 0.0, fastest = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double impulse = contacts[i].impulse_ns.norm();
    if (impulse == 0.0) continue;
    const double surface = surface_velocity_mps[i].norm() + std::clamp(-contacts[i].gap_m / step_s, 0.0, 2.0);
    work_j += impulse * surface;
    fastest = std::max(fastest, surface);
  }
  const double struck = fastest + piece.material.restitution * (fastest + speed);
  const double allowed_j = weight_j + std::min(before + work_j, std::max(before, 0.5 * mass * struck * struck));
  bound_blow(piece, allowed_j, step_s, position_m, velocity_mps, contacts);
  bound_energy(piece, allowed_j);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i].box >= 0)
      world.boxes[found[i].box].impulse_ns -= from_eigen(contacts[i].impulse_ns);
  Blow blow = blow_of(piece, contacts, closing_mps, step_s);
  blow.lost_j = std::min(blow.lost_j, allowed_j);
  return blow;
}

/// Steps a piece from substep `first` of a tick of `count`. What breaks off goes on for the rest of
/// the tick by itself; all that is left at its end is appended to `done`.
void step_piece(Piece piece, ContactWorld& world, int first, int count, double substep_s,
                Report& report, std::vector<Piece>& done) {
  for (int k = first; k < count; ++k) {
    const Blow blow = elastic_substep(piece, world, k * substep_s, substep_s, report);
    flow(piece, blow);
    FractureResult result = fracture(piece, blow);
    if (result.opened_faces == 0) continue;
    report.fractures += result.opened_faces;
    // The largest part keeps the id, so that a screen goes on with what it shows.
    std::ranges::stable_sort(result.pieces, std::ranges::greater{},
                             [](const Piece& p) { return p.body.elements.size(); });
    result.pieces.front().id = piece.id;
    for (Piece& part : result.pieces)
      step_piece(std::move(part), world, k + 1, count, substep_s, report, done);
    return;
  }
  done.push_back(std::move(piece));
}

}  // namespace

std::uint32_t spawn_part(State& state, Part part, const RigidTransform& world_from_part,
                         const Vec3& velocity_mps, const Vec3& angular_velocity_radps,
                         Random& random) {
  Piece piece = make_part(part, world_from_part, velocity_mps, angular_velocity_radps, random);
  piece.id = state.next_id++;
  state.pieces.push_back(std::move(piece));
  return state.pieces.back().id;
}

Report advance_debris(State& state, ContactWorld& world, double step_s) {
  Report report;
  for (Box& box : world.boxes) box.impulse_ns = Vec3(0.0);
  exchange_impulses(state.pieces, step_s);
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
    const int substeps = substeps_for(piece, find_contacts(piece, world, step_s), step_s);
    step_piece(std::move(piece), world, 0, substeps, step_s / substeps, report, done);
    ++report.awake;
    for (Piece& part : done) {
      if (is_shard(part)) {
        state.shards.push_back(shard_of(part));
        continue;
      }
      update_sleep(part, step_s);
      (part.id != 0 ? kept : broken_off).push_back(std::move(part));
    }
  }
  for (Piece& part : broken_off) {
    part.id = state.next_id++;
    kept.push_back(std::move(part));
  }
  state.pieces = std::move(kept);
  advance_shards(state, world, step_s);
  state.bad_numbers += static_cast<std::uint32_t>(report.bad_numbers);
  return report;
}

std::optional<double> highest_debris_m(const State& state, double x_m, double y_m,
                                       double radius_m) {
  std::optional<double> highest;
  for (const Piece& piece : state.pieces) {
    Eigen::AlignedBox3d bounds;
    for (const auto& x : piece.body.position_m) bounds.extend(x);
    if (x_m < bounds.min().x() - radius_m || x_m > bounds.max().x() + radius_m ||
        y_m < bounds.min().y() - radius_m || y_m > bounds.max().y() + radius_m ||
        bounds.diagonal().z() < 0.01)
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
