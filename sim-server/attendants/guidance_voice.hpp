#pragma once
/// The voice of the driver's guidance: each word of a tick is spoken by espeak-ng, where installed, in the language of
/// the options. Without it the text on the instruments is all there is, which is said once.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim-server/drive/speaker.hpp"
#include "sim-server/host/attendant.hpp"

namespace septet::server {

class GuidanceVoice final : public Attendant {
 public:
  GuidanceVoice(Speaker speaker, std::string language) : speaker_(std::move(speaker)), language_(std::move(language)) {}

  void before_tick(const Moment& moment) override;
  void after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double shaking_share) override;
  std::vector<std::string> take_messages() override { return std::exchange(messages_, {}); }

 private:
  Speaker speaker_;
  std::string language_;
  std::uint32_t told_ = 0;  ///< Words so far.
  bool has_said_silent_ = false;
  std::vector<std::string> messages_;
};

}  // namespace septet::server
