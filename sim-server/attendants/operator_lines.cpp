#include "sim-server/attendants/operator_lines.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include <fmt/core.h>

#include "sim-server/drive/operated.hpp"

namespace septet::server {
namespace {

/// What stands behind a first word; empty: the line begins with another one.
std::optional<std::string_view> behind(std::string_view line, std::string_view word) {
  if (!line.starts_with(word) || (line.size() > word.size() && line[word.size()] != ' ')) return std::nullopt;
  line.remove_prefix(word.size());
  return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

}  // namespace

void OperatorLines::before_tick(const Moment& moment) {
  if (pauser_ && !host_.has(pauser_->client)) go_on(pauser_->name);
  if (moment.is_being_drawn) return;
  const Tick from = gate_ ? gate_->shown_from(moment.doing) : 0;
  for (const OperatorRequest& request : host_.take_operator_requests()) {
    const auto why_not = fulfil(request, from);
    host_.answer(request, why_not, request.line == "undo" ? from : drive_.live ? drive_.live->state().tick : 0);
  }
}

void OperatorLines::after_tick(const std::shared_ptr<const TakenSnapshot>&, double) {
  if (ticks_to_go_ > 0) --ticks_to_go_;
}

std::optional<std::string> OperatorLines::fulfil(const OperatorRequest& request, Tick from) {
  if (!gate_ || !log_) return "a session that is shown again cannot be operated";
  const net::Rights rights = host_.rights_of(request.name);
  if (!rights.may_operate && !(request.line == "undo" && rights.edit))
    return "the right to do this was taken from this key";
  const std::string_view line = request.line;
  if (const auto text = behind(line, "mark")) {
    note(request.name, "mark", *text);
  } else if (line == "pause") {
    return pause(request, 0);
  } else if (const auto count = behind(line, "step")) {
    std::uint64_t ticks = 1;
    const auto [end, error] = std::from_chars(count->data(), count->data() + count->size(), ticks);
    if (!count->empty() && (error != std::errc() || end != count->data() + count->size() || ticks == 0))
      return "step is followed by a number of ticks";
    return pause(request, ticks);
  } else if (line == "go_on") {
    if (!pauser_) return "no line has paused the drive";
    go_on(request.name);
  } else {
    Author author{request.name, std::nullopt};
    if (rights.edit) author.editor = Editor{request.name, *rights.edit, 0};
    const auto done = do_command(line, author, from, *gate_);
    if (!done) return done.error().what;
    if (!done->empty()) note(request.name, "operator", *done);
  }
  return std::nullopt;
}

std::optional<std::string> OperatorLines::pause(const OperatorRequest& request, std::uint64_t ticks) {
  if (pauser_ && pauser_->client != request.client) return fmt::format("{} has paused the drive", pauser_->name);
  if (!pauser_) note(request.name, "operator", "pause");
  pauser_ = request;
  ticks_to_go_ = ticks;
  return std::nullopt;
}

void OperatorLines::go_on(const std::string& name) {
  pauser_.reset();
  ticks_to_go_ = 0;
  note(name, "operator", "go_on");
}

void OperatorLines::note(const std::string& name, const char* kind, std::string_view what) {
  note_operator(name, kind, what, log_->session());
}

}  // namespace septet::server
