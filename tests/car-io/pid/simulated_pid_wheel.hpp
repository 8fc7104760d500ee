#pragma once
/// A wheel of HID PID as its maker would write it: a descriptor, and a firmware that knows by hand where its bytes lie.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"

namespace septet::car_io {

// clang-format off
inline constexpr std::uint8_t pid_wheel_descriptor[] = {
    0x05, 0x01, 0x09, 0x04, 0xa1, 0x01,                    // Generic Desktop, Joystick, Application
    0x85, 0x01,                                            //  Input 1: X, Y, eight buttons
    0x09, 0x30, 0x09, 0x31, 0x16, 0x01, 0x80, 0x26, 0xff, 0x7f, 0x75, 16, 0x95, 2, 0x81, 0x02,
    0x05, 0x09, 0x19, 1, 0x29, 8, 0x15, 0, 0x25, 1, 0x75, 1, 0x95, 8, 0x81, 0x02,
    0x05, 0x0f,                                            //  Physical Interface
    0x09, 0x21, 0xa1, 0x02, 0x85, 0x11,                    //  Output 0x11: Set Effect
    0x09, 0x22, 0x15, 1, 0x25, 40, 0x75, 8, 0x95, 1, 0x91, 0x02,                       // 1: block
    0x09, 0x25, 0xa1, 0x02, 0x09, 0x26, 0x09, 0x27, 0x09, 0x40, 0x09, 0x41, 0x09, 0x42, 0x09, 0x43,
    0x15, 1, 0x25, 6, 0x75, 8, 0x95, 1, 0x91, 0x00, 0xc0,                              // 2: type, one of six
    0x09, 0x50, 0x15, 0, 0x26, 0xff, 0x7f, 0x55, 0x0d, 0x66, 0x01, 0x10, 0x75, 16, 0x91, 0x02, 0x55, 0, 0x65, 0,  // 3: duration, ms
    0x09, 0x52, 0x26, 0xff, 0x00, 0x75, 8, 0x91, 0x02,                                 // 5: gain
    0x09, 0x53, 0x15, 1, 0x25, 8, 0x91, 0x02,                                          // 6: trigger button
    0x09, 0x55, 0xa1, 0x02, 0x05, 0x01, 0x09, 0x30, 0x15, 0, 0x25, 1, 0x75, 1, 0x91, 0x02, 0xc0,  // 7.0: axis
    0x05, 0x0f, 0x09, 0x56, 0x91, 0x02, 0x95, 6, 0x91, 0x03,                           // 7.1: direction enable, six to fill
    0x09, 0x57, 0xa1, 0x02, 0x0b, 0x01, 0x00, 0x0a, 0x00, 0x26, 0xff, 0x00, 0x75, 8, 0x95, 1, 0x91, 0x02, 0xc0,  // 8: direction
    0xc0,
    0x09, 0x5f, 0xa1, 0x02, 0x85, 0x13,                    //  Output 0x13: Set Condition
    0x09, 0x22, 0x15, 1, 0x25, 40, 0x91, 0x02,                                         // 1: block
    0x09, 0x23, 0x15, 0, 0x25, 3, 0x75, 4, 0x91, 0x02, 0x91, 0x03,                     // 2: axis, four to fill
    0x09, 0x60, 0x09, 0x61, 0x09, 0x62, 0x16, 0xf0, 0xd8, 0x26, 0x10, 0x27, 0x75, 16, 0x95, 3, 0x91, 0x02,  // 3, 5, 7: ±10000
    0x09, 0x63, 0x09, 0x64, 0x09, 0x65, 0x15, 0, 0x95, 3, 0x91, 0x02,                  // 9, 11, 13
    0xc0,
    0x09, 0x73, 0xa1, 0x02, 0x85, 0x15,                    //  Output 0x15: Set Constant Force
    0x09, 0x22, 0x15, 1, 0x25, 40, 0x75, 8, 0x95, 1, 0x91, 0x02,                       // 1: block
    0x09, 0x70, 0x16, 0xf0, 0xd8, 0x26, 0x10, 0x27, 0x75, 16, 0x91, 0x02,              // 2: magnitude, ±10000
    0xc0,
    0x09, 0x77, 0xa1, 0x02, 0x85, 0x1a,                    //  Output 0x1a: Effect Operation
    0x09, 0x22, 0x15, 1, 0x25, 40, 0x75, 8, 0x91, 0x02,                                // 1: block
    0x09, 0x78, 0xa1, 0x02, 0x09, 0x79, 0x09, 0x7a, 0x09, 0x7b, 0x25, 3, 0x91, 0x00, 0xc0,  // 2: start, start alone, stop
    0x09, 0x7c, 0x15, 0, 0x26, 0xff, 0x00, 0x91, 0x02,                                 // 3: how often
    0xc0,
    0x09, 0x95, 0xa1, 0x02, 0x85, 0x1c,                    //  Output 0x1c: Device Control
    0x09, 0x96, 0xa1, 0x02, 0x09, 0x97, 0x09, 0x98, 0x09, 0x99, 0x09, 0x9a, 0x15, 1, 0x25, 4, 0x91, 0x00, 0xc0,
    0xc0,
    0x09, 0x7d, 0xa1, 0x02, 0x85, 0x1d,                    //  Output 0x1d: Device Gain
    0x09, 0x7e, 0x15, 0, 0x26, 0xff, 0x00, 0x91, 0x02,
    0xc0,
    0x09, 0xab, 0xa1, 0x02, 0x85, 0x21,                    //  Feature 0x21: Create New Effect
    0x09, 0x25, 0xa1, 0x02, 0x09, 0x26, 0x09, 0x27, 0x09, 0x40, 0x09, 0x41, 0x09, 0x42, 0x09, 0x43,
    0x15, 1, 0x25, 6, 0xb1, 0x00, 0xc0,                                                // 1: type
    0xc0,
    0x09, 0x89, 0xa1, 0x02, 0x85, 0x22,                    //  Feature 0x22: Block Load
    0x09, 0x22, 0x15, 0, 0x25, 40, 0xb1, 0x02,                                         // 1: block
    0x09, 0x8b, 0xa1, 0x02, 0x09, 0x8c, 0x09, 0x8d, 0x09, 0x8e, 0x15, 1, 0x25, 3, 0xb1, 0x00, 0xc0,  // 2: success, full, error
    0xc0,
    0xc0};
// clang-format on

/// What the firmware does with the reports that reach it. Times are the caller's.
class SimulatedPidWheel {
 public:
  explicit SimulatedPidWheel(std::size_t room = 8) : room_(room) {}

  /// An output or a feature report; one of another length changes nothing and counts.
  void take(std::span<const std::byte> report, double now_s) {
    const auto u8 = [&](std::size_t at) { return std::to_integer<int>(report[at]); };
    const auto i16 = [&](std::size_t at) { return static_cast<std::int16_t>(u8(at) | u8(at + 1) << 8); };
    static const std::map<int, std::size_t> lengths = {{0x11, 9}, {0x13, 15}, {0x15, 4}, {0x1a, 4},
                                                       {0x1c, 2}, {0x1d, 2},  {0x21, 2}};
    const auto length = report.empty() ? lengths.end() : lengths.find(u8(0));
    if (length == lengths.end() || report.size() != length->second) {
      ++wrong_;
      return;
    }
    if (u8(0) == 0x1c) {
      if (u8(1) == 1) is_on_ = true;
      if (u8(1) == 3 || u8(1) == 4)
        for (auto& [id, effect] : effects_) effect.began_s.reset();
      if (u8(1) == 4) effects_.clear();
    } else if (u8(0) == 0x1d) {
      gain_ = u8(1) / 255.0;
    } else if (u8(0) == 0x21) {
      created_.reset();
      if (effects_.size() < room_) effects_[*(created_ = static_cast<int>(effects_.size()) + 1)] = {};
    } else {
      const auto found = effects_.find(u8(1));
      if (found == effects_.end()) {
        ++wrong_;
        return;
      }
      Effect& effect = found->second;
      if (u8(0) == 0x11) {
        effect.type = u8(2);
        effect.length_s = i16(3) / 1000.0;
        effect.gain = u8(5) / 255.0;
        // The way that it comes from, clockwise from ahead: 64 of 255 is from the right.
        effect.to_left = (u8(7) & 2) != 0 && std::abs(u8(8) - 64) <= 1 ? 1.0 : -1.0;
      } else if (u8(0) == 0x13) {
        effect.share = std::min(i16(5), i16(7)) / 10000.0;
      } else if (u8(0) == 0x15) {
        effect.share = i16(2) / 10000.0;
      } else if (u8(2) == 1) {
        effect.began_s = now_s;
      } else {
        effect.began_s.reset();
      }
    }
  }
  std::vector<std::byte> block_load() const {
    return {std::byte{0x22}, static_cast<std::byte>(created_.value_or(0)), std::byte(created_ ? 1 : 2)};
  }

  /// What plays now of a type (1 constant, 3 spring, 4 damper, 6 friction), a constant force to the left.
  double playing(int type, double now_s) const {
    double sum = 0.0;
    for (const auto& [id, effect] : effects_)
      if (is_on_ && effect.type == type && effect.began_s && now_s - *effect.began_s < effect.length_s)
        sum += gain_ * effect.gain * effect.share * (type == 1 ? effect.to_left : 1.0);
    return sum;
  }
  std::size_t effects() const { return effects_.size(); }
  int wrong() const { return wrong_; }

 private:
  struct Effect {
    int type = 0;
    double share = 0.0, gain = 0.0, length_s = 0.0, to_left = 0.0;
    std::optional<double> began_s;
  };
  std::size_t room_;
  std::map<int, Effect> effects_;
  std::optional<int> created_;
  bool is_on_ = false;
  double gain_ = 0.0;
  int wrong_ = 0;
};

}  // namespace septet::car_io
