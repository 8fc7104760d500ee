#pragma once
/// The ray tracer: draws a ResolvedScene by the description of one instant, pixel by pixel, without a graphics card.
///
/// Call `begin` for each instant and `trace` for each bucket of its picture, from any threads, in any order, on any
/// machines: a pixel is a function of the scene, the instant, the settings and its place, bit for bit. A sample with
/// NaN or infinite light counts as black and is counted.

#include <memory>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/instant/instant.hpp"
#include "engine/raytrace/path_tracer.hpp"
#include "engine/raytrace/photons.hpp"

namespace septet::raytrace {

/// Pixel filter: B-splines of degree 0 (a box of one pixel) to 3 (four pixels across). A sample is drawn by that weight
/// and belongs to one pixel alone, so that buckets need no padding: the sum of k + 1 uniform numbers is distributed as
/// the B-spline of degree k.
enum class Filter : std::uint8_t { box, tent, quadratic, cubic };

struct TraceSettings {
  std::uint32_t samples = 64;  ///< Samples of a pixel; the most of them where an `error` is given.
  /// Error to stop at: blocks of 4 × 4 pixels, the same however the picture is divided, take no more samples once the
  /// root mean square of their pixels' errors (relative_error) is estimated to be below it. 0: every pixel takes all
  /// samples.
  float error = 0.0f;
  PathSettings paths;
  Filter filter = Filter::quadratic;
  std::uint64_t seed = 0;
  float lens_radius_m = 0.0f;  ///< 0: a pinhole, all is sharp.
  float focus_m = 10.0f;       ///< Distance at which a lens is sharp.
  bool blurs = true;           ///< Motion blur until `later`; false: pixels carry their motion instead.
  PhotonSettings photons;      ///< Numbers of photons, used once RayTracer::set_photons is called.
  float motion_scale = 1.0f;   ///< Factor of a pixel's motion, for a time other than `later`'s at even motion.
};

/// Pixel, accumulated over samples.
struct TracedPixel {
  glm::vec3 radiance{0.0f};              ///< Mean of the samples, linear Rec. 709, the units of engine/instant.
  float variance = 0.0f;                 ///< Variance of that mean's luminance.
  glm::vec3 normal{0.0f}, albedo{0.0f};  ///< Means over the first visible surfaces.
  float depth_m = 0.0f;                  ///< Depth of the first sample; 0: the sky.
  /// Object of the first sample; 0: the sky. Numbered from 1 in the order of the scene's instances, then of its meshes,
  /// as parts of participants, then of its materials, as debris, then ice: a number is the same object in every frame.
  std::uint32_t object = 0;
  std::uint32_t participant = 0;  ///< Participant of the first sample; 0: no participant.
  /// Motion of the first sample in the picture until `later`, pixels to the right and down, times motion_scale. 0
  /// without `later`, in a picture of several views, and for a point behind the camera then. The sky is infinitely far.
  glm::vec2 motion_px{0.0f};
  std::uint32_t bad_samples = 0;  ///< Samples with NaN or infinite light.
  std::uint32_t samples = 0;
};

/// Standard error of a pixel's luminance as a share of it, or of a tenth of white where the pixel is darker.
float relative_error(const TracedPixel& pixel, const instant::Exposure& exposure);

/// Samples first, first + 1, … below end, of each pixel.
struct SampleSet {
  std::uint32_t first = 0, end = 0;
};
/// Set `n` of `count`, all about as large; whole packets of samples where there are enough, since partial packets are
/// begun more than once.
constexpr SampleSet sample_set(std::uint32_t samples, std::uint32_t n, std::uint32_t count) {
  const std::uint64_t step = samples / packet_size >= count ? packet_size : 1;
  const auto at = [&](std::uint64_t k) {
    return k == count ? samples : static_cast<std::uint32_t>(k * samples / count / step * step);
  };
  return {at(n), at(n + 1)};
}
/// Joins the sets of one pixel, in the order given: their order of arrival plays no part.
TracedPixel joined(std::span<const TracedPixel> sets);

/// A rectangle of a picture's pixels, rows from the top.
struct Bucket {
  instant::PixelRectangle rectangle;
  std::vector<TracedPixel> pixels;
};

struct TracedPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<TracedPixel> pixels;
  std::uint64_t bad_samples = 0;

  TracedPicture() = default;
  TracedPicture(std::uint32_t width_px, std::uint32_t height_px)
      : width(width_px), height(height_px), pixels(std::size_t{width_px} * height_px) {}
  const TracedPixel& at(std::uint32_t x, std::uint32_t y) const { return pixels[std::size_t{y} * width + x]; }
  void put(const Bucket& bucket);
};

/// Squares of `side_px`, in the order in which they are dealt: rows from the top. The last of a row or column may be
/// smaller.
std::vector<instant::PixelRectangle> buckets_of(std::uint32_t width, std::uint32_t height, std::uint32_t side_px);

class RayTracer {
 public:
  /// Error: Embree does not start on this machine. `scene` outlives the ray tracer and does not change.
  static Expected<RayTracer> create(const scene::ResolvedScene& scene);
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;
  ~RayTracer();

  /// Builds the world of this instant; `bodies` beside those of the instant's ice. `later`: the instant at which the
  /// shutter closes. Motion until then, the views' too, is blurred; light and weather, smoke and soot are those of the
  /// first.
  void begin(instant::Instant instant, const TraceSettings& settings, std::vector<ClearBody> bodies = {},
             const instant::Instant* later = nullptr);
  /// Photons of the instant begun last, in buckets that may be traced in any order, on any machines; empty where they
  /// would bring no light.
  std::vector<PhotonBucket> photon_buckets() const;
  std::vector<Photon> trace_photons(const PhotonBucket& bucket) const;
  /// Results of those buckets, in their order: pixels use that light from now on; without a call they use none.
  void set_photons(std::span<const std::vector<Photon>> of_buckets);
  /// Pixels of the instant begun last; the rectangle lies within the picture of its views.
  Bucket trace(const instant::PixelRectangle& rectangle) const;
  /// One set of their samples; every pixel takes all of it, regardless of the error.
  Bucket trace(const instant::PixelRectangle& rectangle, const SampleSet& set) const;
  const instant::Instant& instant() const;

 private:
  struct Parts;
  explicit RayTracer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace septet::raytrace
