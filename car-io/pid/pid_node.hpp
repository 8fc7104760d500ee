#pragma once
/// Motor of a wheel without force in the kernel's driver: the hidraw node of its HID device, and the reports that move
/// it.

#include <filesystem>
#include <optional>
#include <string>

#include "car-io/pid/pid_reports.hpp"

namespace septet::car_io {

struct PidNode {
  std::string node;  ///< "/dev/hidraw0".
  PidReports reports;
};
/// Node of the HID device that an input device ("event5") belongs to; empty without force of this class. Read from /sys
/// alone, which every user may.
std::optional<PidNode> find_pid_node(const std::string& event, const std::filesystem::path& sys,
                                     const std::filesystem::path& dev);

}  // namespace septet::car_io
