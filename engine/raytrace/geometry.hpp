#pragma once
/// Geometry that rays meet: meshes, each held once however often it is placed, and the places of an instant. Embree 3
/// lies behind this file and is included by geometry.cpp alone.
///
/// Frame: metres from an origin that the caller chooses, single precision; an origin near the eye is finest where it is
/// seen best. Hierarchies are built by one thread for one instruction set and so are the same each time and on every
/// machine: of two surfaces in one place a ray always meets the same one. (Processors of two makes estimate reciprocals
/// differently: there a hit's place may differ in its last digit.) All queries are const and may be made by any number
/// of threads at once.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/core/expected.hpp"
#include "engine/instant/level_fade.hpp"
#include "engine/raytrace/eight.hpp"
#include "engine/raytrace/motion.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::raytrace {

struct Ray {
  glm::vec3 origin_m{0.0f}, direction{0.0f, 0.0f, 1.0f};  ///< `direction`: unit.
  float from_m = 0.0f, to_m = std::numeric_limits<float>::infinity();
  float time = 0.0f;  ///< Time of moving geometry, 0 to 1.
};

struct Hit {
  float distance_m = 0.0f;
  std::uint32_t place = 0;     ///< Index in the places passed to `place`.
  std::uint32_t triangle = 0;  ///< Index in the mesh.
  float u = 0.0f, v = 0.0f;    ///< Barycentric weights of its second and third corner.
};

/// Eight rays are traced at once, in less than half of the time that they take one by one where they begin alike. The
/// set of active rays may change the last digit of a hit, so a picture is reproduced only by the same packets.
inline constexpr std::size_t packet_size = 8;
template <typename Value>
using Packet = std::array<Value, packet_size>;

struct RayPacket {
  Vec8 origin_m, direction;
  Float8 from_m, to_m, time;

  void set(std::size_t n, const Ray& ray) {
    origin_m.set(n, ray.origin_m), direction.set(n, ray.direction);
    from_m[n] = ray.from_m, to_m[n] = ray.to_m, time[n] = ray.time;
  }
  Ray operator[](std::size_t n) const { return {origin_m[n], direction[n], from_m[n], to_m[n], time[n]}; }
};

struct HitPacket {
  Float8 distance_m, u, v;
  Bits8 place, triangle;

  Hit operator[](std::size_t n) const { return {distance_m[n], place[n], triangle[n], u[n], v[n]}; }
};

/// Origin of a ray: the eye, or a surface that is lit. The latter also meets geometry that for the eye only throws a
/// shadow, such as the driver's car.
enum class From : std::uint8_t { eye, surface };

/// Coherence of a packet: rays side by side from the eye, or rays that begin anywhere, on surfaces.
enum class Together : std::uint8_t { side_by_side, anywhere };

/// Placement of a mesh: a vertex is at origin_m + turn · position_m.
struct Place {
  std::uint32_t mesh = 0;
  glm::vec3 origin_m{0.0f};
  glm::mat3 turn{1.0f};
  bool seen = true;                ///< False: invisible to the eye, but lit and mirrored, and throws a shadow.
  std::optional<Motion> motion{};  ///< Motion from here, which is time 0.
  instant::LevelFade fade{};       ///< Level of detail: rays whose threshold lies outside it pass.
  bool casts_shadow = true;        ///< False: throws no shadow either, if it is not seen.
};

/// Transparency of surfaces: queried for meshes with holes or glass.
class Openings {
 public:
  virtual ~Openings() = default;
  /// True where a ray passes as if there were no surface.
  virtual bool is_hole(std::uint32_t place, std::uint32_t triangle, float u, float v) const = 0;
  /// Share of a shadow ray's light that passes in this (unit) direction.
  virtual float share_let_through(std::uint32_t place, std::uint32_t triangle, float u, float v,
                                  const glm::vec3& direction) const = 0;
};

/// Rays between two calls of `Geometry::place`: of many, what hastens each of them is built anew; for few, hierarchies of
/// meshes are kept, and a ray takes longer. A hit may differ between the two in its last digits.
enum class Rays : std::uint8_t { many, few };

class Geometry {
 public:
  /// Error: Embree does not start on this machine.
  static Expected<Geometry> create(Rays rays = Rays::many);
  Geometry(Geometry&&) noexcept;
  Geometry& operator=(Geometry&&) noexcept;
  ~Geometry();

  /// Adds the next mesh, counted from 0. Vertices and indices are not copied; they outlive the geometry or the call of
  /// `keep`. `open`: `Openings` is queried about it. `later`: its vertices at time 1; empty: they do not move.
  /// Triangles whose corners do not exist are the caller's bug.
  void add_mesh(std::span<const scene::SurfaceVertex> vertices, std::span<const std::uint32_t> indices, bool open,
                std::span<const scene::SurfaceVertex> later = {});
  /// Adds the next mesh, of which it takes a share: `mesh` is not null. With `Rays::few` its hierarchy is kept for the next
  /// time that the same one is added, as long as somebody else holds it.
  void add_mesh(const std::shared_ptr<const scene::SurfaceMesh>& mesh, bool open);
  /// Removes all meshes but the first `count`.
  void keep(std::size_t count);
  /// Replaces all places. `openings` outlives the queries.
  void place(std::span<const Place> places, const Openings* openings);

  /// Finds the first visible surface along the ray.
  bool intersect(const Ray& ray, Hit& hit, From from = From::eye) const {
    return intersect(begin_of(ray), way_of(ray), ray.to_m, from, hit);
  }
  /// Share of the light that comes along the ray from its far end, which is not before its beginning.
  float unshadowed(const Ray& ray) const { return unshadowed(begin_of(ray), way_of(ray), ray.to_m); }

  /// Same queries for the rays whose bit is set in `which`. Returns the bits of those that hit a surface; the other
  /// hits are unspecified.
  std::uint32_t intersect(std::uint32_t which, const RayPacket& rays, Together together, HitPacket& hits) const;
  Float8 unshadowed(std::uint32_t which, const RayPacket& rays) const;

 private:
  struct Parts;
  // Four numbers in a register: numbers stored singly and loaded at once, as Embree does, stall a processor.
  using Four = float __attribute__((vector_size(16)));
  static Four begin_of(const Ray& ray) { return Four{ray.origin_m.x, ray.origin_m.y, ray.origin_m.z, ray.from_m}; }
  static Four way_of(const Ray& ray) { return Four{ray.direction.x, ray.direction.y, ray.direction.z, ray.time}; }
  bool intersect(Four begin, Four way, float to_m, From from, Hit& hit) const;
  float unshadowed(Four begin, Four way, float to_m) const;
  explicit Geometry(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace septet::raytrace
