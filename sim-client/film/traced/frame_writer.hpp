#pragma once
/// Makes pictures of the tiles of whole frames, on a thread of its own, so that who deals tiles does not wait for it.

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>

#include "engine/core/job_thread.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/traced/kept_tiles.hpp"
#include "sim-client/film/traced/layers.hpp"

namespace septet::film {

class FrameWriter {
 public:
  /// All but `session` outlive it. Its end writes what is queued.
  FrameWriter(const FilmOptions& options, const FilmFolder& folder, const logging::SessionInfo& session,
              std::span<const instant::PixelRectangle> tiles);

  /// Queues the frame whose tiles are all there, and removes their file once the picture is whole; waits while four are
  /// queued. Answers the first failure of an earlier one.
  Expected<void> finish(std::uint64_t frame, KeptTiles tiles, std::filesystem::path kept_in);
  /// preview.png in the folder, of what there is of a frame; not while pictures wait.
  void show_preview(std::filesystem::path kept_in);
  /// Until everything is written; the preview is gone then. The first failure.
  Expected<void> wait();
  /// Of the pictures that are written so far.
  struct Quality {
    double pixels = 0.0, samples = 0.0, squared_errors = 0.0;
    std::uint64_t bad_samples = 0;
  };
  Quality quality();

 private:
  struct Job {
    std::uint64_t frame = 0;
    std::optional<KeptTiles> tiles;  ///< None: a preview.
    std::filesystem::path kept_in;
  };
  Expected<void> write(Job& job);
  void note_quality(const raytrace::TracedPicture& picture, const instant::Exposure& exposure);

  const FilmOptions& options_;
  const FilmFolder& folder_;
  ExrFacts exr_facts_;
  std::span<const instant::PixelRectangle> tiles_;
  const std::filesystem::path preview_;
  std::mutex mutex_;  ///< Of the quality.
  Quality quality_;
  JobThread<Job> thread_;
};

}  // namespace septet::film
