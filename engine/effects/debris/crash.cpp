#include "engine/effects/debris/crash.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/effects/debris/contacts.hpp"
#include "engine/physics/elastic/body_measures.hpp"

namespace septet::debris {
namespace {

/// Frequency of a passenger car's crush against a rigid wall: 56 km/h give 37 g and 0.66 m.
constexpr double crush_frequency_radps = 23.5;

Vec3 velocity_at(const Box& box, const Vec3& point_m) {
  return box.velocity_mps +
         glm::cross(box.angular_velocity_radps, point_m - box.world_from_box.position_m);
}

double part_radius_m(Part part) { return 0.5 * part_recipe(part).size_m.minCoeff(); }

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
    return std::ranges::none_of(
        boxes, [&](const Box& box) { return gap_to_box(box, point).gap_m < 0.15; });
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
  for (const auto& x : piece.body.position_m)
    deepest = std::max(deepest, world.ground(x.x(), x.y()).height_m - x.z());
  if (deepest > 0.0) move(piece, {0, 0, deepest + 0.01});
}

void break_off(Context& context, const Crash& crash, CrashBody& body, const CrashBody& other,
               double lost_speed_mps, const Vec3& push) {
  const double closing = context.report.closing_speed_mps;
  const double crush_m = lost_speed_mps / crush_frequency_radps;
  std::vector<MountedPart> left;
  for (const MountedPart& mounted : body.parts) {
    const RigidTransform place = body.box.world_from_box * mounted.box_from_part;
    const double mass = part_recipe(mounted.part).mass_kg;
    const bool struck = gap_to_box(other.box, place.position_m).gap_m <
                        crush_m + part_radius_m(mounted.part);
    const double peak_n = mass * lost_speed_mps * crush_frequency_radps;
    if (!struck && peak_n <= mounted.mount_strength_n) {
      left.push_back(mounted);
      continue;
    }
    const Vec3 before = velocity_at(body.box, place.position_m);
    Vec3 velocity = before;
    if (struck) {
      // Carried along by the crush to the common speed; the scatter comes on top.
      velocity += lost_speed_mps * push;
      const Vec3 out = place.position_m - crash.point_m;
      Vec3 aside = out - glm::dot(out, push) * push;
      aside.z = std::abs(aside.z) + 0.2;
      aside += 0.3 * Vec3(context.random.normal(), context.random.normal(),
                          std::abs(context.random.normal()));
      aside -= glm::dot(aside, push) * push;
      const double share = std::sqrt(context.random.uniform(0.3, 1.0));
      velocity += glm::normalize(aside) * 0.45 * closing * share;
      ++context.report.struck;
    } else {
      const double sine = mounted.mount_strength_n / peak_n;
      velocity += lost_speed_mps * (1.0 - std::sqrt(1.0 - sine * sine)) * push;
      ++context.report.torn_off;
    }
    // Which mount holds longest is not known; the part turns about it.
    Vec3 spin = body.box.angular_velocity_radps;
    for (int c = 0; c < 3; ++c)
      spin[c] += 0.15 * glm::length(velocity - before) * context.random.normal();
    const auto id = spawn_part(context.state, mounted.part, place, velocity, spin, context.random);
    Piece& piece = context.state.pieces.back();
    SEPTET_CHECK(piece.id == id, "piece {} after {}", piece.id, id);
    squeeze_out(piece, context.boxes, push, context.random.uniform() < 0.5 ? -1.0 : 1.0);
    lift_above_ground(piece, context.world);
    body.impulse_ns -= mass * (velocity - before);
    context.report.pieces.push_back(id);
  }
  body.parts = std::move(left);
}

}  // namespace

CrashReport crash(State& state, Crash& crash, const ContactWorld& world, Random& random) {
  CrashReport report;
  const Vec3 relative =
      velocity_at(crash.first.box, crash.point_m) - velocity_at(crash.second.box, crash.point_m);
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
