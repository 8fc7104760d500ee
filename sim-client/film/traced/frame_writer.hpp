#pragma once
/// Turns the tiles of whole frames into pictures on a thread of its own, so that the master does not wait for it.

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>

#include "engine/core/job_thread.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/film_frames.hpp"
#include "sim-client/film/traced/kept_tiles.hpp"
#include "sim-client/film/traced/layers.hpp"

namespace septet::film {

class FrameWriter {
 public:
  /// All arguments but `frames` outlive it. The destructor writes the rest of the queue.
  FrameWriter(const FilmOptions& options, const FilmFolder& folder, const FilmFrames& frames,
              std::span<const instant::PixelRectangle> tiles);

  /// Queues the frame whose tiles are all there, and removes their file once the picture is whole; waits while four are
  /// queued. Returns the first failure of an earlier one.
  Expected<void> finish(std::uint64_t frame, KeptTiles tiles, std::filesystem::path kept_in);
  /// Writes preview.png in the folder from the tiles at hand; not while pictures wait.
  void show_preview(std::filesystem::path kept_in);
  /// Waits until everything is written, and removes the preview. Returns the first failure.
  Expected<void> wait();
  /// Quality of the pictures written so far.
  struct Quality {
    double pixels = 0.0, samples = 0.0, squared_errors = 0.0;
    std::uint64_t bad_samples = 0;
  };
  Quality quality();

 private:
  struct Job {
    std::uint64_t frame = 0;
    std::optional<KeptTiles> tiles;  ///< Empty: a preview.
    std::filesystem::path kept_in;
  };
  Expected<void> write(Job& job);
  /// Draws what lies over a frame's picture, if anything does.
  Expected<void> draw_over(std::uint64_t frame, image::Image& picture);
  void note_quality(const raytrace::TracedPicture& picture, const instant::Exposure& exposure);

  const FilmOptions& options_;
  const FilmFolder& folder_;
  ExrFacts exr_facts_;
  const bool has_overlays_;          ///< Something lies over a shot's pictures.
  std::optional<FilmFrames> world_;  ///< Read for that by the writing thread alone, from its first picture on.
  std::span<const instant::PixelRectangle> tiles_;
  const std::filesystem::path preview_;
  std::mutex mutex_;  ///< Guards the quality.
  Quality quality_;
  JobThread<Job> thread_;
};

}  // namespace septet::film
