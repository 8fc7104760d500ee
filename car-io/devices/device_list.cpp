#include "car-io/devices/device_list.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "car-io/pid/pid_node.hpp"
#include "engine/core/printable.hpp"

namespace septet::car_io {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_name = 80;
constexpr std::size_t most_of_a_kind = 256;

/// The first line of a file of /sys, at most a page of it.
std::string line_of(const fs::path& file) {
  std::ifstream stream(file);
  std::string line(4096, '\0');
  stream.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(stream.gcount()));
  return line.substr(0, line.find('\n'));
}

/// KEY=VALUE of a uevent file.
std::string value_of(const fs::path& uevent, std::string_view key) {
  std::ifstream stream(uevent);
  int lines = 0;
  for (std::string line; lines < 100 && std::getline(stream, line); ++lines)
    if (line.size() > key.size() && line.starts_with(key) && line[key.size()] == '=')
      return line.substr(key.size() + 1);
  return {};
}

std::uint64_t hex(std::string_view text) {
  std::uint64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

std::uint16_t id_of(const fs::path& file) { return static_cast<std::uint16_t>(hex(line_of(file)) & 0xFFFFu); }

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end && found.size() < most_of_a_kind;
       i.increment(error))
    found.push_back(i->path());
  return found;
}

/// Bit of a bitmap of /sys: hexadecimal words of 64 bits, the highest first.
bool has_bit(const std::string& bitmap, std::size_t bit) {
  std::vector<std::uint64_t> words;
  for (std::size_t begin = 0; begin < bitmap.size();) {
    const auto end = std::min(bitmap.find(' ', begin), bitmap.size());
    if (end > begin) words.push_back(hex(std::string_view(bitmap).substr(begin, end - begin)));
    begin = end + 1;
  }
  const std::size_t word = bit / 64;
  return word < words.size() && (words[words.size() - 1 - word] >> bit % 64 & 1u) != 0;
}

bool may_open(const std::string& node) { return access(node.c_str(), R_OK | W_OK) == 0; }

constexpr const char* access_for = R"(MODE="0660", GROUP="plugdev", TAG+="uaccess")";

std::string hidraw_rule(const FoundDevice& device) {
  return fmt::format(R"(SUBSYSTEM=="hidraw", KERNELS=="0003:{:04X}:{:04X}.*", {})", device.vendor_id, device.product_id,
                     access_for);
}

void ask_whether_it_may_be_opened(FoundDevice& device) {
  device.may_be_opened = may_open(device.node);
  if (!device.may_be_opened)
    device.remedy =
        device.vendor_id != 0 ? udev_rule(device) : "sudo usermod -aG input,audio,plugdev $USER, and log in again";
}

void find_hid(const fs::path& sys, const fs::path& dev, std::vector<FoundDevice>& found) {
  for (const fs::path& entry : entries(sys / "class/hidraw")) {
    const fs::path uevent = entry / "device/uevent";
    // BUS:VENDOR:PRODUCT, hexadecimal.
    const std::string id = value_of(uevent, "HID_ID");
    FoundDevice device{.kind = DeviceKind::hid, .node = (dev / entry.filename()).string()};
    if (const auto first = id.find(':'), second = id.rfind(':'); first != std::string::npos && second > first) {
      device.vendor_id =
          static_cast<std::uint16_t>(hex(std::string_view(id).substr(first + 1, second - first - 1)) & 0xFFFFu);
      device.product_id = static_cast<std::uint16_t>(hex(std::string_view(id).substr(second + 1)) & 0xFFFFu);
    }
    device.name = value_of(uevent, "HID_NAME");
    device.serial = value_of(uevent, "HID_UNIQ");
    if (device.vendor_id == 0x1209 && device.product_id == 0x0001) device.detail = "layout septet-car";
    if (device.vendor_id == 0x046d && device.product_id == 0xc24f) device.detail = "layout logitech-g29";
    ask_whether_it_may_be_opened(device);
    found.push_back(std::move(device));
  }
}

/// Path to its motor: evdev's constant force if the kernel's driver has it, HID PID reports otherwise. A rumble is no
/// motor.
void describe_motor(FoundDevice& device, const std::string& effects, const std::optional<PidNode>& pid) {
  constexpr std::size_t constant = 0x52;
  constexpr std::pair<std::size_t, const char*> others[] = {{0x53, "spring"}, {0x55, "damper"}, {0x54, "friction"}};
  if (has_bit(effects, constant)) {
    device.detail = "force by evdev: constant";
    for (const auto& [bit, name] : others)
      if (has_bit(effects, bit)) device.detail += std::string(", ") + name;
    return;
  }
  if (!pid) return;
  device.motor_node = pid->node;
  device.detail = "force by HID PID through " + pid->node;
  if (may_open(pid->node)) return;
  device.detail += ", which MAY NOT BE OPENED";
  device.remedy += (device.remedy.empty() ? "" : "\n") + hidraw_rule(device);
}

/// Input devices with an axis and a joystick's or a gamepad's button, or with a wheel's axis.
void find_joysticks(const fs::path& sys, const fs::path& dev, std::vector<FoundDevice>& found) {
  constexpr std::size_t abs_x = 0, abs_wheel = 8, abs_gas = 9;
  constexpr std::size_t first_button = 0x120, last_button = 0x13f, first_gear_button = 0x150;
  for (const fs::path& entry : entries(sys / "class/input")) {
    if (!entry.filename().string().starts_with("event")) continue;
    const std::string axes = line_of(entry / "device/capabilities/abs"),
                      keys = line_of(entry / "device/capabilities/key");
    bool has_button = has_bit(keys, first_gear_button);
    for (std::size_t button = first_button; button <= last_button; ++button) has_button |= has_bit(keys, button);
    if (!(has_bit(axes, abs_x) && has_button) && !has_bit(axes, abs_wheel) && !has_bit(axes, abs_gas)) continue;
    FoundDevice device{.kind = DeviceKind::joystick, .node = (dev / "input" / entry.filename()).string()};
    device.name = line_of(entry / "device/name");
    device.serial = line_of(entry / "device/uniq");
    device.vendor_id = id_of(entry / "device/id/vendor");
    device.product_id = id_of(entry / "device/id/product");
    ask_whether_it_may_be_opened(device);
    describe_motor(device, line_of(entry / "device/capabilities/ff"),
                   find_pid_node(entry.filename().string(), sys, dev));
    found.push_back(std::move(device));
  }
}

void find_usb(const fs::path& sys, const fs::path& dev, std::vector<FoundDevice>& found) {
  for (const fs::path& entry : entries(sys / "bus/usb/devices")) {
    constexpr std::uint64_t hub = 0x09;
    const std::string vendor = line_of(entry / "idVendor");
    if (vendor.empty() || hex(line_of(entry / "bDeviceClass")) == hub) continue;
    FoundDevice device{.kind = DeviceKind::usb};
    int bus = 0, number = 0;
    const std::string bus_text = line_of(entry / "busnum"), number_text = line_of(entry / "devnum");
    std::from_chars(bus_text.data(), bus_text.data() + bus_text.size(), bus);
    std::from_chars(number_text.data(), number_text.data() + number_text.size(), number);
    device.node = (dev / "bus/usb" / fmt::format("{:03}", bus) / fmt::format("{:03}", number)).string();
    device.vendor_id = id_of(entry / "idVendor");
    device.product_id = id_of(entry / "idProduct");
    device.name = line_of(entry / "manufacturer");
    const std::string product = line_of(entry / "product");
    device.name += (device.name.empty() || product.empty() ? "" : " ") + product;
    device.serial = line_of(entry / "serial");
    ask_whether_it_may_be_opened(device);
    found.push_back(std::move(device));
  }
}

void find_can(const fs::path& sys, std::vector<FoundDevice>& found) {
  for (const fs::path& entry : entries(sys / "class/net")) {
    if (line_of(entry / "type") != "280") continue;  // ARPHRD_CAN.
    FoundDevice device{.kind = DeviceKind::can, .node = entry.filename().string()};
    device.name = entry.filename().string().starts_with("v") ? "virtual CAN" : "CAN";
    const bool is_up = (hex([&] {
                          std::string flags = line_of(entry / "flags");
                          return flags.starts_with("0x") ? flags.substr(2) : flags;
                        }()) &
                        1u) != 0;
    device.detail = std::string(is_up ? "up" : "down") + (line_of(entry / "mtu") == "72" ? ", CAN FD" : "");
    if (!is_up)
      device.remedy = fmt::format("sudo ip link set {} up (first its bit rate: car-io/can/README.md)", device.node);
    found.push_back(std::move(device));
  }
}

void find_sound(const fs::path& sys, const fs::path& dev, std::vector<FoundDevice>& found) {
  for (const fs::path& entry : entries(sys / "class/sound")) {
    const std::string file = entry.filename().string();
    // pcmC0D3p: the fourth device of the first card plays.
    if (!file.starts_with("pcmC") || !file.ends_with("p")) continue;
    const std::string card = file.substr(4, file.find('D') == std::string::npos ? 0 : file.find('D') - 4);
    FoundDevice device{.kind = DeviceKind::sound, .node = (dev / "snd" / file).string()};
    device.name = line_of(sys / "class/sound" / ("card" + card) / "id");
    ask_whether_it_may_be_opened(device);
    found.push_back(std::move(device));
  }
}

/// Adds to a hidraw node the device that it belongs to.
void name_motors(std::vector<FoundDevice>& found) {
  for (const FoundDevice& wheel : found)
    for (FoundDevice& device : found)
      if (!wheel.motor_node.empty() && device.kind == DeviceKind::hid && device.node == wheel.motor_node)
        device.detail += (device.detail.empty() ? "motor of " : ", motor of ") + wheel.node;
}

constexpr std::string_view kind_names[] = {"HID", "joystick", "USB", "CAN", "sound"};

}  // namespace

std::string udev_rule(const FoundDevice& device) {
  switch (device.kind) {
    case DeviceKind::hid:
      return hidraw_rule(device);
    case DeviceKind::joystick:
      return fmt::format(R"(SUBSYSTEM=="input", ATTRS{{id/vendor}}=="{:04x}", ATTRS{{id/product}}=="{:04x}", {})",
                         device.vendor_id, device.product_id, access_for);
    case DeviceKind::usb:
      return fmt::format(R"(SUBSYSTEM=="usb", ATTR{{idVendor}}=="{:04x}", ATTR{{idProduct}}=="{:04x}", {})",
                         device.vendor_id, device.product_id, access_for);
    case DeviceKind::can:
    case DeviceKind::sound:
      break;
  }
  return {};
}

std::vector<FoundDevice> list_devices(const fs::path& sys, const fs::path& dev) {
  std::vector<FoundDevice> found;
  find_hid(sys, dev, found);
  find_joysticks(sys, dev, found);
  find_usb(sys, dev, found);
  find_can(sys, found);
  find_sound(sys, dev, found);
  name_motors(found);
  for (FoundDevice& device : found)
    for (std::string* text : {&device.node, &device.name, &device.serial}) *text = printable(*text, longest_name);
  std::ranges::sort(found, {}, [](const FoundDevice& device) {
    return std::tuple(device.kind, device.node.size(), device.node);  // hidraw9 before hidraw10.
  });
  return found;
}

std::string device_table(const std::vector<FoundDevice>& devices) {
  if (devices.empty()) return "Nothing that a rig may use is connected.\n";
  std::size_t node_width = 0, name_width = 0;
  for (const FoundDevice& device : devices) {
    node_width = std::max(node_width, device.node.size());
    name_width = std::max(name_width, device.name.size());
  }
  std::string table;
  bool names_a_rule = false;
  for (const FoundDevice& device : devices) {
    const std::string ids =
        device.vendor_id != 0 ? fmt::format("{:04x}:{:04x}", device.vendor_id, device.product_id) : "";
    std::string line = fmt::format("{:<8}  {:<{}}  {:<9}  {:<{}}", kind_names[static_cast<std::size_t>(device.kind)],
                                   device.node, node_width, ids, device.name, name_width);
    if (!device.serial.empty()) line += "  serial " + device.serial;
    if (!device.detail.empty()) line += "  " + device.detail;
    if (!device.may_be_opened) line += "  MAY NOT BE OPENED";
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
    std::istringstream remedies(device.remedy);
    for (std::string remedy; std::getline(remedies, remedy);) table += "          " + remedy + "\n";
    names_a_rule |= device.remedy.find("SUBSYSTEM") != std::string::npos;
  }
  if (names_a_rule)
    table +=
        "\nA line that begins with SUBSYSTEM is a udev rule: put it into /etc/udev/rules.d/70-rig.rules, then\n"
        "sudo udevadm control --reload, and plug the device in again.\n";
  return table;
}

}  // namespace septet::car_io
