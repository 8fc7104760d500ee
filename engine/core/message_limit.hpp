#pragma once
/// Limits the messages of one source: ten at once, then one a second. Messages beyond that are dropped, and counted in
/// the next one.
///
///     if (auto said = limit.take(text, now_s)) messages.push_back(*said);

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/core.h>

namespace septet {

class MessageLimit {
 public:
  /// The message with the count of dropped ones, or nothing where it is dropped too. `now_s` may be any clock that does
  /// not go back.
  std::optional<std::string> take(std::string text, double now_s) {
    tokens_ = std::min(at_once, tokens_ + (now_s - last_s_) * per_s);
    last_s_ = now_s;
    if (tokens_ < 1.0) {
      ++left_out_;
      return std::nullopt;
    }
    tokens_ -= 1.0;
    if (left_out_ > 0) text += fmt::format(" ({} more of its messages were left out)", left_out_);
    left_out_ = 0;
    return text;
  }

 private:
  static constexpr double at_once = 10.0, per_s = 1.0;
  double tokens_ = at_once;
  double last_s_ = 0.0;
  std::uint64_t left_out_ = 0;
};

}  // namespace septet
