#pragma once
/// The person at a screen wants the drive to end: the server is told, however often the connection to it is lost meanwhile.

#include <cstdint>
#include <optional>

#include "sim-client/screen/screen_link.hpp"

namespace septet::screen {

class Departure {
 public:
  Departure(control::Quit::How how, double now_s) : how_(how), since_s_(now_s) {}

  /// To be called after each pump of the link, until the server has finished the drive. True: nobody is there to be told. A screen
  /// that was not given the processor waits on: only time in which it has listened in vain says that the server is gone.
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
  std::optional<std::uint32_t> told_welcome_;  ///< Of which connection the server has been told.
};

}  // namespace septet::screen
