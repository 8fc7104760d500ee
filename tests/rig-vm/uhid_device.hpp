#pragma once
/// A HID device made in user space (uhid): reports of any bytes in; output and feature reports as the kernel hands them
/// over.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <thread>

#include "engine/core/bytes.hpp"

namespace septet::rig_vm {

struct UhidIdentity {
  std::string name, serial;
  std::span<const std::uint8_t> descriptor;
  std::uint16_t vendor = 0, product = 0;
};

/// Answers of the device, each called from its own thread.
struct UhidAnswers {
  std::function<void(std::span<const std::byte>)> output;
  std::function<int(std::span<const std::byte>)> set_feature;  ///< Returns an errno, or 0.
  std::function<Bytes()> get_feature;
};

/// Is plugged in for as long as it lives. Its answers must live longer.
class UhidDevice {
 public:
  UhidDevice(const UhidIdentity& identity, UhidAnswers answers);
  ~UhidDevice();
  UhidDevice(const UhidDevice&) = delete;
  UhidDevice& operator=(const UhidDevice&) = delete;

  void send(std::span<const std::byte> report);

 private:
  void serve();
  int file_;
  UhidAnswers answers_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

}  // namespace septet::rig_vm
