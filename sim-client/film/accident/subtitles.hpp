#pragma once
/// Subtitles of a film as SRT (SubRip): UTF-8, at most two lines of 42 characters, no faster than 17 characters a
/// second, 1 to 7 s long, 80 ms apart at least. Pure.

#include <string>
#include <vector>

namespace septet::film {

/// Words and the stretch of the film that they belong to.
struct Spoken {
  double from_s = 0.0, to_s = 0.0;  ///< Seconds of the film.
  std::string words;
};

inline constexpr std::size_t subtitle_line_characters = 42;
inline constexpr double subtitle_characters_per_s = 17.0, subtitle_gap_s = 0.08;
inline constexpr double shortest_subtitle_s = 1.0, longest_subtitle_s = 7.0;

/// Each stays within its stretch; words that are too long for it end in "…", and those of a stretch shorter than
/// `shortest_subtitle_s` are left out.
std::string subtitles(const std::vector<Spoken>& spoken);

}  // namespace septet::film
