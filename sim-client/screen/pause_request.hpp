#pragma once
/// Request of the person at a screen to pause or resume the world: sent to the server, again on each new connection,
/// until its notice confirms it.

#include <cstdint>
#include <optional>

#include "sim-client/link/screen_link.hpp"

namespace septet::screen {

class PauseRequest {
 public:
  /// Requests the opposite of the present state.
  void toggle(const ScreenLink& link) {
    wanted_ = !link.notice().paused;
    told_welcome_.reset();
  }
  /// True if a pause has been requested; it may not be in effect yet.
  bool is_pausing() const { return wanted_.value_or(false); }
  /// Sends the request until it is confirmed; call it after each pump of the link.
  void tell(ScreenLink& link) {
    if (!wanted_) return;
    if (told_welcome_ && link.notice().paused == *wanted_) return wanted_.reset();
    if (link.state() != net::ClientState::connected || told_welcome_ == link.welcomes()) return;
    link.send(control::Pause{*wanted_}, net::Reliability::reliable);
    told_welcome_ = link.welcomes();
  }

 private:
  std::optional<bool> wanted_;
  std::optional<std::uint32_t> told_welcome_;  ///< Connection on which the server has received it.
};

}  // namespace septet::screen
