#include "sim-client/link/heard_events.hpp"

namespace septet::screen {

void HeardEvents::begin(std::uint64_t count) {
  if (number_ && count > *number_) dropped_ += count - *number_;
  number_ = count;
  is_heard_ = true;
}

void HeardEvents::take(control::DriveEvent event) {
  if (!is_heard_ || !number_ || event.number <= *number_) return;
  dropped_ += event.number - *number_ - 1;
  number_ = event.number;
  if (events_.size() < most_heard_events)
    events_.push_back(std::move(event));
  else
    ++dropped_;
}

}  // namespace septet::screen
