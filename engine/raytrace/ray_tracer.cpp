#include "engine/raytrace/ray_tracer.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "engine/core/check.hpp"
#include "engine/core/parallel_for.hpp"

namespace septet::raytrace {
namespace {

constexpr std::uint32_t bucket_side_px = 16;

/// Offset from a pixel's middle, pixels.
glm::vec2 filtered_offset(Filter filter, PathRandom& random) {
  const int degree = static_cast<int>(filter);
  glm::vec2 sum(-0.5f * static_cast<float>(degree + 1));
  for (int n = 0; n <= degree; ++n) sum += random.pair();
  return sum;
}

/// The rays of one view: from the world's origin, the first view's eye, along the world's axes.
struct Camera {
  glm::vec3 eye_m, middle, right,
      down;  ///< A ray's way: middle + right · x + down · y, pixels from the viewport's corner.
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

  bool shows(std::int64_t x, std::int64_t y) const {
    return x >= viewport.x && y >= viewport.y && x < viewport.x + std::int64_t{viewport.width} &&
           y < viewport.y + std::int64_t{viewport.height};
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

ClearBody clear_body(const ice::IceBody& ice) {
  ClearBody body{ice.origin_m, {}, static_cast<float>(ice::ice_index / ice::air_index), ice.look.absorption_per_m};
  for (const ice::IceVertex& vertex : ice.vertices) body.vertices.push_back({vertex.position_m, vertex.normal, {}});
  return body;
}

TracedPixel trace_pixel(const World& world, const Camera& camera, const TraceSettings& settings, std::uint32_t x,
                        std::uint32_t y) {
  TracedPixel pixel;
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t sample = 0; sample < settings.samples; ++sample) {
    PathRandom random(settings.seed, x, y, sample);
    const glm::vec2 at = glm::vec2(x, y) + 0.5f + filtered_offset(settings.filter, random);
    const Ray ray = camera.ray(at, settings, random);
    FirstSeen first;
    glm::vec3 radiance = trace_path(world, settings.paths, ray, random, &first);
    if (!std::isfinite(radiance.x + radiance.y + radiance.z)) {
      radiance = glm::vec3(0.0f);
      ++pixel.bad_samples;
    }
    pixel.radiance += radiance;
    pixel.normal += first.normal;
    pixel.albedo += first.albedo;
    if (sample == 0)
      pixel.depth_m = first.distance_m, pixel.object = first.object, pixel.participant = first.participant;
    const double light = luminance(radiance);
    sum += light, squares += light * light;
  }
  const float share = 1.0f / static_cast<float>(std::max(1u, settings.samples));
  pixel.radiance *= share, pixel.normal *= share, pixel.albedo *= share;
  if (const double n = settings.samples; n > 1.0)
    pixel.variance = static_cast<float>(std::max(0.0, squares - sum * sum / n) / (n * (n - 1.0)));
  return pixel;
}

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

struct RayTracer::Parts {
  const scene::ResolvedScene& scene;
  Geometry geometry;
  TraceSettings settings{};
  instant::Instant instant{};
  std::vector<ClearBody> bodies{};
  std::unique_ptr<World> world{};
  std::vector<Camera> cameras{};
  std::vector<std::uint8_t> cloud_noise = instant::cloud_noise();
};

RayTracer::RayTracer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;
RayTracer::~RayTracer() = default;

Expected<RayTracer> RayTracer::create(const scene::ResolvedScene& scene) {
  auto geometry = Geometry::create();
  if (!geometry) return tl::unexpected(geometry.error());
  const std::vector<bool> open = open_meshes(scene);
  for (std::size_t n = 0; n < scene.meshes.size(); ++n)
    geometry->add_mesh(scene.meshes[n].vertices, scene.meshes[n].indices, open[n]);
  return RayTracer(std::unique_ptr<Parts>(new Parts{scene, std::move(*geometry)}));
}

void RayTracer::begin(instant::Instant instant, const TraceSettings& settings, std::vector<ClearBody> bodies) {
  Parts& p = *parts_;
  p.world.reset();
  p.settings = settings;
  p.instant = std::move(instant);
  p.bodies = std::move(bodies);
  for (const ice::IceBody& ice : p.instant.ice) p.bodies.push_back(clear_body(ice));
  p.world = std::make_unique<World>(p.scene, p.instant, p.bodies, p.cloud_noise, p.geometry);
  p.cameras.clear();
  for (const instant::FrameView& view : p.instant.views) p.cameras.emplace_back(view, p.world->origin_m());
}

Bucket RayTracer::trace(const instant::PixelRectangle& rectangle) const {
  const Parts& p = *parts_;
  SEPTET_CHECK(p.world, "no instant was begun");
  Bucket bucket{rectangle, {}};
  bucket.pixels.reserve(std::size_t{rectangle.width} * rectangle.height);
  for (std::uint32_t row = 0; row < rectangle.height; ++row)
    for (std::uint32_t column = 0; column < rectangle.width; ++column) {
      const std::int64_t x = std::int64_t{rectangle.x} + column, y = std::int64_t{rectangle.y} + row;
      // A later view lies over an earlier one.
      const auto camera =
          std::find_if(p.cameras.rbegin(), p.cameras.rend(), [&](const Camera& each) { return each.shows(x, y); });
      bucket.pixels.push_back(camera == p.cameras.rend()
                                  ? TracedPixel{}
                                  : trace_pixel(*p.world, *camera, p.settings, static_cast<std::uint32_t>(x),
                                                static_cast<std::uint32_t>(y)));
    }
  return bucket;
}

const instant::Instant& RayTracer::instant() const { return parts_->instant; }

TracedPicture whole_picture(const RayTracer& tracer, std::uint32_t width, std::uint32_t height,
                            const std::function<bool(const Bucket&)>& done) {
  TracedPicture picture(width, height);
  const auto buckets = buckets_of(width, height, bucket_side_px);
  std::mutex mutex;
  std::atomic<bool> goes_on{true};
  parallel_for(buckets.size(), [&](std::size_t n) {
    if (!goes_on) return;
    const Bucket bucket = tracer.trace(buckets[n]);
    const std::scoped_lock lock(mutex);
    picture.put(bucket);
    if (done && !done(bucket)) goes_on = false;
  });
  return picture;
}

}  // namespace septet::raytrace
