#pragma once
/// The ray tracer: draws a ResolvedScene as the description of one instant says, pixel by pixel, without a graphics card.
///
/// Call `begin` for each instant and `trace` for each bucket of its picture, from any threads, in any order, on any machines: a
/// pixel is a function of the scene, the instant, the settings and its place, bit for bit. A sample whose light is not a number counts as black and is counted.

#include <memory>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/instant/instant.hpp"
#include "engine/raytrace/path_tracer.hpp"
#include "engine/raytrace/photons.hpp"

namespace septet::raytrace {

/// The weight of light by its distance from a pixel's middle: B-splines of degree 0 (a box of one pixel) to 3 (four pixels across). A
/// sample is drawn by that weight and belongs to one pixel alone, so that buckets need no padding: the sum of k + 1 uniform numbers
/// is spread as the B-spline of degree k.
enum class Filter : std::uint8_t { box, tent, quadratic, cubic };

struct TraceSettings {
  std::uint32_t samples = 64;  ///< Of a pixel; the most of them where an `error` is given.
  /// Enough of it: blocks of 4 × 4 pixels, the same however the picture is shared out, take no more samples once the root mean square of their
  /// pixels' errors (relative_error) is estimated to be that. 0: all take all samples.
  float error = 0.0f;
  PathSettings paths;
  Filter filter = Filter::quadratic;
  std::uint64_t seed = 0;
  float lens_radius_m = 0.0f;  ///< 0: a pinhole, all is sharp.
  float focus_m = 10.0f;       ///< Distance at which a lens is sharp.
  bool blurs = true;           ///< False: what moves until `later` is not smeared; its pixels' motion is told.
  PhotonSettings photons;      ///< How many are sent, once RayTracer::set_photons is called.
  float motion_scale = 1.0f;   ///< Of a pixel's motion, to a time other than `later`'s, as if all went on evenly.
};

/// A pixel as samples add to it.
struct TracedPixel {
  glm::vec3 radiance{0.0f};              ///< Mean of the samples, linear Rec. 709, the units of engine/instant.
  float variance = 0.0f;                 ///< Of that mean's luminance.
  glm::vec3 normal{0.0f}, albedo{0.0f};  ///< Means of what is seen first.
  float depth_m = 0.0f;                  ///< Of the first sample; 0: the sky.
  /// Of the first sample; 0: the sky. From 1 in the order of the scene's instances, then of its meshes, as parts of participants, then
  /// of its materials, as debris, then ice: the same number means the same in every frame.
  std::uint32_t object = 0;
  std::uint32_t participant = 0;  ///< Of the first sample; 0: of none.
  /// Of the first sample: its way in the picture until `later`, pixels to the right and down, times motion_scale. 0 without `later`, in
  /// a picture of several views, and of what is behind the camera then. The sky is infinitely far.
  glm::vec2 motion_px{0.0f};
  std::uint32_t bad_samples = 0;  ///< Not a number, or infinite.
  std::uint32_t samples = 0;
};

/// Standard error of a pixel's luminance as a share of it, or, where it is darker than a tenth of white, of that.
float relative_error(const TracedPixel& pixel, const instant::Exposure& exposure);

/// Samples first, first + 1, … below end, of each pixel.
struct SampleSet {
  std::uint32_t first = 0, end = 0;
};
/// Set `n` of `count`, all about as large; of whole packets of samples where there are enough, since others are begun more than once.
constexpr SampleSet sample_set(std::uint32_t samples, std::uint32_t n, std::uint32_t count) {
  const std::uint64_t step = samples / packet_size >= count ? packet_size : 1;
  const auto at = [&](std::uint64_t k) {
    return k == count ? samples : static_cast<std::uint32_t>(k * samples / count / step * step);
  };
  return {at(n), at(n + 1)};
}
/// One pixel of what its sets have given, in the order in which they are told here: the order in which they came plays no part.
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

/// Squares of `side_px`, in the order in which they are dealt: rows from the top. The last of a row or column may be smaller.
std::vector<instant::PixelRectangle> buckets_of(std::uint32_t width, std::uint32_t height, std::uint32_t side_px);

class RayTracer {
 public:
  /// `scene` outlives the ray tracer and does not change.
  static Expected<RayTracer> create(const scene::ResolvedScene& scene);
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;
  ~RayTracer();

  /// Builds what the pixels of this instant are traced through; `bodies` beside those of the instant's ice. `later`: the instant at which the
  /// shutter closes. What moves until then, the views too, is smeared; light and weather, smoke and soot are those of the first.
  void begin(instant::Instant instant, const TraceSettings& settings, std::vector<ClearBody> bodies = {},
             const instant::Instant* later = nullptr);
  /// Photons of the instant begun last, in buckets that may be traced in any order, on any machines; none, where they would bring nothing.
  std::vector<PhotonBucket> photon_buckets() const;
  std::vector<Photon> trace_photons(const PhotonBucket& bucket) const;
  /// What came of each of those buckets, in their order: pixels have that light from now on, as without photons else.
  void set_photons(std::span<const std::vector<Photon>> of_buckets);
  /// Pixels of the instant begun last; the rectangle lies within the picture that its views make.
  Bucket trace(const instant::PixelRectangle& rectangle) const;
  /// Of their samples one set; all take all of it, whatever the error is.
  Bucket trace(const instant::PixelRectangle& rectangle, const SampleSet& set) const;
  const instant::Instant& instant() const;

 private:
  struct Parts;
  explicit RayTracer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace septet::raytrace
