#pragma once
/// Rasteriser: draws a ResolvedScene as described for one instant, off-screen or into a window.
///
/// Call `upload` when the scene's revision changes, `draw` once a frame, and `read_back` for the pixels of the last
/// frame. All calls of one Renderer come from one thread. It never reads a clock, a file or the network. Errors are
/// those of the device (no Vulkan 1.3, out of memory, device lost); after one from `draw` or `upload`, make a new
/// Renderer.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/image/image.hpp"
#include "engine/instant/instant.hpp"
#include "engine/render/pass_time.hpp"
#include "engine/render/words.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

class Window;
struct RendererState;

enum class DevicePreference : std::uint8_t {
  any,       ///< Most capable device: discrete, integrated, then software.
  software,  ///< Mesa lavapipe: the same pixels on all processors of one kind.
};

/// Smoothing of the stairs of edges.
enum class Antialiasing : std::uint8_t {
  /// Four samples a pixel on a graphics card, smoothing on a software device, where samples cost as much again.
  automatic,
  none,
  smoothing,     ///< Smoothing from the finished picture alone.
  multisampled,  ///< Four samples a pixel.
  temporal,      ///< Static surfaces also from earlier frames (passes/temporal_pass.hpp); the rest as by smoothing.
};

/// Light that the eye scatters around bright areas (passes/bloom_pass.hpp).
enum class Bloom : std::uint8_t { automatic, none, present };  ///< Automatic: on a graphics card.

/// Width of shadows' edges (shaders/sunlit.glsl): a texel or two, or as wide as the sun makes them. Automatic: soft on
/// a graphics card.
enum class ShadowEdges : std::uint8_t { automatic, narrow, soft };

/// Headlights that light a view: the nearest ten beams, or all that reach it (passes/light_clusters.hpp). Automatic:
/// clustered on a graphics card.
enum class Headlights : std::uint8_t { automatic, nearest, clustered };

struct RendererOptions {
  std::uint32_t width = 0, height = 0;  ///< Target size, pixels.
  DevicePreference device = DevicePreference::any;
  bool validation = false;  ///< Enables the Khronos validation layer; its messages are counted in the statistics.
  Antialiasing antialiasing = Antialiasing::automatic;
  Window* window = nullptr;  ///< Window to present into; null draws off-screen. Outlives the renderer.
  bool timed = false;        ///< Times each pass by the device's clock, for the statistics.
  Bloom bloom = Bloom::automatic;
  ShadowEdges shadow_edges = ShadowEdges::automatic;
  Headlights headlights = Headlights::automatic;
};

/// Work submitted for the last frame, and messages of the validation layer since the start.
struct RenderStatistics {
  std::uint32_t triangles = 0;  ///< Submitted, shadows included.
  std::uint32_t shadow_triangles = 0;
  std::uint32_t draws = 0;
  std::uint32_t instances = 0;       ///< Instances that passed culling, without shadows.
  std::vector<PassTime> pass_times;  ///< Times of the newest finished frame, in order; empty unless `timed`.
  std::uint32_t validation_messages = 0;
  std::string first_validation_message;
};

/// Radiance of a frame's pixels, before exposure and tone mapping: linear Rec. 709, rows from the top, in the units of
/// engine/instant/atmosphere.hpp, without the overlay.
struct RadianceImage {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> radiance;
  const glm::vec3& at(std::uint32_t x, std::uint32_t y) const { return radiance[std::size_t{y} * width + x]; }
};

class Renderer {
 public:
  static Expected<Renderer> create(const RendererOptions& options);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Updates the device's copy of the scene: uploads parts whose revision is newer than the last one seen.
  Expected<void> upload(const scene::ResolvedScene& scene);

  /// Resizes the picture, such as with its window.
  Expected<void> resize(std::uint32_t width, std::uint32_t height);

  /// Draws one frame and, with a window, presents it, scaled to the window as far as its shape allows, black beside it.
  /// Views must lie within the picture (checked). The instant must describe the scene last uploaded.
  Expected<void> draw(const Instant& instant, const std::vector<OverlayText>& passing = {});
  /// Draws a frame input of the scene last uploaded, likewise. `passing`: texts shown over the rest in the window, and
  /// left out of read_back.
  Expected<void> draw(FrameInput input, const std::vector<OverlayText>& passing = {});

  /// Returns the last frame without its passing texts: RGBA, 8 bits, sRGB. Waits for the device. Before the first
  /// `draw` it is black.
  Expected<image::Image> read_back();
  /// Returns the radiance of the last frame. The picture is its image under the tone curve of
  /// engine/light/tone_curve.hpp, scaled by the exposure.
  Expected<RadianceImage> read_radiance();
  /// Exposure of the last frame.
  Exposure exposure() const;

  std::uint32_t width() const;
  std::uint32_t height() const;
  const RenderStatistics& statistics() const;
  std::string_view device_name() const;

 private:
  explicit Renderer(std::unique_ptr<RendererState> state);
  std::unique_ptr<RendererState> state_;
};

}  // namespace septet::render
