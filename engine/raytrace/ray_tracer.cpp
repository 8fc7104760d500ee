#include "engine/raytrace/ray_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/check.hpp"

namespace septet::raytrace {
namespace {

/// Offset from a pixel's middle, pixels.
glm::vec2 filtered_offset(Filter filter, PathRandom& random) {
  const int degree = static_cast<int>(filter);
  glm::vec2 sum(-0.5f * static_cast<float>(degree + 1));
  for (int n = 0; n <= degree; ++n) sum += random.pair();
  return sum;
}

/// Rays of one view: from the world's origin, the first view's eye, along the world's axes.
struct Camera {
  /// Direction of a ray: middle + right · x + down · y, pixels from the viewport's corner.
  glm::vec3 eye_m, middle, right, down;
  glm::vec3 lens_right, lens_up, ahead;
  instant::PixelRectangle viewport;

  Camera(const instant::FrameView& view, const Vec3& origin_m) : viewport(view.viewport) {
    const instant::OffAxisView& p = view.projection;
    const Quat turn = view.world_from_car.orientation;
    const double width = p.right_slope - p.left_slope, height = p.top_slope - p.bottom_slope;
    const double first = view.mirrored ? p.right_slope : p.left_slope, way = view.mirrored ? -width : width;
    eye_m = glm::vec3(instant::world_eye(view) - origin_m);
    middle = glm::vec3(turn * (first * p.right + p.top_slope * p.up - p.back));
    right = glm::vec3(turn * (way / view.viewport.width * p.right));
    down = glm::vec3(turn * (-height / view.viewport.height * p.up));
    lens_right = glm::vec3(turn * p.right), lens_up = glm::vec3(turn * p.up), ahead = glm::vec3(turn * -p.back);
  }

  /// Interpolation towards another camera of the same viewport.
  Camera towards(const Camera& later, float time) const {
    Camera camera = *this;
    for (const auto part : {&Camera::eye_m, &Camera::middle, &Camera::right, &Camera::down, &Camera::lens_right,
                            &Camera::lens_up, &Camera::ahead})
      camera.*part = glm::mix(this->*part, later.*part, time);
    return camera;
  }
  bool shows(std::int64_t x, std::int64_t y) const {
    return x >= viewport.x && y >= viewport.y && x < viewport.x + std::int64_t{viewport.width} &&
           y < viewport.y + std::int64_t{viewport.height};
  }
  /// Picture position of a direction from the eye, pixels; null: behind it.
  std::optional<glm::vec2> seen_at(const glm::vec3& way) const {
    const float distance = glm::dot(way, ahead);
    if (!(distance > 1e-6f * glm::length(way))) return std::nullopt;
    const glm::vec3 off = way / distance - middle;
    return glm::vec2(viewport.x, viewport.y) +
           glm::vec2(glm::dot(off, right) / glm::dot(right, right), glm::dot(off, down) / glm::dot(down, down));
  }
  Ray ray(const glm::vec2& at_px, const TraceSettings& settings, PathRandom& random) const {
    Ray ray;
    const glm::vec3 way =
        middle + right * (at_px.x - static_cast<float>(viewport.x)) + down * (at_px.y - static_cast<float>(viewport.y));
    ray.origin_m = eye_m;
    if (settings.lens_radius_m <= 0.0f) {
      ray.direction = glm::normalize(way);
      return ray;
    }
    const glm::vec3 focus = way * (settings.focus_m / glm::dot(way, ahead));
    const glm::vec2 u = random.pair();
    const float radius_m = settings.lens_radius_m * std::sqrt(u.x), azimuth_rad = 2.0f * pi * u.y;
    const glm::vec3 on_lens =
        lens_right * (radius_m * std::cos(azimuth_rad)) + lens_up * (radius_m * std::sin(azimuth_rad));
    ray.origin_m += on_lens;
    ray.direction = glm::normalize(focus - on_lens);
    return ray;
  }
};

ClearBody clear_body(const ice::IceBody& ice, const ice::IceBody* later) {
  ClearBody body{ice.origin_m, {}, light::out_of_ice, ice.look.absorption_per_m};
  for (const ice::IceVertex& vertex : ice.vertices) body.vertices.push_back({vertex.position_m, vertex.normal, {}});
  if (!later || later->vertices.size() != ice.vertices.size()) return body;
  const Vec3 way_m = later->origin_m - ice.origin_m;
  if (glm::length(way_m) < longest_way_m)
    for (const ice::IceVertex& vertex : later->vertices)
      body.later.push_back({vertex.position_m + glm::vec3(way_m), vertex.normal, {}});
  return body;
}

glm::vec2 motion_px(const Camera& camera, const Camera& later, const FirstSeen& first, const glm::vec3& direction) {
  const bool sky = first.object == 0;
  const auto from = camera.seen_at(sky ? direction : first.from_m - camera.eye_m),
             to = later.seen_at(sky ? direction : first.to_m - later.eye_m);
  return from && to ? *to - *from : glm::vec2(0.0f);
}

/// Sums of a pixel's samples so far, in their order.
struct PixelSums {
  TracedPixel sums;
  double light = 0.0, squares = 0.0;

  void add(const PathStart& path, const Camera& camera, const Camera* later, float motion_scale) {
    glm::vec3 radiance = path.radiance;
    if (!std::isfinite(radiance.x + radiance.y + radiance.z)) {
      radiance = glm::vec3(0.0f);
      ++sums.bad_samples;
    }
    const FirstSeen& first = path.first;
    sums.radiance += radiance, sums.normal += first.normal, sums.albedo += first.albedo;
    if (sums.samples == 0)
      sums.depth_m = first.distance_m, sums.object = first.object, sums.participant = first.participant;
    if (first.asks_way) sums.motion_px = motion_scale * motion_px(camera, *later, first, path.ray.direction);
    const double luminous = luminance(radiance);
    light += luminous, squares += luminous * luminous;
    ++sums.samples;
  }
  /// Mean of the samples.
  TracedPixel pixel() const {
    TracedPixel pixel = sums;
    const float share = 1.0f / static_cast<float>(std::max(1u, sums.samples));
    pixel.radiance *= share, pixel.normal *= share, pixel.albedo *= share;
    if (const double n = sums.samples; n > 1.0)
      pixel.variance = static_cast<float>(std::max(0.0, squares - light * light / n) / (n * (n - 1.0)));
    return pixel;
  }
};

/// Adds samples from `first_sample` on until the pixel has `samples`.
void add_samples(PixelSums& pixel, const World& world, const Camera& camera, const Camera* later,
                 const TraceSettings& settings, std::uint32_t x, std::uint32_t y, std::uint32_t samples,
                 std::uint32_t first_sample) {
  const TracedPixel& sums = pixel.sums;
  const std::uint64_t of_pixel = PathRandom::of_pixel(settings.seed, x, y);
  const bool blurs = later && settings.blurs;
  constexpr std::uint32_t size = packet_size;
  while (sums.samples < samples) {
    // Packets hold the same samples for any subset wanted: a sample never depends on how a picture is divided.
    const std::uint32_t next = first_sample + sums.samples, first = next % size, packet = next - first;
    const std::uint32_t end = std::min(size, first + samples - sums.samples);
    const std::uint32_t begun = std::clamp(std::max(settings.samples, packet) - packet, end, size);
    Packet<PathStart> starts;
    for (std::uint32_t n = 0; n < begun; ++n) {
      PathStart& start = starts[n];
      start.random = PathRandom(of_pixel, packet + n);
      const glm::vec2 at = glm::vec2(x, y) + 0.5f + filtered_offset(settings.filter, start.random);
      const float time = blurs ? start.random.uniform() : 0.0f;
      start.ray =
          blurs ? camera.towards(*later, time).ray(at, settings, start.random) : camera.ray(at, settings, start.random);
      start.ray.time = time;
    }
    starts[first].first.asks_way = later && sums.samples == 0;
    trace_paths(world, settings.paths, (1u << begun) - 1u, (1u << end) - (1u << first), starts);
    for (std::uint32_t n = first; n < end; ++n) pixel.add(starts[n], camera, later, settings.motion_scale);
  }
}

constexpr std::int64_t block_side_px = 4;
constexpr std::uint32_t first_samples = 16;

}  // namespace

void TracedPicture::put(const Bucket& bucket) {
  const instant::PixelRectangle& at = bucket.rectangle;
  SEPTET_CHECK(at.x >= 0 && at.y >= 0 && at.x + at.width <= width && at.y + at.height <= height,
               "bucket at {}, {} of {} × {} pixels in a picture of {} × {}", at.x, at.y, at.width, at.height, width,
               height);
  for (std::uint32_t y = 0; y < at.height; ++y)
    std::copy_n(bucket.pixels.begin() + std::int64_t{y} * at.width, at.width,
                pixels.begin() + (std::int64_t{at.y} + y) * width + at.x);
  for (const TracedPixel& pixel : bucket.pixels) bad_samples += pixel.bad_samples;
}

std::vector<instant::PixelRectangle> buckets_of(std::uint32_t width, std::uint32_t height, std::uint32_t side_px) {
  SEPTET_CHECK(side_px > 0, "buckets of {} pixels", side_px);
  std::vector<instant::PixelRectangle> buckets;
  for (std::uint32_t y = 0; y < height; y += side_px)
    for (std::uint32_t x = 0; x < width; x += side_px)
      buckets.push_back({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), std::min(side_px, width - x),
                         std::min(side_px, height - y)});
  return buckets;
}

TracedPixel joined(std::span<const TracedPixel> sets) {
  if (sets.size() == 1) return sets.front();
  TracedPixel all;
  double light = 0.0;
  for (const TracedPixel& set : sets) {
    if (set.samples == 0) continue;
    if (all.samples == 0)
      all.depth_m = set.depth_m, all.object = set.object, all.participant = set.participant,
      all.motion_px = set.motion_px;
    const auto n = static_cast<float>(set.samples);
    all.radiance += n * set.radiance, all.normal += n * set.normal, all.albedo += n * set.albedo;
    all.samples += set.samples, all.bad_samples += set.bad_samples;
    light += double{n} * double{luminance(set.radiance)};
  }
  if (all.samples == 0) return all;
  const double count = all.samples, mean = light / count;
  const auto share = static_cast<float>(1.0 / count);
  all.radiance *= share, all.normal *= share, all.albedo *= share;
  // Variance within the sets, and between them.
  double squares = 0.0;
  for (const TracedPixel& set : sets) {
    const double n = set.samples, off = double{luminance(set.radiance)} - mean;
    squares += double{set.variance} * n * (n - 1.0) + n * off * off;
  }
  if (all.samples > 1) all.variance = static_cast<float>(squares / (count * (count - 1.0)));
  return all;
}

float relative_error(const TracedPixel& pixel, const instant::Exposure& exposure) {
  return std::sqrt(pixel.variance) / std::max(luminance(pixel.radiance), 0.1f / exposure.scale());
}

struct RayTracer::Parts {
  const scene::ResolvedScene& scene;
  SceneIndex index;
  Geometry geometry;
  TraceSettings settings{};
  instant::Instant instant{};
  std::vector<ClearBody> bodies{};
  std::unique_ptr<World> world{};
  std::unique_ptr<PhotonLights> photon_lights{};
  PhotonMaps photons{};
  std::vector<Camera> cameras{}, later_cameras{};  ///< `later_cameras`: none, or as many.
  std::vector<std::uint8_t> cloud_noise = instant::cloud_noise();

  /// Camera that shows this pixel; a later view lies over an earlier one. Null: none.
  const Camera* camera_at(std::int64_t x, std::int64_t y) const {
    const auto found = std::find_if(cameras.rbegin(), cameras.rend(), [&](const Camera& c) { return c.shows(x, y); });
    return found == cameras.rend() ? nullptr : &*found;
  }
  void refine(PixelSums& pixel, std::int64_t x, std::int64_t y, std::uint32_t samples,
              std::uint32_t first_sample = 0) const {
    if (const Camera* camera = camera_at(x, y))
      add_samples(pixel, *world, *camera,
                  later_cameras.empty() ? nullptr : &later_cameras[static_cast<std::size_t>(camera - cameras.data())],
                  settings, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), samples, first_sample);
  }
  void trace_block(std::int64_t left, std::int64_t top, Bucket& bucket) const;
};

/// Traces the whole block with this upper left pixel and stores the part inside the bucket.
void RayTracer::Parts::trace_block(std::int64_t left, std::int64_t top, Bucket& bucket) const {
  std::array<PixelSums, block_side_px * block_side_px> block{};
  std::uint32_t samples = std::min(first_samples, settings.samples);
  while (true) {
    double squares = 0.0, shown = 0.0;
    for (std::int64_t n = 0; n < block_side_px * block_side_px; ++n) {
      PixelSums& pixel = block[static_cast<std::size_t>(n)];
      refine(pixel, left + n % block_side_px, top + n / block_side_px, samples);
      if (pixel.sums.samples == 0) continue;
      const double error = relative_error(pixel.pixel(), instant.exposure);
      squares += error * error, ++shown;
    }
    const double short_by = shown > 0.0 ? squares / shown / (double{settings.error} * settings.error) : 0.0;
    if (!(short_by > 1.0) || samples >= settings.samples) break;
    // Estimate of the samples needed, which may be a bad one: at most twice as many as there are.
    const double wanted = samples * std::min(short_by, 2.0);
    samples = std::min(settings.samples, std::max(samples + 4, static_cast<std::uint32_t>(wanted)));
  }
  const instant::PixelRectangle& at = bucket.rectangle;
  for (std::int64_t n = 0; n < block_side_px * block_side_px; ++n) {
    const std::int64_t x = left + n % block_side_px - at.x, y = top + n / block_side_px - at.y;
    if (x >= 0 && y >= 0 && x < at.width && y < at.height)
      bucket.pixels[static_cast<std::size_t>(y * at.width + x)] = block[static_cast<std::size_t>(n)].pixel();
  }
}

RayTracer::RayTracer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;
RayTracer::~RayTracer() = default;

Expected<RayTracer> RayTracer::create(const scene::ResolvedScene& scene) {
  auto geometry = Geometry::create();
  if (!geometry) return tl::unexpected(geometry.error());
  SceneIndex index(scene);
  for (std::size_t n = 0; n < scene.meshes.size(); ++n)
    geometry->add_mesh(scene.meshes[n].vertices, scene.meshes[n].indices, index.open[n]);
  return RayTracer(std::unique_ptr<Parts>(new Parts{scene, std::move(index), std::move(*geometry)}));
}

void RayTracer::begin(instant::Instant instant, const TraceSettings& settings, std::vector<ClearBody> bodies,
                      const instant::Instant* later) {
  Parts& p = *parts_;
  p.photon_lights.reset();
  p.world.reset();
  p.settings = settings;
  p.instant = std::move(instant);
  p.bodies = std::move(bodies);
  for (std::size_t n = 0; n < p.instant.ice.size(); ++n) {
    const bool same = later && later->ice.size() == p.instant.ice.size();
    p.bodies.push_back(clear_body(p.instant.ice[n], same ? &later->ice[n] : nullptr));
  }
  p.world = std::make_unique<World>(p.scene, p.index, p.instant, later, p.bodies, p.cloud_noise, p.geometry);
  p.photons = {};
  p.photon_lights = std::make_unique<PhotonLights>(*p.world, settings.photons, settings.seed, settings.paths.longest,
                                                   later && settings.blurs);
  p.cameras.clear();
  p.later_cameras.clear();
  for (const instant::FrameView& view : p.instant.views) p.cameras.emplace_back(view, p.world->origin_m());
  if (later && later->views.size() == p.instant.views.size())
    for (const instant::FrameView& view : later->views) p.later_cameras.emplace_back(view, p.world->origin_m());
}

std::vector<PhotonBucket> RayTracer::photon_buckets() const {
  SEPTET_CHECK(parts_->photon_lights, "no instant was begun");
  const PhotonLights& lights = *parts_->photon_lights;
  return raytrace::photon_buckets(lights.count(PhotonKind::caustic), lights.count(PhotonKind::global));
}

std::vector<Photon> RayTracer::trace_photons(const PhotonBucket& bucket) const {
  SEPTET_CHECK(parts_->photon_lights, "no instant was begun");
  return parts_->photon_lights->trace(bucket);
}

void RayTracer::set_photons(std::span<const std::vector<Photon>> of_buckets) {
  Parts& p = *parts_;
  const auto buckets = photon_buckets();
  SEPTET_CHECK(of_buckets.size() == buckets.size(), "photons of {} buckets of {}", of_buckets.size(), buckets.size());
  std::vector<Photon> caustic, global;
  for (std::size_t n = 0; n < buckets.size(); ++n) {
    std::vector<Photon>& all = buckets[n].kind == PhotonKind::caustic ? caustic : global;
    all.insert(all.end(), of_buckets[n].begin(), of_buckets[n].end());
  }
  const PhotonSettings& settings = p.settings.photons;
  p.photons.has_caustics = p.photon_lights->count(PhotonKind::caustic) > 0;
  p.photons.caustic = PhotonMap(std::move(caustic), settings.nearest, settings.caustic_reach_m);
  p.photons.global = PhotonMap(std::move(global), settings.nearest, settings.global_reach_m);
  p.world->set_photons(buckets.empty() ? nullptr : &p.photons);
}

Bucket RayTracer::trace(const instant::PixelRectangle& rectangle) const {
  const Parts& p = *parts_;
  SEPTET_CHECK(p.world, "no instant was begun");
  Bucket bucket{rectangle, std::vector<TracedPixel>(std::size_t{rectangle.width} * rectangle.height)};
  const std::int64_t right = std::int64_t{rectangle.x} + rectangle.width,
                     bottom = std::int64_t{rectangle.y} + rectangle.height;
  if (p.settings.error > 0.0f) {
    SEPTET_CHECK(rectangle.x >= 0 && rectangle.y >= 0, "{}, {}", rectangle.x, rectangle.y);
    for (std::int64_t y = rectangle.y / block_side_px * block_side_px; y < bottom; y += block_side_px)
      for (std::int64_t x = rectangle.x / block_side_px * block_side_px; x < right; x += block_side_px)
        p.trace_block(x, y, bucket);
    return bucket;
  }
  return trace(rectangle, {0, p.settings.samples});
}

Bucket RayTracer::trace(const instant::PixelRectangle& rectangle, const SampleSet& set) const {
  const Parts& p = *parts_;
  SEPTET_CHECK(p.world && set.first <= set.end, "samples {} to {}", set.first, set.end);
  Bucket bucket{rectangle, std::vector<TracedPixel>(std::size_t{rectangle.width} * rectangle.height)};
  const std::int64_t right = std::int64_t{rectangle.x} + rectangle.width,
                     bottom = std::int64_t{rectangle.y} + rectangle.height;
  auto pixel = bucket.pixels.begin();
  for (std::int64_t y = rectangle.y; y < bottom; ++y)
    for (std::int64_t x = rectangle.x; x < right; ++x) {
      PixelSums sums;
      p.refine(sums, x, y, set.end - set.first, set.first);
      *pixel++ = sums.pixel();
    }
  return bucket;
}

const instant::Instant& RayTracer::instant() const { return parts_->instant; }

}  // namespace septet::raytrace
