#include "engine/raytrace/matt_paths.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/raytrace/crossing.hpp"
#include "engine/raytrace/matt_faces.hpp"
#include "engine/raytrace/path.hpp"

namespace septet::raytrace {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Points on lamps, and their unshadowed light.
struct LampSeen {
  Int8 there;  ///< True where light may come.
  Vec8 direction, radiance;
  Float8 distance_m, pdf;
};

class MattPaths {
 public:
  MattPaths(const World& world, const PathSettings& settings, std::uint32_t wanted, Packet<PathStart>& starts)
      : world_(world),
        faces_(*world.matt_faces()),
        settings_(settings),
        wanted_(wanted),
        starts_(starts),
        random_([&](std::size_t n) -> const PathRandom& { return starts[n].random; }) {
    for (std::size_t n = 0; n < packet_size; ++n) rays_.set(n, starts[n].ray);
    if (world.lamps().size() == 1)  // Weight of a single lamp, the same everywhere.
      for (LampWeights& weights : lamp_weights_) world.lamp_row().weigh_for_choice({}, {}, 0.0f, weights);
  }

  void trace(std::uint32_t begun);

 private:
  void go_alone(std::uint32_t which, std::uint32_t met, const HitPacket& hits);
  void note_first(std::uint32_t which, const HitPacket& hits, const Face8& face, const Vec8& position_m,
                  const Vec8& normal);
  LampSeen draw_lamps(Int8 drawn, const Vec8& from_m, const Vec8& normal);
  void look_at_lamps(Int8 going, const Face8& face, const Vec8& position_m, const Vec8& normal, bool looks_alone);
  Int8 leave(Int8 going, const Face8& face, const Vec8& position_m, const Vec8& normal);

  const World& world_;
  const MattFaces& faces_;
  const PathSettings& settings_;
  const std::uint32_t wanted_;
  Packet<PathStart>& starts_;
  PathRandom8 random_;
  RayPacket rays_;  ///< Rays of the current edge.
  std::uint32_t edge_ = 1;
  Vec8 light_ = eight(glm::vec3(0.0f)), throughput_ = eight(glm::vec3(1.0f));
  Vec8 from_m_ = eight(glm::vec3(0.0f));  ///< Last point.
  Float8 pdf_{};                          ///< Density with which the last direction was drawn.
  Packet<LampWeights> lamp_weights_;      ///< Weights at the last point.
};

void MattPaths::go_alone(std::uint32_t which, std::uint32_t met, const HitPacket& hits) {
  for (std::size_t n = 0; n < packet_size; ++n) {
    if (!holds(which & wanted_, n)) continue;
    PathStart& start = starts_[n];
    const Ray first_ray = start.ray;
    start.random = random_[n];
    start.ray = rays_[n];
    Path path(world_, settings_, start, {edge_, light_[n], throughput_[n], from_m_[n], pdf_[n]}, lamp_weights_[n]);
    path.finish(holds(met, n), hits[n], edge_ == 1 ? &start.first : nullptr);
    start.ray = first_ray;
    start.radiance = path.light();
  }
}

void MattPaths::note_first(std::uint32_t which, const HitPacket& hits, const Face8& face, const Vec8& position_m,
                           const Vec8& normal) {
  const Vec8 way = position_m - rays_.origin_m;
  const Float8 distance_m = root(dot(way, way));
  for (std::size_t n = 0; n < packet_size; ++n) {
    if (!holds(which & wanted_, n)) continue;
    FirstSeen& first = starts_[n].first;
    first.distance_m = distance_m[n];
    first.normal = normal[n];
    first.albedo = face.color[n];
    first.object = world_.object(hits.place[n]);
    first.participant = world_.participant(hits.place[n]);
    first.from_m = first.to_m = position_m[n];
  }
}

/// Same as draw_lamp (drawn_lights.hpp), for eight.
LampSeen MattPaths::draw_lamps(Int8 drawn, const Vec8& from_m, const Vec8& normal) {
  const std::vector<Lamp>& lamps = world_.lamps();
  Packet<std::size_t> which{};
  Float8 chance = eight(1.0f);
  if (lamps.size() > 1) {
    Float8 sums{};
    for (std::size_t n = 0; n < packet_size; ++n) {
      if (!drawn[n]) continue;
      world_.lamp_row().weigh(from_m[n], normal[n], rays_.time[n], lamp_weights_[n]);
      sums[n] = lamp_weights_[n].sum();
    }
    drawn &= sums > 0.0f;
    const Float8 uniform = random_.uniform(drawn);
    for (std::size_t n = 0; n < packet_size; ++n) {
      if (!drawn[n]) continue;
      which[n] = lamp_weights_[n].drawn(uniform[n]);
      chance[n] = lamp_weights_[n].chance(which[n]);
    }
  }
  Int8 of_many{};
  for (std::size_t n = 0; n < packet_size; ++n) of_many[n] = lamps[which[n]].triangles.size() > 1 ? -1 : 0;
  const Float8 at = random_.uniform(drawn & of_many);
  const Face* faces[8];
  for (std::size_t n = 0; n < packet_size; ++n)
    faces[n] = &faces_.lamps[faces_.first_of_lamp[which[n]] + (of_many[n] ? lamps[which[n]].drawn_triangle(at[n]) : 0)];
  const Face8 face(faces);
  const auto [x, y] = random_.pair(drawn);
  const Float8 to_edge = root(x), u = to_edge * (1.0f - y), v = to_edge * y;
  const Vec8 way = face.corner_m + face.second * u + face.third * v - from_m;
  const Float8 square = dot(way, way), per_m = 1.0f / root(square);
  const Vec8 direction = way * per_m;
  const Float8 cosine = -dot(face.normal, direction);
  return {drawn & (cosine > 1e-6f), direction, face.color, square * per_m, chance * square / (cosine * face.number)};
}

/// Same as Path::look_at_a_light, from matt surfaces.
void MattPaths::look_at_lamps(Int8 going, const Face8& face, const Vec8& position_m, const Vec8& normal,
                              bool looks_alone) {
  const LampSeen lamp = draw_lamps(going, position_m, normal);
  const Float8 cosine = dot(normal, lamp.direction);
  const Int8 looks = lamp.there & (cosine > 0.0f);
  const std::uint32_t which = bits_of(looks);
  if (!which) return;
  const Float8 pdf = cosine * (1.0f / pi);
  const Float8 share =
      looks_alone ? 1.0f / lamp.pdf : lamp.pdf / larger(lamp.pdf * lamp.pdf + pdf * pdf, eight(1e-37f));
  RayPacket shadow;
  shadow.origin_m = beside(position_m, normal);
  const Vec8 at = position_m + lamp.direction * lamp.distance_m, way = at - shadow.origin_m;
  const Float8 square = dot(way, way), per_m = 1.0f / root(larger(square, eight(1e-30f)));
  shadow.direction = way * per_m;
  shadow.from_m = Float8{};
  shadow.to_m = larger(square * per_m - 3.0f * margin_m(at), Float8{});
  shadow.time = rays_.time;
  const Float8 let_through = world_.geometry().unshadowed(which, shadow);
  // Selected, not multiplied by 0: a path that has ended may hold NaN.
  light_ = chosen(looks, light_ + throughput_ * face.color * lamp.radiance * (pdf * share * let_through), light_);
}

/// Same as Path::leave, from matt surfaces. Returns the paths that go on.
Int8 MattPaths::leave(Int8 going, const Face8& face, const Vec8& position_m, const Vec8& normal) {
  const auto [x, y] = random_.pair(going);
  const auto local = cosine_direction_of<Vec8>(x, y);
  throughput_ = throughput_ * face.color;
  const Float8 most = larger(throughput_.x, larger(throughput_.y, throughput_.z));
  const Vec8 direction = FrameOf<Vec8>(normal).to_world(local);
  going &= (most > 0.0f) & (dot(direction, normal) > 0.0f);
  if (edge_ >= settings_.roulette_from) {
    const Float8 goes_on = most < 0.95f ? most : eight(0.95f);
    going &= random_.uniform(going) < goes_on;
    throughput_ = throughput_ * (1.0f / goes_on);
  }
  pdf_ = local.z * (1.0f / pi);
  from_m_ = position_m;
  rays_.origin_m = beside(position_m, normal);
  rays_.direction = direction;
  rays_.from_m = Float8{};
  rays_.to_m = eight(infinite);
  return going;
}

void MattPaths::trace(std::uint32_t begun) {
  Int8 going = truths_of(begun);
  std::uint32_t alone = 0;  ///< Bits of paths that were finished by themselves.
  for (; bits_of(going); ++edge_) {
    HitPacket hits;
    const std::uint32_t which = bits_of(going);
    const std::uint32_t met =
        world_.geometry().intersect(which, rays_, edge_ == 1 ? Together::side_by_side : Together::anywhere, hits);
    const Face* rows[8];
    for (std::size_t n = 0; n < packet_size; ++n)
      rows[n] = holds(met, n) ? &faces_.at(hits.place[n], hits.triangle[n]) : &faces_.other;
    const Face8 face(rows);
    // Paths that meet the back of a one-sided face go on by themselves.
    const Int8 seen = (face.number > 1.5f) | ((face.number > 0.0f) & (dot(face.normal, rays_.direction) < 0.0f));
    const std::uint32_t matt = bits_of(seen) & met;
    // Paths that miss all geometry see nothing after their first edge.
    const std::uint32_t by_themselves = edge_ == 1 ? which & ~matt : met & ~matt;
    go_alone(by_themselves, met, hits);
    alone |= by_themselves;
    going = truths_of(matt);

    const Vec8 position_m = face.corner_m + face.second * hits.u + face.third * hits.v;
    const Vec8 normal = face.normal * -sign_of(dot(face.normal, rays_.direction));
    if (edge_ == 1) note_first(matt, hits, face, position_m, normal);
    if (edge_ == settings_.longest) break;
    const bool looks_alone = edge_ > 2 && edge_ + 1 == settings_.longest && world_.all_light_can_be_drawn();
    look_at_lamps(going, face, position_m, normal, looks_alone);
    if (looks_alone) break;
    going = leave(going, face, position_m, normal);
  }
  for (std::size_t n = 0; n < packet_size; ++n)
    if (!holds(alone, n)) starts_[n].radiance = light_[n];
}

}  // namespace

void trace_matt_paths(const World& world, const PathSettings& settings, std::uint32_t begun, std::uint32_t wanted,
                      Packet<PathStart>& starts) {
  MattPaths(world, settings, wanted, starts).trace(begun);
}

}  // namespace septet::raytrace
