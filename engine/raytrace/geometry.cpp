#include "engine/raytrace/geometry.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>
#include <fmt/core.h>

#include "engine/core/check.hpp"

namespace septet::raytrace {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using Scene = std::unique_ptr<RTCSceneTy, SceneRelease>;

struct Mesh {
  std::span<const scene::SurfaceVertex> vertices;
  std::span<const std::uint32_t> indices;
  bool open = false;
  std::span<const scene::SurfaceVertex> later;  ///< Vertices at time 1; empty: they do not move.
  Scene scene, fading;                          ///< Hierarchies without and with level fades; null until placed so.
  std::shared_ptr<const scene::SurfaceMesh> held{};  ///< Owner of vertices and indices, if they are shared.
};

/// One instruction set on every processor: hierarchies and rounding differ between them, and the machines of a film
/// draw one picture. Septet is compiled for the same one (SEPTET_ARCHITECTURE); wider vectors were no faster
/// (trace/cornell, trace/motorway).
constexpr const char* device_options = "threads=1,isa=avx2";

/// State of a place that a filter reads.
struct Standing {
  instant::LevelFade fade;
  bool open = false;  ///< True if its mesh is.
};

/// Context of a query's filter; begins as Embree's own context does.
struct Query {
  RTCIntersectContext context;
  const Openings* openings;
  const std::vector<Standing>* standing;
  const float* thresholds;  ///< Level-of-detail thresholds of its rays, see instant::LevelFade.
  float* let_through;       ///< Shares of light of its rays.

  Query(const Openings* asked, const std::vector<Standing>& places, const float* levels, float* shares)
      : openings(asked), standing(&places), thresholds(levels), let_through(shares) {
    rtcInitIntersectContext(&context);
  }
};

/// Hash of a ray's direction to [0, 1), sensitive to any change: neighbouring rays see different levels, and one ray
/// the same level of all fading meshes.
float threshold_of(float x, float y, float z) {
  std::uint32_t mixed = 0;
  for (const float part : {x, y, z}) {
    mixed = (mixed ^ std::bit_cast<std::uint32_t>(part)) * 0x9e3779b1u;
    mixed ^= mixed >> 15;
  }
  mixed *= 0x85ebca77u;
  return static_cast<float>((mixed ^ (mixed >> 13)) >> 8) * 0x1p-24f;
}

std::uint32_t place_of(const RTCFilterFunctionNArguments* args, unsigned n) {
  // A mesh that was moved lies in the scene itself, under the number of its place.
  const unsigned instance = RTCHitN_instID(args->hit, args->N, n, 0);
  return instance != RTC_INVALID_GEOMETRY_ID ? instance : RTCHitN_geomID(args->hit, args->N, n);
}

void pass_holes(const RTCFilterFunctionNArguments* args) {
  const auto* query = reinterpret_cast<const Query*>(args->context);
  for (unsigned n = 0; n < args->N; ++n) {
    if (!args->valid[n]) continue;
    const std::uint32_t place = place_of(args, n);
    const Standing& standing = (*query->standing)[place];
    if (!standing.fade.shows(query->thresholds[n]) ||
        (standing.open && query->openings->is_hole(place, RTCHitN_primID(args->hit, args->N, n),
                                                   RTCHitN_u(args->hit, args->N, n), RTCHitN_v(args->hit, args->N, n))))
      args->valid[n] = 0;
  }
}

void weaken_light(const RTCFilterFunctionNArguments* args) {
  const auto* query = reinterpret_cast<const Query*>(args->context);
  for (unsigned n = 0; n < args->N; ++n) {
    if (!args->valid[n]) continue;
    const std::uint32_t place = place_of(args, n);
    const Standing& standing = (*query->standing)[place];
    const bool shows = standing.fade.shows(query->thresholds[n]);
    if (!shows) args->valid[n] = 0;
    if (!shows || !standing.open) continue;
    const glm::vec3 direction(RTCRayN_dir_x(args->ray, args->N, n), RTCRayN_dir_y(args->ray, args->N, n),
                              RTCRayN_dir_z(args->ray, args->N, n));
    float& let_through = query->let_through[n];
    let_through *= query->openings->share_let_through(place, RTCHitN_primID(args->hit, args->N, n),
                                                      RTCHitN_u(args->hit, args->N, n),
                                                      RTCHitN_v(args->hit, args->N, n), direction);
    if (let_through > 1e-3f) args->valid[n] = 0;
  }
}

/// Makes an Embree geometry of a mesh. `moved`: its vertices' positions, if not the mesh's own. Both outlive the
/// geometry.
RTCGeometry triangles_of(RTCDevice device, const Mesh& mesh, bool fades, std::span<const glm::vec3> moved = {}) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!mesh.later.empty()) {
    rtcSetGeometryTimeStepCount(geometry, 2);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 1, RTC_FORMAT_FLOAT3, mesh.later.data(),
                               offsetof(scene::SurfaceVertex, position_m), sizeof(scene::SurfaceVertex),
                               mesh.later.size());
  }
  if (moved.empty())
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(),
                               offsetof(scene::SurfaceVertex, position_m), sizeof(scene::SurfaceVertex),
                               mesh.vertices.size());
  else
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, moved.data(), 0,
                               sizeof(glm::vec3), mesh.vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                             3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
  if (mesh.open || fades) {
    rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, weaken_light);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

void set_place(RTCGeometry instance, const Place& place) {
  if (!place.motion) {
    const glm::mat3& t = place.turn;
    const glm::vec3& o = place.origin_m;
    const float columns[12] = {t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z, o.x, o.y, o.z};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    return;
  }
  rtcSetGeometryTimeStepCount(instance, 2);
  for (unsigned step = 0; step < 2; ++step) {
    const Motion::Key& key = place.motion->keys()[step];
    RTCQuaternionDecomposition d{};
    d.scale_x = key.stretch.x, d.scale_y = key.stretch.y, d.scale_z = key.stretch.z;
    d.quaternion_r = key.turn.w, d.quaternion_i = key.turn.x, d.quaternion_j = key.turn.y, d.quaternion_k = key.turn.z;
    d.translation_x = key.origin_m.x, d.translation_y = key.origin_m.y, d.translation_z = key.origin_m.z;
    rtcSetGeometryTransformQuaternion(instance, step, &d);
  }
}

/// Sets a ray from `begin`, a position and the near end, and `way`, a direction and the time.
template <typename Four>
void set_ray(RTCRay& ray, const Four& begin, const Four& way, float to_m, unsigned mask) {
  std::memcpy(&ray.org_x, &begin, sizeof begin);
  std::memcpy(&ray.dir_x, &way, sizeof way);
  ray.tfar = to_m;
  ray.mask = mask;
  ray.id = 0;
  ray.flags = 0;
}

void set_rays(RTCRay8& to, const RayPacket& rays, unsigned mask) {
  const auto put = [](float* row, Float8 numbers) { std::memcpy(row, &numbers, sizeof numbers); };
  put(to.org_x, rays.origin_m.x), put(to.org_y, rays.origin_m.y), put(to.org_z, rays.origin_m.z);
  put(to.dir_x, rays.direction.x), put(to.dir_y, rays.direction.y), put(to.dir_z, rays.direction.z);
  put(to.tnear, rays.from_m), put(to.tfar, rays.to_m), put(to.time, rays.time);
  std::fill_n(to.mask, packet_size, mask);
  std::fill_n(to.id, packet_size, 0u);
  std::fill_n(to.flags, packet_size, 0u);
}

template <typename Eight, typename Number>
Eight eight_of(const Number* row) {
  static_assert(sizeof(Eight) == packet_size * sizeof(Number));
  Eight numbers;
  std::memcpy(&numbers, row, sizeof numbers);
  return numbers;
}

/// Ray masks: one hierarchy serves all rays where Embree was built with masks; without them no ray from a surface meets
/// invisible geometry.
constexpr unsigned for_seeing = 1, for_shadows = 2, for_paths = 4;
unsigned mask_of(const Place& place) {
  if (place.seen) return for_seeing | for_shadows | for_paths;
  return place.casts_shadow ? for_shadows | for_paths : for_paths;
}
unsigned mask_of(From from) { return from == From::eye ? for_seeing : for_paths; }

/// Meshes that keep their place while the shutter is open are copied to it, not instanced: one hierarchy of all
/// triangles lets a ray pass near a mesh without a visit, where the boxes of instances overlap (trace/motorway: 1.35
/// times as many samples a second). But that hierarchy is built for each instant (0.25 s a million triangles), hence
/// these limits; a motorway with 200 vehicles has 168,000.
constexpr std::size_t most_moved_of_mesh = 50'000, most_moved = 500'000;

}  // namespace

struct Geometry::Parts {
  Device device;
  Rays rays = Rays::many;
  std::vector<Mesh> meshes;
  std::vector<Mesh> kept{};                     ///< Shared meshes that were removed, with their hierarchies.
  Scene seen, shadows;                          ///< More meshes throw shadows than are seen.
  std::vector<std::vector<glm::vec3>> moved{};  ///< Positions by place, if they were moved.
  std::vector<Standing> standing{};             ///< State by place.
  const Openings* openings = nullptr;
  bool has_masks = false;
  bool fades = false;  ///< True if some place does.

  Packet<float> thresholds(const RayPacket& rays) const {
    Packet<float> thresholds{};
    if (!fades) return thresholds;
    const Vec8& way = rays.direction;
    for (std::size_t n = 0; n < packet_size; ++n) thresholds[n] = threshold_of(way.x[n], way.y[n], way.z[n]);
    return thresholds;
  }

  /// Mesh's own hierarchy, for instances.
  RTCScene hierarchy(Mesh& mesh, bool is_fading) {
    Scene& scene = is_fading ? mesh.fading : mesh.scene;
    if (scene) return scene.get();
    scene.reset(rtcNewScene(device.get()));
    RTCGeometry geometry = triangles_of(device.get(), mesh, is_fading);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene.get();
  }

  void move(std::span<const Place> places) {
    moved.clear();
    moved.resize(places.size());
    std::size_t triangles = 0;
    for (std::size_t n = 0; n < places.size(); ++n) {
      const Mesh& mesh = meshes[places[n].mesh];
      if (rays == Rays::few) continue;
      const std::size_t here = mesh.indices.size() / 3;
      if (places[n].motion || !mesh.later.empty() || here > most_moved_of_mesh || triangles + here > most_moved)
        continue;
      triangles += here;
      moved[n].reserve(mesh.vertices.size() + 1);
      for (const scene::SurfaceVertex& vertex : mesh.vertices)
        moved[n].push_back(places[n].origin_m + places[n].turn * vertex.position_m);
      moved[n].emplace_back();  // Embree reads a vertex as four numbers.
    }
  }

  Scene build(std::span<const Place> places, unsigned wanted) {
    Scene scene(rtcNewScene(device.get()));
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (!(mask_of(places[n]) & wanted)) continue;
      Mesh& mesh = meshes[places[n].mesh];
      if (mesh.indices.empty()) continue;
      RTCGeometry geometry = nullptr;
      if (!moved[n].empty()) {
        geometry = triangles_of(device.get(), mesh, !places[n].fade.all(), moved[n]);
      } else {
        geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, hierarchy(mesh, !places[n].fade.all()));
        set_place(geometry, places[n]);
      }
      rtcSetGeometryMask(geometry, mask_of(places[n]));
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(scene.get(), geometry, static_cast<unsigned>(n));
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene.get());
    return scene;
  }
};

Geometry::Geometry(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;
Geometry::~Geometry() = default;

Expected<Geometry> Geometry::create(Rays rays) {
  auto parts = std::make_unique<Parts>();
  parts->rays = rays;
  parts->device.reset(rtcNewDevice(device_options));
  if (!parts->device)
    return failure(fmt::format("Embree does not start (error {})", static_cast<int>(rtcGetDeviceError(nullptr))),
                   "ray tracer", "use a processor with AVX2, or --renderer raster");
  if (!rtcGetDeviceProperty(parts->device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED))
    return failure("this Embree was built without packets of eight rays", "ray tracer",
                   "install Debian's libembree3-3, or use --renderer raster");
  parts->has_masks = rtcGetDeviceProperty(parts->device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) != 0;
  return Geometry(std::move(parts));
}

void Geometry::add_mesh(std::span<const scene::SurfaceVertex> vertices, std::span<const std::uint32_t> indices,
                        bool open, std::span<const scene::SurfaceVertex> later) {
  SEPTET_CHECK(later.empty() || later.size() == vertices.size(), "{} vertices, then {}", vertices.size(), later.size());
  SEPTET_CHECK(indices.size() % 3 == 0, "{} indices", indices.size());
  parts_->meshes.push_back({vertices, indices, open, later, nullptr, nullptr});
}

void Geometry::add_mesh(const std::shared_ptr<const scene::SurfaceMesh>& mesh, bool open) {
  const auto known =
      std::ranges::find_if(parts_->kept, [&](const Mesh& kept) { return kept.held == mesh && kept.open == open; });
  if (known != parts_->kept.end()) {
    parts_->meshes.push_back(std::move(*known));
    parts_->kept.erase(known);
    return;
  }
  add_mesh(mesh->vertices, mesh->indices, open);
  parts_->meshes.back().held = mesh;
}

void Geometry::keep(std::size_t count) {
  parts_->seen.reset();
  parts_->shadows.reset();
  if (parts_->rays == Rays::few) {
    for (std::size_t n = count; n < parts_->meshes.size(); ++n)
      if (parts_->meshes[n].held) parts_->kept.push_back(std::move(parts_->meshes[n]));
    std::erase_if(parts_->kept, [](const Mesh& kept) { return kept.held.use_count() == 1; });
  }
  parts_->meshes.resize(std::min(count, parts_->meshes.size()));
}

void Geometry::place(std::span<const Place> places, const Openings* openings) {
  for (const Place& place : places)
    SEPTET_CHECK(place.mesh < parts_->meshes.size(), "mesh {} of {}", place.mesh, parts_->meshes.size());
  parts_->openings = openings;
  parts_->standing.clear();
  for (const Place& place : places) parts_->standing.push_back({place.fade, parts_->meshes[place.mesh].open});
  parts_->fades = std::ranges::any_of(places, [](const Place& place) { return !place.fade.all(); });
  parts_->seen.reset();
  parts_->shadows.reset();
  parts_->move(places);
  parts_->seen = parts_->build(places, parts_->has_masks ? for_seeing | for_shadows | for_paths : for_seeing);
  if (parts_->has_masks || std::ranges::all_of(places, &Place::seen)) {
    rtcRetainScene(parts_->seen.get());
    parts_->shadows.reset(parts_->seen.get());
  } else {
    parts_->shadows = parts_->build(places, for_shadows);
  }
}

bool Geometry::intersect(Four begin, Four way, float to_m, From from, Hit& hit) const {
  const float threshold = parts_->fades ? threshold_of(way[0], way[1], way[2]) : 0.0f;
  Query query(parts_->openings, parts_->standing, &threshold, nullptr);
  RTCRayHit found;
  set_ray(found.ray, begin, way, to_m, mask_of(from));
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(parts_->seen.get(), &query.context, &found);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const bool placed = found.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  hit = {found.ray.tfar, placed ? found.hit.instID[0] : found.hit.geomID, found.hit.primID, found.hit.u, found.hit.v};
  return true;
}

float Geometry::unshadowed(Four begin, Four way, float to_m) const {
  const float threshold = parts_->fades ? threshold_of(way[0], way[1], way[2]) : 0.0f;
  float let_through = 1.0f;
  Query query(parts_->openings, parts_->standing, &threshold, &let_through);
  RTCRay found;
  set_ray(found, begin, way, to_m, for_shadows);
  rtcOccluded1(parts_->shadows.get(), &query.context, &found);
  return found.tfar < 0.0f ? 0.0f : let_through;
}

std::uint32_t Geometry::intersect(std::uint32_t which, const RayPacket& rays, Together together,
                                  HitPacket& hits) const {
  const Packet<float> thresholds = parts_->thresholds(rays);
  Query query(parts_->openings, parts_->standing, thresholds.data(), nullptr);
  query.context.flags =
      together == Together::side_by_side ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  const Int8 valid = truths_of(which);
  RTCRayHit8 found;
  set_rays(found.ray, rays, mask_of(together == Together::side_by_side ? From::eye : From::surface));
  std::fill_n(found.hit.geomID, packet_size, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(found.hit.instID[0], packet_size, RTC_INVALID_GEOMETRY_ID);
  rtcIntersect8(reinterpret_cast<const int*>(&valid), parts_->seen.get(), &query.context, &found);
  const Bits8 none = std::bit_cast<Bits8>(eight(static_cast<std::int32_t>(RTC_INVALID_GEOMETRY_ID)));
  const Bits8 geometry = eight_of<Bits8>(found.hit.geomID), instance = eight_of<Bits8>(found.hit.instID[0]);
  hits = {eight_of<Float8>(found.ray.tfar), eight_of<Float8>(found.hit.u), eight_of<Float8>(found.hit.v),
          instance != none ? instance : geometry, eight_of<Bits8>(found.hit.primID)};
  return bits_of(geometry != none) & which;
}

Float8 Geometry::unshadowed(std::uint32_t which, const RayPacket& rays) const {
  alignas(Float8) Packet<float> shares;
  shares.fill(1.0f);
  const Packet<float> thresholds = parts_->thresholds(rays);
  Query query(parts_->openings, parts_->standing, thresholds.data(), shares.data());
  const Int8 valid = truths_of(which);
  RTCRay8 found;
  set_rays(found, rays, for_shadows);
  rtcOccluded8(reinterpret_cast<const int*>(&valid), parts_->shadows.get(), &query.context, &found);
  return eight_of<Float8>(found.tfar) < 0.0f ? Float8{} : eight_of<Float8>(shares.data());
}

}  // namespace septet::raytrace
