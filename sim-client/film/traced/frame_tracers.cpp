#include "sim-client/film/traced/frame_tracers.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "sim-client/film/camera.hpp"

namespace septet::film {
namespace {

raytrace::TraceSettings settings_of(const FilmOptions& options, const FilmFrame& frame, const Shot& shot) {
  raytrace::TraceSettings settings;
  settings.samples = options.samples;
  settings.error = static_cast<float>(options.error);
  settings.filter = options.filter;
  settings.photons.caustic = options.caustic_photons, settings.photons.global = options.gather_photons;
  settings.seed = frame.number;  // Another noise in each frame.
  settings.lens_radius_m = static_cast<float>(lens_radius_m(shot));
  settings.focus_m = static_cast<float>(shot.focus_m);
  if (shot.shutter_rad > 0.0) settings.motion_scale = static_cast<float>(2.0 * std::numbers::pi / shot.shutter_rad);
  return settings;
}

/// The first sample of each pixel, and no light that a layer of ways has no use for.
raytrace::TraceSettings settings_of_ways(raytrace::TraceSettings settings) {
  settings.samples = 1;
  settings.error = 0.0f;
  settings.photons.caustic = settings.photons.global = 0;
  settings.blurs = false;
  return settings;
}

raytrace::Bucket trace_light(const raytrace::RayTracer& light, const instant::PixelRectangle& tile,
                             const std::optional<raytrace::SampleSet>& set) {
  return set ? light.trace(tile, *set) : light.trace(tile);
}

void put_part(const raytrace::Bucket& part, raytrace::Bucket& whole) {
  const auto from_x = static_cast<std::size_t>(part.rectangle.x - whole.rectangle.x);
  for (std::size_t row = 0; row < part.rectangle.height; ++row)
    std::ranges::copy_n(part.pixels.begin() + static_cast<std::ptrdiff_t>(row * part.rectangle.width),
                        part.rectangle.width,
                        whole.pixels.begin() + static_cast<std::ptrdiff_t>(row * whole.rectangle.width + from_x));
}

}  // namespace

FrameTracers::FrameTracers(raytrace::RayTracer light, const scene::ResolvedScene& scene)
    : light_(std::move(light)), summary_(instant::summarise(scene)), revision_(scene.revision) {}

Expected<FrameTracers> FrameTracers::create(const FilmFrames& frames) {
  auto light = raytrace::RayTracer::create(frames.scene());
  if (!light) return tl::unexpected(light.error());
  return FrameTracers(std::move(*light), frames.scene());
}

Expected<void> FrameTracers::begin(FilmFrames& frames, std::size_t frame, const FilmOptions& options) {
  const FilmFrame& of_film = frames.plan().frames[frame];
  const Shot& shot = frames.plan().script.shots[of_film.shot];
  auto input = frames.input_of(of_film);
  if (!input) return tl::unexpected(input.error());
  if (frames.scene().revision != revision_) {
    auto renewed = raytrace::RayTracer::create(frames.scene());
    if (!renewed) return tl::unexpected(renewed.error());
    *this = FrameTracers(std::move(*renewed), frames.scene());
  }
  auto second = frames.input_beside(of_film);
  if (!second) return tl::unexpected(second.error());
  const raytrace::TraceSettings settings = settings_of(options, of_film, shot);
  if (auto begun = begin_beside(frames, std::move(*second), settings); !begun) return begun;
  auto closing = frames.input_as_shutter_closes(of_film);
  if (!closing) return tl::unexpected(closing.error());
  instant::Instant opens = instant::describe(std::move(*input), summary_);
  if (*closing) {
    const instant::Instant closes = instant::describe(std::move(**closing), summary_, opens.light);
    ways_.reset();
    light_.begin(std::move(opens), settings, {}, &closes);
    return {};
  }
  if (!options.layers.contains(Layer::motion)) {
    light_.begin(std::move(opens), settings);
    return {};
  }
  auto next = frames.input_of_next(of_film);
  if (!next) return tl::unexpected(next.error());
  const instant::Instant then = instant::describe(std::move(*next), summary_, opens.light);
  if (!ways_) {
    auto created = raytrace::RayTracer::create(frames.scene());
    if (!created) return tl::unexpected(created.error());
    ways_.emplace(std::move(*created));
  }
  ways_->begin(opens, settings_of_ways(settings), {}, &then);
  light_.begin(std::move(opens), settings);
  return {};
}

Expected<void> FrameTracers::begin_beside(const FilmFrames& frames, std::optional<instant::FrameInput> input,
                                          const raytrace::TraceSettings& settings) {
  left_px_.reset();
  if (!input) return {};
  if (!beside_) {
    auto created = raytrace::RayTracer::create(frames.scene());
    if (!created) return tl::unexpected(created.error());
    beside_.emplace(std::move(*created));
  }
  left_px_ = static_cast<std::uint32_t>(input->views.front().viewport.x);
  beside_->begin(instant::describe(std::move(*input), summary_), settings);
  std::vector<std::vector<raytrace::Photon>> photons;
  for (const raytrace::PhotonBucket& bucket : beside_->photon_buckets())
    photons.push_back(beside_->trace_photons(bucket));
  if (!photons.empty()) beside_->set_photons(photons);
  return {};
}

raytrace::Bucket FrameTracers::trace(const instant::PixelRectangle& tile,
                                     const std::optional<raytrace::SampleSet>& set) const {
  if (!left_px_) return trace_first(tile, set);
  const std::uint32_t from_px = static_cast<std::uint32_t>(tile.x), to_px = from_px + tile.width,
                      middle_px = std::clamp(*left_px_, from_px, to_px);
  raytrace::Bucket whole{tile, std::vector<raytrace::TracedPixel>(std::size_t{tile.width} * tile.height)};
  if (middle_px > from_px) put_part(trace_first({tile.x, tile.y, middle_px - from_px, tile.height}, set), whole);
  if (to_px > middle_px)
    put_part(trace_light(*beside_, {static_cast<std::int32_t>(middle_px), tile.y, to_px - middle_px, tile.height}, set),
             whole);
  return whole;
}

raytrace::Bucket FrameTracers::trace_first(const instant::PixelRectangle& tile,
                                           const std::optional<raytrace::SampleSet>& set) const {
  raytrace::Bucket bucket = trace_light(light_, tile, set);
  if (!ways_ || (set && set->first > 0)) return bucket;
  const raytrace::Bucket ways = ways_->trace(tile);
  for (std::size_t n = 0; n < bucket.pixels.size(); ++n) bucket.pixels[n].motion_px = ways.pixels[n].motion_px;
  return bucket;
}

}  // namespace septet::film
