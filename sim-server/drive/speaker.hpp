#pragma once
/// Speaks sentences by espeak-ng, if installed, on this machine's sound device, one after the other, without blocking.

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "program/child_process.hpp"

namespace septet::server {

class Speaker {
 public:
  /// `program`: espeak-ng, or a program with the same arguments; empty: not installed, and nothing is spoken.
  explicit Speaker(std::optional<std::filesystem::path> program) : program_(std::move(program)) {}

  bool is_there() const { return program_.has_value(); }
  /// `language`: "en", "de", "sv"; any other is spoken in English. Beyond `most_waiting`, sentences are dropped.
  void say(const std::string& text, const std::string& language);
  /// Starts the next sentence after the last one. Returns, once, the reason if speaking fails.
  std::optional<std::string> attend();

  static constexpr std::size_t most_waiting = 4;

 private:
  struct Sentence {
    std::string text, language;
  };
  std::optional<std::filesystem::path> program_;
  std::deque<Sentence> waiting_;
  std::optional<program::ChildProcess> speaking_;
  bool has_complained_ = false;
};

}  // namespace septet::server
