#include "logging/study/measures/collisions.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "logging/study/measures/crashes.hpp"

namespace septet::logging {
namespace {

constexpr double beyond_everything = 1e9;  ///< In any unit; an altered event may exceed it.

}  // namespace

std::optional<double> number_in_detail(const std::string& detail, const std::string& key) {
  const std::string word = key + '=';
  for (auto at = detail.find(word); at != std::string::npos; at = detail.find(word, at + 1)) {
    if (at > 0 && detail[at - 1] != ' ') continue;  // The end of another key.
    double value = 0.0;
    const char* begin = detail.data() + at + word.size();
    const auto [end, error] = std::from_chars(begin, detail.data() + detail.size(), value);
    if (error == std::errc{} && std::abs(value) < beyond_everything) return value;
  }
  return std::nullopt;
}

std::vector<Collision> find_collisions(std::span<const Event> events) {
  std::vector<Collision> collisions;
  const std::vector<CrashRecord> crashes = find_crashes(events);
  for (const Event& event : events)
    if (event.kind == "collision")
      collisions.push_back({event.simulated_time_s, event.participant,
                            number_in_detail(event.detail, "closing_speed_mps"), crash_of(event, crashes)});
  return collisions;
}

}  // namespace septet::logging
