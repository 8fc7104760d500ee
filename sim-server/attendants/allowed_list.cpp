#include "sim-server/attendants/allowed_list.hpp"

#include <fmt/core.h>

namespace septet::server {

void AllowedList::before_tick(const Moment& moment) {
  auto list = watch_.changed(moment.now_s);
  if (!list) return;
  if (!*list) {
    messages_.push_back(
        fmt::format("allowed-clients has changed, and the old list still holds: {}", describe(list->error())));
    return;
  }
  messages_.push_back(fmt::format("allowed-clients has changed: {} clients may connect", (*list)->size()));
  host_.set_allowed(std::move(**list));
}

}  // namespace septet::server
