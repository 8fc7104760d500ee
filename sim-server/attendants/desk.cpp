#include "sim-server/attendants/desk.hpp"

#include <string>

#include <fmt/core.h>

#include "program/clock.hpp"
#include "program/console.hpp"
#include "sim-server/host/serve.hpp"

namespace septet::server {

Expected<void> Desk::begin() {
  desk_->log_to(log_.session());
  return {};
}

void Desk::before_tick(const Moment& moment) {
  desk_->attend(moment.newest, std::string(moment.doing), screens_of(host_), moment.now_s, moment.is_being_drawn);
  if (host_) host_->look_at(desk_->watched(), moment.now_s);
}

Wishes Desk::wishes() {
  return {.end = desk_->end_requested(),
          .stands_still = desk_->is_paused(),
          .goes_without_missing = desk_->told_to_go(),
          .word_to_driver = desk_->word()};
}

void Desk::close(ServeResult& result) {
  if (const auto& at_s = desk_->restart_at_s()) program::announce(fmt::format("begin_at {}", *at_s));
  desk_->show_end(fmt::format("ended: {}", text_of(result.end)), screens_of(host_), program::monotonic_s());
}

}  // namespace septet::server
