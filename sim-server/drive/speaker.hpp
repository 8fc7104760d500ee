#pragma once
/// Says sentences aloud by espeak-ng, where that is installed, on the sound device of this machine; one after the other. Nobody waits for it.

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "program/child_process.hpp"

namespace septet::server {

class Speaker {
 public:
  /// `program`: espeak-ng, or what takes the same arguments; nothing: it is not installed, and nothing is said.
  explicit Speaker(std::optional<std::filesystem::path> program) : program_(std::move(program)) {}

  bool is_there() const { return program_.has_value(); }
  /// `language`: "en", "de", "sv"; any other is English. What would wait behind `most_waiting` is left out.
  void say(const std::string& text, const std::string& language);
  /// Begins the next sentence once the last one is over. Answers, once, why nothing is heard.
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
