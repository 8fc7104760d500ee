#pragma once
/// The rasteriser: draws a ResolvedScene as the description of one instant says, off-screen or into a window.
///
/// Call `upload` when the scene's revision changes, `draw` once a frame, and `read_back` for the pixels of the last frame.
/// All calls of one Renderer come from one thread. It never reads a clock, a file or the network. Errors are those of the
/// device (no Vulkan 1.3, out of memory, device lost); after one from `draw` or `upload`, make a new Renderer.

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
  any,       ///< The most capable device: discrete, integrated, then software.
  software,  ///< Mesa lavapipe: the same pixels wherever it runs on the same kind of processor.
};

/// How the stairs of edges are smoothed.
enum class Antialiasing : std::uint8_t {
  automatic,  ///< Four samples a pixel on a graphics card, smoothing on a software device, where samples cost as much again.
  none,
  smoothing,     ///< After drawing, from the picture alone.
  multisampled,  ///< Four samples a pixel.
  temporal,  ///< What stands still from the frames before, too (passes/temporal_pass.hpp); the rest as by smoothing.
};

/// Light that the eye scatters around what is bright (passes/bloom_pass.hpp).
enum class Bloom : std::uint8_t { automatic, none, present };  ///< Automatic: on a graphics card.

/// How wide the edges of shadows are (shaders/sunlit.glsl): a texel or two, or as wide as the sun makes them. Automatic: soft on a graphics card.
enum class ShadowEdges : std::uint8_t { automatic, narrow, soft };

/// How many vehicles' headlights light what a view sees: the nearest eight, or all that reach it (passes/light_clusters.hpp). Automatic: all of them
/// on a graphics card.
enum class Headlights : std::uint8_t { automatic, nearest, clustered };

struct RendererOptions {
  std::uint32_t width = 0, height = 0;  ///< Of the target, pixels.
  DevicePreference device = DevicePreference::any;
  bool validation = false;  ///< Turns the Khronos validation layer on; its messages are counted in the statistics.
  Antialiasing antialiasing = Antialiasing::automatic;
  Window* window = nullptr;  ///< Where to present; null draws off-screen. Outlives the renderer.
  bool timed = false;        ///< The device's clock times each pass, for the statistics.
  Bloom bloom = Bloom::automatic;
  ShadowEdges shadow_edges = ShadowEdges::automatic;
  Headlights headlights = Headlights::automatic;
};

/// What the last frame cost to submit, and what the validation layer has said since the start.
struct RenderStatistics {
  std::uint32_t triangles = 0;  ///< Submitted, shadows included.
  std::uint32_t shadow_triangles = 0;
  std::uint32_t draws = 0;
  std::uint32_t instances = 0;       ///< That passed culling, shadows not included.
  std::vector<PassTime> pass_times;  ///< Where frames are timed: of the newest frame whose times have come, in order.
  std::uint32_t validation_messages = 0;
  std::string first_validation_message;
};

/// What a frame's pixels received, before exposure and tone mapping: linear Rec. 709, rows from the top, in the units of
/// engine/instant/atmosphere.hpp, overlay not included.
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

  /// Brings the device's copy up to the scene's: uploads what has a newer revision than was last seen.
  Expected<void> upload(const scene::ResolvedScene& scene);

  /// Gives the picture another size, such as that of a window that was resized.
  Expected<void> resize(std::uint32_t width, std::uint32_t height);

  /// Draws one frame and, with a window, presents it, scaled to the window as far as its shape allows, black beside it. Views lie within the picture (checked). The
  /// instant was described in the scene that was uploaded.
  Expected<void> draw(const Instant& instant, const std::vector<OverlayText>& passing = {});
  /// The same for what a frame shows in the scene that was uploaded. `passing` are texts that the window has over the rest and
  /// read_back has not.
  Expected<void> draw(FrameInput input, const std::vector<OverlayText>& passing = {});

  /// The last frame without its passing texts: RGBA, 8 bits, sRGB. Waits for the device. Before the first `draw` it is black.
  Expected<image::Image> read_back();
  /// The light of the same frame, of which the picture is what a display shows (engine/light/tone_curve.hpp) at `exposure`.
  Expected<RadianceImage> read_radiance();
  /// Of the last frame.
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
