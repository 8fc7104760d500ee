#include "car-io/devices/device_list.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "tests/car-io/pid/simulated_pid_wheel.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::car_io {
namespace {

namespace fs = std::filesystem;

/// A machine's /sys and /dev as files.
struct Machine {
  TemporaryFolder folder;
  fs::path sys = folder / "sys", dev = folder / "dev";

  void file(const fs::path& path, const std::string& text) const {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::vector<FoundDevice> list() const { return list_devices(sys, dev); }
};

}  // namespace

TEST_CASE("HID devices are listed with what opens them and the rule for those that may not be opened") {
  const Machine machine;
  machine.file(machine.sys / "class/hidraw/hidraw10/device/uevent",
               "HID_ID=0003:00001209:00000001\nHID_NAME=Septet car\nHID_UNIQ=S80-1\n");
  machine.file(machine.sys / "class/hidraw/hidraw9/device/uevent",
               "DRIVER=x\nHID_ID=0003:0000046D:0000C24F\nHID_NAME=G29\x1b[2J\n");
  machine.file(machine.dev / "hidraw10", "");
  const auto found = machine.list();
  REQUIRE(found.size() == 2);
  CHECK((found[0].node.ends_with("hidraw9") && found[0].detail == "layout logitech-g29"));
  CHECK(found[0].name == "G29\\x1b[2J");
  CHECK_FALSE(found[0].may_be_opened);
  CHECK(found[0].remedy ==
        R"(SUBSYSTEM=="hidraw", KERNELS=="0003:046D:C24F.*", MODE="0660", GROUP="plugdev", TAG+="uaccess")");
  CHECK((found[1].serial == "S80-1" && found[1].detail == "layout septet-car" && found[1].may_be_opened));
  const std::string table = device_table(found);
  CHECK(table.find("046d:c24f  G29\\x1b[2J") != std::string::npos);
  CHECK(table.find("MAY NOT BE OPENED\n          SUBSYSTEM==") != std::string::npos);
  CHECK(table.find("70-rig.rules") != std::string::npos);
}

TEST_CASE("of input devices wheels and joysticks are listed and no keyboard or mouse") {
  const Machine machine;
  const auto input = [&](const std::string& name, const std::string& axes, const std::string& keys,
                         const std::string& effects) {
    const fs::path device = machine.sys / "class/input" / name / "device";
    machine.file(device / "name", "device " + name + "\n");
    machine.file(device / "id/vendor", "0eb7\n");
    machine.file(device / "id/product", "0006\n");
    machine.file(device / "capabilities/abs", axes + "\n");
    machine.file(device / "capabilities/key", keys + "\n");
    machine.file(device / "capabilities/ff", effects + "\n");
  };
  input("event0", "0", "402000000 3803078f800d001 feffffdfffefffff fffffffffffffffe", "0");  // A keyboard.
  input("event1", "0", "70000 0 0 0 0", "0");                                                // A mouse.
  input("event2", "30007", "ffff00000000 0 0 0 0", "300040000 0");  // A wheel: X, Y, Z; joystick buttons.
  input("event3", "100", "0", "0");                                 // ABS_WHEEL alone.
  input("js0", "30007", "ffff00000000 0 0 0 0", "0");               // Another view of event2.
  const auto found = machine.list();
  REQUIRE(found.size() == 2);
  CHECK((found[0].node.ends_with("input/event2") && found[0].detail == "force by evdev: constant" &&
         found[0].vendor_id == 0x0eb7));
  CHECK((found[1].node.ends_with("input/event3") && found[1].detail.empty()));
}

TEST_CASE("of a wheel it is said whether evdev or HID PID moves it and what rule lets the motor be reached") {
  const Machine machine;
  const auto wheel = [&](int number, const std::string& effects, bool is_pid) {
    const fs::path input = machine.sys / fmt::format("class/input/event{}/device", number);
    machine.file(input / "name", "wheel\n");
    machine.file(input / "id/vendor", "346e\n");
    machine.file(input / "id/product", fmt::format("000{}\n", number));
    machine.file(input / "capabilities/abs", "1\n");
    machine.file(input / "capabilities/key", "ffff00000000 0 0 0 0\n");
    machine.file(input / "capabilities/ff", effects + "\n");
    const std::string descriptor(reinterpret_cast<const char*>(pid_wheel_descriptor), sizeof pid_wheel_descriptor);
    machine.file(input / "device/report_descriptor", is_pid ? descriptor : descriptor.substr(0, 100));
    machine.file(input / fmt::format("device/hidraw/hidraw{}/dev", number), "");
    machine.file(machine.sys / fmt::format("class/hidraw/hidraw{}/device/uevent", number),
                 fmt::format("HID_ID=0003:0000346E:0000000{}\n", number));
    machine.file(machine.dev / fmt::format("input/event{}", number), "");
  };
  wheel(1, "f00000000 0", false);  // A plain gamepad.
  wheel(2, "0", true);             // One without force in the kernel's driver.
  wheel(3, "0", true);             // Another, which may be opened.
  wheel(4, "3003c0000 0", true);   // One with force in the kernel's driver: by evdev.
  wheel(5, "107030000 0", false);  // A gamepad that rumbles.
  machine.file(machine.dev / "hidraw3", "");
  const auto found = machine.list();
  REQUIRE(found.size() == 10);
  const std::string hidraw = (machine.dev / "hidraw").string();
  const auto by_pid = "force by HID PID through " + printable(hidraw, 80);
  const FoundDevice *hid = found.data(), *wheels = found.data() + 5;
  CHECK((wheels[0].detail.empty() && wheels[0].motor_node.empty() && hid[0].detail.empty()));
  CHECK(wheels[1].detail == by_pid + "2, which MAY NOT BE OPENED");
  CHECK(wheels[1].may_be_opened);
  CHECK(wheels[1].remedy ==
        R"(SUBSYSTEM=="hidraw", KERNELS=="0003:346E:0002.*", MODE="0660", GROUP="plugdev", TAG+="uaccess")");
  CHECK(hid[1].detail == "motor of " + (machine.dev / "input/event2").string());
  CHECK(wheels[2].detail == by_pid + "3");
  CHECK((wheels[2].remedy.empty() && hid[2].may_be_opened));
  CHECK(wheels[3].detail == "force by evdev: constant, spring, damper, friction");
  CHECK((wheels[3].motor_node.empty() && hid[3].detail.empty()));
  CHECK(wheels[4].detail.empty());
  // Neither of the two may be opened: both rules, each on its line.
  fs::remove(machine.dev / "input/event2");
  const std::string table = device_table(machine.list());
  CHECK(table.find("\n          SUBSYSTEM==\"input\", ATTRS{id/vendor}==\"346e\", ATTRS{id/product}==\"0002\"") !=
        std::string::npos);
  CHECK(table.find("TAG+=\"uaccess\"\n          SUBSYSTEM==\"hidraw\"") != std::string::npos);
}

TEST_CASE("USB devices CAN interfaces and sound cards are listed and hubs and other networks are not") {
  const Machine machine;
  const auto usb = [&](const std::string& name, const std::string& kind) {
    const fs::path device = machine.sys / "bus/usb/devices" / name;
    machine.file(device / "idVendor", "1209\n");
    machine.file(device / "idProduct", "abcd\n");
    machine.file(device / "bDeviceClass", kind + "\n");
    machine.file(device / "busnum", "1\n");
    machine.file(device / "devnum", "17\n");
    machine.file(device / "product", "Pedals\n");
  };
  usb("1-1", "00");
  usb("usb1", "09");
  machine.file(machine.sys / "bus/usb/devices/1-1:1.0/bInterfaceClass", "ff\n");
  const auto net = [&](const std::string& name, const std::string& type, const std::string& flags,
                       const std::string& mtu) {
    machine.file(machine.sys / "class/net" / name / "type", type + "\n");
    machine.file(machine.sys / "class/net" / name / "flags", flags + "\n");
    machine.file(machine.sys / "class/net" / name / "mtu", mtu + "\n");
  };
  net("can0", "280", "0x40080", "16");
  net("vcan0", "280", "0x400c1", "72");
  net("eth0", "1", "0x1003", "1500");
  machine.file(machine.sys / "class/sound/card0/id", "PCH\n");
  machine.file(machine.sys / "class/sound/pcmC0D3p/dev", "116:3\n");
  machine.file(machine.sys / "class/sound/pcmC0D0c/dev", "116:4\n");
  machine.file(machine.dev / "snd/pcmC0D3p", "");
  const auto found = machine.list();
  REQUIRE(found.size() == 4);
  CHECK((found[0].kind == DeviceKind::usb && found[0].node.ends_with("bus/usb/001/017") && found[0].name == "Pedals"));
  CHECK((found[1].node == "can0" && found[1].detail == "down" &&
         found[1].remedy.starts_with("sudo ip link set can0 up")));
  CHECK((found[2].node == "vcan0" && found[2].detail == "up, CAN FD" && found[2].remedy.empty()));
  CHECK((found[3].kind == DeviceKind::sound && found[3].name == "PCH" && found[3].may_be_opened));
}

TEST_CASE("a machine without any of it and files of nonsense make a list all the same") {
  const Machine machine;
  CHECK(machine.list().empty());
  CHECK(device_table({}) == "Nothing that a rig may use is connected.\n");
  machine.file(machine.sys / "class/hidraw/hidraw0/device/uevent", std::string(100'000, 'x'));
  machine.file(machine.sys / "class/hidraw/hidraw1/device/uevent", "HID_ID=::\n");
  machine.file(machine.sys / "class/input/event0/device/capabilities/abs", std::string(100'000, 'f'));
  machine.file(machine.sys / "bus/usb/devices/1-1/idVendor", "zzzz\n");
  machine.file(machine.sys / "class/sound/pcmCp/dev", "x\n");
  for (const FoundDevice& device : machine.list()) CHECK(device.name.size() <= 100);
  CHECK_FALSE(device_table(machine.list()).empty());
}

}  // namespace septet::car_io
