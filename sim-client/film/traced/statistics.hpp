#pragma once
/// Record of the traced tiles, with worker, time and cost, as a JSON file for judging machines and schedules.

#include <filesystem>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/instant/view.hpp"

namespace septet::film {

struct TileTraced {
  std::uint64_t frame = 0;  ///< Number of the picture.
  std::uint32_t tile = 0;
  int program = 0;     ///< Rank under mpirun.
  double cpu_s = 0.0;  ///< Processor time of the thread that traced it.
  double came_s = 0.0;
  bool counts = true;  ///< False: another worker had delivered it.
};

struct FilmStatistics {
  std::vector<TileTraced> tiles;                     ///< Tiles in order of arrival.
  double begun_s = 0.0;                              ///< Time of dealing the first tiles, as `came_s`.
  double master_cpu_s = 0.0;                         ///< Processor time of the thread that deals and keeps tiles.
  std::uint64_t sent_bytes = 0, received_bytes = 0;  ///< Bytes between programs, without the overhead of Open MPI.
  std::uint64_t splits = 0;
  std::uint64_t photon_buckets = 0;  ///< Photon buckets shot by several workers together; each counts once.
};

Expected<void> write_statistics(const std::filesystem::path& file, const FilmStatistics& statistics,
                                const std::vector<instant::PixelRectangle>& tiles);

/// Processor time of the calling thread.
double thread_cpu_s();

}  // namespace septet::film
