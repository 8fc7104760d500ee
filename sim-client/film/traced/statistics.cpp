#include "sim-client/film/traced/statistics.hpp"

#include <ctime>

#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"

namespace septet::film {

Expected<void> write_statistics(const std::filesystem::path& file, const FilmStatistics& statistics,
                                const std::vector<instant::PixelRectangle>& tiles) {
  document::Json traced = document::Json::array();
  for (const TileTraced& each : statistics.tiles) {
    const instant::PixelRectangle& at = tiles[each.tile];
    traced.push_back({each.frame, at.x, at.y, at.width, at.height, each.program, each.cpu_s,
                      each.came_s - statistics.begun_s, each.counts});
  }
  document::Json json = document::Json::object();
  json["master_cpu_s"] = statistics.master_cpu_s;
  json["sent_bytes"] = statistics.sent_bytes;
  json["received_bytes"] = statistics.received_bytes;
  json["splits"] = statistics.splits;
  json["photon_buckets"] = statistics.photon_buckets;
  json["columns"] = {"frame", "left_px", "top_px", "width_px", "height_px", "program", "cpu_s", "came_s", "counts"};
  json["tiles"] = std::move(traced);
  return document::write_text_file(file, document::text_of(json));
}

double thread_cpu_s() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace septet::film
