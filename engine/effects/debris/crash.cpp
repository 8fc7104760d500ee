#include "engine/effects/debris/crash.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/effects/debris/shards.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::debris {
namespace {

Vec3 velocity_at(const Box& box, const Vec3& point_m) {
  return box.velocity_mps + glm::cross(box.angular_velocity_radps, point_m - box.world_from_box.position_m);
}

double part_radius_m(Part part) {
  const Vec3& size = part_recipe(part).size_m;
  return 0.5 * std::min({size.x, size.y, size.z});
}

/// Moves a piece by `shift` without changing its motion.
void move(Piece& piece, const Vec3& shift) {
  for (auto& x : piece.body.position_m) x += to_eigen(shift);
}

/// Takes the piece out of the boxes, sideways or upwards but not through the contact.
void squeeze_out(Piece& piece, const std::vector<Box>& boxes, const Vec3& normal, double side) {
  const Vec3 up(0, 0, 1);
  Vec3 across = glm::cross(up, normal);
  across = glm::length(across) > 0.1 ? glm::normalize(across) * side : Vec3(0, side, 0);
  const auto centre = [&] { return from_eigen(elastic::centre_of_mass_m(piece.body)); };
  const auto is_free = [&](const Vec3& point) {
    return std::ranges::none_of(boxes, [&](const Box& box) { return gap_to_box(box, point).gap_m < 0.15; });
  };
  constexpr double stride_m = 0.1;
  const Vec3 start = centre();
  for (int k = 0; k < 60; ++k)
    for (const Vec3& way : {across, up, -across}) {
      const Vec3 point = start + k * stride_m * way;
      if (!is_free(point)) continue;
      move(piece, point - start);
      return;
    }
}

struct Context {
  State& state;
  const ContactWorld& world;
  Random& random;
  CrashReport& report;
  std::vector<Box> boxes;
};

void lift_above_ground(Piece& piece, const ContactWorld& world) {
  if (!world.ground) return;
  double deepest = 0.0;
  for (const auto& x : piece.body.position_m) deepest = std::max(deepest, world.ground(x.x(), x.y()).height_m - x.z());
  if (deepest > 0.0) move(piece, {0, 0, deepest + 0.01});
}

/// Crushes a part between the two bodies: pressed together by `crush_m`, it splits as far as the energy of its own
/// motion and of the crush reaches.
std::vector<Piece> crushed(Piece piece, const Vec3& push, double crush_m, double closing_mps) {
  const auto& m = piece.material;
  const Eigen::Vector3d normal = to_eigen(push);
  double low = INFINITY, high = -INFINITY, volume_m3 = 0.0;
  for (const auto& x : piece.body.position_m) {
    low = std::min(low, x.dot(normal));
    high = std::max(high, x.dot(normal));
  }
  for (const auto& e : piece.body.elements) volume_m3 += e.rest_volume_m3;
  const double strain = std::min(1.0, crush_m / (high - low));
  piece.body.step_stress_pa.assign(piece.body.elements.size(),
                                   -strain * m.elastic.young_modulus_pa * normal * normal.transpose());
  Blow blow;
  blow.normal = normal;
  blow.lost_j =
      0.5 * elastic::total_mass_kg(piece.body) * closing_mps * closing_mps * (1.0 - m.restitution * m.restitution);
  blow.pressed_j = strain * volume_m3 * (m.yield_pa > 0.0 ? m.yield_pa : m.compressive_strength_pa);
  blow.lost_j = std::max(0.0, blow.lost_j - flow(piece, blow).paid_j);  // The rest is for cracks and scatter.
  FractureResult result = fracture(piece, blow);
  if (result.opened_faces == 0) result.pieces.push_back(std::move(piece));
  return std::move(result.pieces);
}

/// A random direction across the impact, rather up than down and rather away from its middle.
Vec3 way_out(Context& context, const Vec3& from_middle, const Vec3& push) {
  // In sequence: the order in which a call's arguments are evaluated is the compiler's choice.
  const double left = context.random.normal(), ahead = context.random.normal();
  Vec3 way = from_middle + 0.3 * Vec3(ahead, left, 0.0);
  way.z = std::abs(way.z) + 0.2 + 0.3 * context.random.uniform();
  way -= glm::dot(way, push) * push;
  return glm::normalize(way);
}

/// Puts a part's pieces into the state, outside the boxes and above the ground.
void release(Context& context, std::vector<Piece> pieces, const Vec3& push) {
  for (Piece& piece : pieces) {
    squeeze_out(piece, context.boxes, push, context.random.uniform() < 0.5 ? -1.0 : 1.0);
    lift_above_ground(piece, context.world);
    if (is_shard(piece)) {
      context.state.shards.push_back(shard_of(piece));
      continue;
    }
    piece.id = context.state.next_id++;
    context.report.pieces.push_back(piece.id);
    context.state.pieces.push_back(std::move(piece));
  }
}

/// A laminated pane that is struck stays in its frame. Its cracks are drawn as a star (ice/glass.hpp); a few splinters
/// come off them. Number, share of the mass and speed are assumed.
void crack_in_frame(Context& context, const MountedPart& mounted, CrashBody& body, const Vec3& place_m,
                    const Vec3& push) {
  constexpr int splinters_of_pane = 8;
  constexpr double splintered_share = 0.002, returned_share = 0.1;
  const PartRecipe& recipe = part_recipe(mounted.part);
  const double mass_kg = splintered_share * recipe.mass_kg / splinters_of_pane;
  const double density_kgpm3 = material_data(recipe.material).elastic.density_kgpm3;
  const Vec3 before = velocity_at(body.box, place_m);
  for (int k = 0; k < splinters_of_pane; ++k) {
    Shard shard;
    shard.mass_kg = mass_kg;
    shard.size_m = std::cbrt(mass_kg / density_kgpm3);
    shard.shade_m2 = 1.5 * shard.size_m * shard.size_m;
    Vec3 off(0.0);
    for (int c = 0; c < 3; ++c) off[c] = 0.1 * context.random.normal();
    shard.position_m = place_m + off;
    shard.velocity_mps = before + returned_share * context.report.closing_speed_mps * way_out(context, off, push);
    context.report.kinetic_j += 0.5 * mass_kg * glm::dot(shard.velocity_mps, shard.velocity_mps);
    body.impulse_ns += mass_kg * (before - shard.velocity_mps);
    context.state.shards.push_back(shard);
  }
  ++context.report.starred;
}

void break_off(Context& context, const Crash& crash, CrashBody& body, const CrashBody& other, double lost_speed_mps,
               const Vec3& push) {
  const double closing = context.report.closing_speed_mps;
  const double frequency_radps = passenger_car_crush().frequency_radps;
  const double crush_m = closing / frequency_radps;
  std::vector<MountedPart> left;
  for (const MountedPart& mounted : body.parts) {
    const RigidTransform place = body.box.world_from_box * mounted.box_from_part;
    const double mass = part_recipe(mounted.part).mass_kg;
    const bool reached =
        gap_to_box(other.box, place.position_m).gap_m < lost_speed_mps / frequency_radps + part_radius_m(mounted.part);
    const bool holds = part_recipe(mounted.part).breakage == Breakage::holds;
    if (reached && holds) crack_in_frame(context, mounted, body, place.position_m, push);
    // A window does not outlast the door that it runs in.
    const bool struck = (reached && !holds) || (body.torn & bit_of(carrier_of(mounted.mount))) != 0;
    const double peak_n = mass * lost_speed_mps * frequency_radps;
    if (!struck && peak_n <= mounted.mount_strength_n) {
      left.push_back(mounted);
      continue;
    }
    const Vec3 before = velocity_at(body.box, place.position_m);
    Vec3 velocity = before;
    if (struck) {
      // Carried along by the crush to the common speed, and out with the rebound of the impact.
      const double returned = material_data(part_recipe(mounted.part).material).restitution * closing;
      // In sequence: the order in which operands are evaluated is the compiler's choice.
      const Vec3 way = way_out(context, place.position_m - crash.point_m, push);
      const double share = std::sqrt(context.random.uniform());
      velocity += lost_speed_mps * push + returned * share * way;
      ++context.report.struck;
    } else {
      const double sine = mounted.mount_strength_n / peak_n;
      velocity += lost_speed_mps * (1.0 - std::sqrt(1.0 - sine * sine)) * push;
      ++context.report.torn_off;
    }
    // The part turns about the mount that holds longest, which is not known: its spin is random.
    Vec3 spin = body.box.angular_velocity_radps;
    for (int c = 0; c < 3; ++c) spin[c] += 0.15 * glm::length(velocity - before) * context.random.normal();
    std::vector<Piece> pieces;
    pieces.push_back(make_part(mounted.part, place, velocity, spin, context.random));
    if (struck) pieces = crushed(std::move(pieces.front()), push, crush_m, closing);
    context.report.fragments += static_cast<int>(pieces.size());
    body.torn |= bit_of(mounted.mount);
    for (Piece& piece : pieces) {
      piece.origin = body.origin;
      if (piece.origin) piece.origin->mount = mounted.mount;
      body.impulse_ns -= from_eigen(elastic::momentum_ns(piece.body));
      context.report.kinetic_j += elastic::kinetic_energy_j(piece.body);
    }
    body.impulse_ns += mass * before;
    release(context, std::move(pieces), push);
  }
  body.parts = std::move(left);
}

}  // namespace

CrashReport crash(State& state, Crash& crash, const ContactWorld& world, Random& random) {
  CrashReport report;
  const Vec3 relative = velocity_at(crash.first.box, crash.point_m) - velocity_at(crash.second.box, crash.point_m);
  report.closing_speed_mps = -glm::dot(relative, crash.normal);
  if (!(report.closing_speed_mps >= least_crash_speed_mps)) return report;
  const double first = 1.0 / crash.first.mass_kg, second = 1.0 / crash.second.mass_kg;
  SEPTET_CHECK(first + second > 0.0, "a crash of two bodies that stand fast");
  Context context{state, world, random, report, world.boxes};
  context.boxes.push_back(crash.first.box);
  context.boxes.push_back(crash.second.box);
  const double per_mass = report.closing_speed_mps / (first + second);
  break_off(context, crash, crash.first, crash.second, per_mass * first, crash.normal);
  break_off(context, crash, crash.second, crash.first, per_mass * second, -crash.normal);
  return report;
}

}  // namespace septet::debris
