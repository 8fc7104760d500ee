#pragma once
/// The person at a screen wants the world to stand still, or to go on: the server is told, on each new connection again, until its notice
/// says that it is so.

#include <cstdint>
#include <optional>

#include "sim-client/screen/screen_link.hpp"

namespace septet::screen {

class PauseRequest {
 public:
  /// The other way round from how it is.
  void toggle(const ScreenLink& link) {
    wanted_ = !link.notice().paused;
    told_welcome_.reset();
  }
  /// It has been asked for, and may not be so yet.
  bool is_pausing() const { return wanted_.value_or(false); }
  /// To be called after each pump of the link.
  void tell(ScreenLink& link) {
    if (!wanted_) return;
    if (told_welcome_ && link.notice().paused == *wanted_) return wanted_.reset();
    if (link.state() != net::ClientState::connected || told_welcome_ == link.welcomes()) return;
    link.send(control::Pause{*wanted_}, net::Reliability::reliable);
    told_welcome_ = link.welcomes();
  }

 private:
  std::optional<bool> wanted_;
  std::optional<std::uint32_t> told_welcome_;  ///< Of which connection the server has been told.
};

}  // namespace septet::screen
