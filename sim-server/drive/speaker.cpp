#include "sim-server/drive/speaker.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace septet::server {
namespace {

constexpr std::array<std::string_view, 3> voices{"en", "de", "sv"};

}  // namespace

void Speaker::say(const std::string& text, const std::string& language) {
  if (!program_ || text.empty() || waiting_.size() >= most_waiting) return;
  const bool is_known = std::ranges::find(voices, language) != voices.end();
  waiting_.push_back({text, is_known ? language : "en"});
}

std::optional<std::string> Speaker::attend() {
  std::optional<std::string> trouble;
  if (speaking_) {
    const auto exit = speaking_->poll();
    if (!exit) return std::nullopt;
    speaking_.reset();
    if (exit->code != 0) trouble = "espeak-ng could not speak; words to the student are text alone";
  }
  if (!waiting_.empty()) {
    const Sentence next = std::move(waiting_.front());
    waiting_.pop_front();
    // The "--" makes a text that begins with a hyphen no option.
    auto started = program::ChildProcess::start({.program = program_->string(),
                                                 .arguments = {"-v", next.language, "--", next.text},
                                                 .environment = {},
                                                 .log = "/dev/null"});
    if (started)
      speaking_.emplace(std::move(*started));
    else
      trouble = describe(started.error());
  }
  if (!trouble || std::exchange(has_complained_, true)) return std::nullopt;
  return trouble;
}

}  // namespace septet::server
