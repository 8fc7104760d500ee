#include "sim-server/host/event_feed.hpp"

#include <algorithm>
#include <utility>

namespace septet::server {

void EventFeed::add(control::DriveEvent event) {
  event.number = ++count_;
  kept_.push_back(std::move(event));
  if (kept_.size() > most_events_kept) kept_.pop_front();
}

std::uint64_t EventFeed::join(std::uint32_t hearer) { return told_.try_emplace(hearer, count_).first->second; }

void EventFeed::pump(const std::function<void(std::uint32_t hearer, const control::DriveEvent&)>& tell) {
  const std::uint64_t gone = count_ - kept_.size();
  for (auto& [hearer, told] : told_) {
    told = std::max(told, gone);
    const std::uint64_t until = std::min(count_, told + most_events_per_pump);
    for (std::uint64_t number = told; number < until; ++number)
      tell(hearer, kept_[static_cast<std::size_t>(number - gone)]);
    told = until;
  }
}

}  // namespace septet::server
