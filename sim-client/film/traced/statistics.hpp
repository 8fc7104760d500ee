#pragma once
/// Who traced what of a film, when and at what cost, as a JSON file for whoever judges machines and schedules.

#include <filesystem>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/instant/view.hpp"

namespace septet::film {

struct TileTraced {
  std::uint64_t frame = 0;  ///< Number of the picture.
  std::uint32_t tile = 0;
  int program = 0;     ///< Of mpirun.
  double cpu_s = 0.0;  ///< Of the thread that traced it.
  double came_s = 0.0;
  bool counts = true;  ///< False: another had delivered it.
};

struct FilmStatistics {
  std::vector<TileTraced> tiles;                     ///< As they came.
  double begun_s = 0.0;                              ///< When the first tiles were dealt, as `came_s`.
  double master_cpu_s = 0.0;                         ///< Of the thread that deals and keeps.
  std::uint64_t sent_bytes = 0, received_bytes = 0;  ///< Between programs, without what Open MPI adds.
  std::uint64_t splits = 0;
  std::uint64_t photon_buckets = 0;  ///< Shot by several together; each counts once.
};

Expected<void> write_statistics(const std::filesystem::path& file, const FilmStatistics& statistics,
                                const std::vector<instant::PixelRectangle>& tiles);

/// Processor time of the calling thread.
double thread_cpu_s();

}  // namespace septet::film
