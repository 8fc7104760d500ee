#pragma once
/// A CAN bus without hardware: sent frames are kept, frames to be heard are given.

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "car-io/can/can_bus.hpp"

namespace septet::car_io {

struct SimulatedCanBus {
  std::vector<CanFrame> sent;
  std::deque<CanFrame> waiting;
  bool is_up = true, is_full = false;
  std::optional<CanNotice> notice;
  int opened = 0;

  OpenCanBus opener() {
    return [this]() -> Expected<std::unique_ptr<CanBus>> {
      if (!is_up) return failure("the interface is down", "CAN interface test0", "up");
      ++opened;
      return std::make_unique<Open>(*this);
    };
  }

 private:
  struct Open final : CanBus {
    explicit Open(SimulatedCanBus& of) : bus(of) {}
    Expected<bool> send(const CanFrame& frame) override {
      if (!bus.is_up) return failure("sending failed: Network is down", "CAN interface test0", "up");
      if (!bus.is_full) bus.sent.push_back(frame);
      return !bus.is_full;
    }
    Expected<std::optional<CanFrame>> receive() override {
      if (!bus.is_up) return failure("reading failed: Network is down", "CAN interface test0", "up");
      if (bus.waiting.empty()) return std::nullopt;
      const CanFrame frame = bus.waiting.front();
      bus.waiting.pop_front();
      return frame;
    }
    std::optional<CanNotice> take_notice() override { return std::exchange(bus.notice, std::nullopt); }
    SimulatedCanBus& bus;
  };
};

}  // namespace septet::car_io
