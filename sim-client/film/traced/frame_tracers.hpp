#pragma once
/// Ray tracers of one frame: of its light, of its second camera's where the shot has one, and, where the layer of motion
/// is wanted and no shutter stays open, of the ways of what its pixels show. These are traced apart, so that the layer
/// changes no pixel.

#include <cstdint>
#include <optional>

#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "sim-client/film/film_frames.hpp"

namespace septet::film {

/// `trace` from any number of threads at a time, but not while `begin` runs.
class FrameTracers {
 public:
  /// Error: Embree does not start on this machine.
  static Expected<FrameTracers> create(const FilmFrames& frames);

  /// Prepares for one frame; what is made of the scene is made anew where that has changed.
  Expected<void> begin(FilmFrames& frames, std::size_t frame, const FilmOptions& options);
  /// One set of a tile's samples; empty: all, or as many as the options' error asks for.
  raytrace::Bucket trace(const instant::PixelRectangle& tile, const std::optional<raytrace::SampleSet>& set) const;

  const raytrace::RayTracer& light() const { return light_; }
  raytrace::RayTracer& light() { return light_; }

 private:
  FrameTracers(raytrace::RayTracer light, const scene::ResolvedScene& scene);
  Expected<void> begin_beside(const FilmFrames& frames, std::optional<instant::FrameInput> input,
                              const raytrace::TraceSettings& settings);
  /// A tile, or a part of one, that the first camera sees.
  raytrace::Bucket trace_first(const instant::PixelRectangle& tile,
                               const std::optional<raytrace::SampleSet>& set) const;

  raytrace::RayTracer light_;
  /// Of the second camera: the picture from `left_px_` on. Its photons, if any, are its own, and its shutter is open for
  /// no time.
  std::optional<raytrace::RayTracer> beside_;
  std::optional<std::uint32_t> left_px_;     ///< Empty: the frame has no second camera.
  std::optional<raytrace::RayTracer> ways_;  ///< Empty: not wanted of this frame.
  instant::SceneSummary summary_;
  std::uint64_t revision_;  ///< Of the scene that all this is made of.
};

}  // namespace septet::film
