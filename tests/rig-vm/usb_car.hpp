#pragma once
/// Septet's car as a USB device of this machine, in place of a microcontroller, behind the kernel's own USB stack
/// (dummy_hcd, FunctionFS).
///
/// It sends its controls 125 times a second while it is read, takes output reports, keeps a watchdog (feature report
/// 3), and can be unplugged. As a HID device it has REPORTS.md's descriptor and interrupt endpoints; otherwise it is a
/// vendor device with bulk endpoints.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "car-io/car_report.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::rig_vm {

class UsbCar {
 public:
  enum class Kind : std::uint8_t { hid, vendor };
  explicit UsbCar(Kind kind, const std::string& serial = "VM-1");
  ~UsbCar();
  UsbCar(const UsbCar&) = delete;
  UsbCar& operator=(const UsbCar&) = delete;

  void plug();
  void unplug();
  void set(const DriverInput& input, const car_io::CarSwitches& switches = {});
  /// Simulates a hung firmware: takes no more output reports.
  void hang(bool is_hanging) { is_hanging_ = is_hanging; }

  /// Present state of fan, shaker and wheel: the last command, or zero after the watchdog.
  car_io::Actuators actuators();
  std::uint16_t watchdog_ms();
  std::uint64_t outputs();

 private:
  struct Request;
  void answer_requests();
  void answer(const Request& request);
  void take_outputs();
  void send_inputs();
  void take(std::span<const std::byte> report);

  Kind kind_;
  int control_ = -1, in_ = -1, out_ = -1;
  bool is_plugged_ = false;
  std::atomic<bool> is_ending_ = false, is_hanging_ = false;

  std::mutex mutex_;  ///< Guards the members below.
  DriverInput input_;
  car_io::CarSwitches switches_;
  car_io::DeviceStatus status_{.firmware = 0x0102, .watchdog_ms = 1000};
  car_io::Actuators actuators_;
  double output_at_s_ = 0.0;
  std::uint64_t outputs_ = 0;

  std::vector<std::thread> threads_;
};

}  // namespace septet::rig_vm
