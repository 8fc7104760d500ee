#include "sim-client/film/accident/subtitles.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/core.h>

#include "engine/core/printable.hpp"

namespace septet::film {
namespace {

std::size_t characters_in(std::string_view text) { return printable_characters(text).value_or(text.size()); }

std::string srt_time(double time_s) {
  const auto ms = static_cast<long>(std::lround(1000.0 * time_s));
  return fmt::format("{:02}:{:02}:{:02},{:03}", ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60, ms % 1000);
}

/// Words in at most two lines, and no more characters than `most`; the rest is "…".
std::string in_two_lines(std::string_view words, std::size_t most) {
  constexpr std::size_t in_line_at_most = subtitle_line_characters - 1;  // There may be an ellipsis behind them.
  std::vector<std::string> lines(1);
  std::size_t used = 0;
  while (!words.empty()) {
    const std::string word(words.substr(0, words.find(' ')));
    words.remove_prefix(std::min(words.size(), word.size() + 1));
    const std::size_t length = characters_in(word), in_line = characters_in(lines.back());
    const bool starts_line = in_line > 0 && in_line + 1 + length > in_line_at_most;
    if (used + 2 + length > most || length > in_line_at_most || (starts_line && lines.size() == 2)) {
      lines.back() += "…";
      break;
    }
    if (starts_line) lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    lines.back() += word;
    used += length + 1;
  }
  std::string text = lines.front();
  if (lines.size() > 1) text += '\n' + lines.back();
  return text;
}

}  // namespace

std::string subtitles(const std::vector<Spoken>& spoken) {
  std::string srt;
  std::size_t number = 0;
  for (const Spoken& one : spoken) {
    const double to_s = std::min(one.to_s - subtitle_gap_s, one.from_s + longest_subtitle_s);
    if (to_s - one.from_s < shortest_subtitle_s || one.words.empty()) continue;
    const auto most = static_cast<std::size_t>(subtitle_characters_per_s * (to_s - one.from_s));
    srt += fmt::format("{}\n{} --> {}\n{}\n\n", ++number, srt_time(one.from_s), srt_time(to_s),
                       in_two_lines(one.words, most));
  }
  return srt;
}

}  // namespace septet::film
