#pragma once
/// The server's loop beside a simulated rig: its clock, and an attendant that keeps the messages.

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim-server/host/serve.hpp"
#include "tests/pipeline/simulated_rig.hpp"

namespace septet {

/// Each wait of the loop lets a millisecond of the rig go by; then `each_ms` looks at it.
class RigClock final : public server::ServeClock {
 public:
  RigClock(SimulatedRig& rig, std::function<void()> each_ms) : rig_(rig), each_ms_(std::move(each_ms)) {}
  double now_s() const override { return rig_.server_clock_s(); }
  void wait(double) override {
    rig_.advance_1ms();
    each_ms_();
  }

 private:
  SimulatedRig& rig_;
  std::function<void()> each_ms_;
};

class Listener final : public server::Attendant {
 public:
  explicit Listener(std::vector<std::string>& messages) : messages_(messages) {}
  void hear(const server::Message& message) override { messages_.push_back(message.text); }

 private:
  std::vector<std::string>& messages_;
};

inline server::Attendants one_attendant(std::unique_ptr<server::Attendant> attendant) {
  server::Attendants attendants;
  attendants.push_back(std::move(attendant));
  return attendants;
}

/// All screens of the rig answer the drive's end.
inline void report_all(SimulatedRig& rig) {
  for (std::size_t i = 0; i < rig.size(); ++i) rig.screen(i).link->report({});
}

}  // namespace septet
