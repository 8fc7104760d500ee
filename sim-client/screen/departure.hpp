#pragma once
/// Request of the person at a screen to end the drive: sent to the server, again after each lost connection.

#include <cstdint>
#include <optional>

#include "sim-client/link/screen_link.hpp"

namespace septet::screen {

class Departure {
 public:
  Departure(control::Quit::How how, double now_s) : how_(how), since_s_(now_s) {}

  /// Repeats the request on each new connection; call it after each pump of the link, until the server has finished the
  /// drive. True: no server is there to receive the request. A screen that was not given the processor waits on: only
  /// time spent listening in vain counts as the server's absence.
  bool is_in_vain(ScreenLink& link, double now_s) {
    if (link.state() == net::ClientState::connected && told_welcome_ != link.welcomes()) {
      link.send(control::Quit{how_}, net::Reliability::reliable);
      told_welcome_ = link.welcomes();
    }
    return now_s - since_s_ > 2.0 && link.server_is_gone();
  }

 private:
  control::Quit::How how_;
  double since_s_;
  std::optional<std::uint32_t> told_welcome_;  ///< Connection on which the server has received it.
};

}  // namespace septet::screen
