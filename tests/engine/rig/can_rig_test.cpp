#include "engine/rig/rig.hpp"

#include <string>

#include <doctest/doctest.h>

#include "tests/why_not.hpp"

namespace septet::rig {
namespace {

std::string with(const std::string& tables) {
  return "name = \"r\"\neye_point_m = [1, 0, 1]\n" + tables +
         "\n[[screen]]\nname = \"a\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, 0]\nupper_left_m = [2, 1, 1]\n";
}

}  // namespace

TEST_CASE("a rig names its CAN bus and what foreign signals carry") {
  const auto rig = read_rig(with("[car]\nsource = \"can\"\n[can]\ninterface = \"can0\"\ndbc = "
                                 "\"own.dbc\"\n[can.signals]\n\"A.v\" = \"speed_kmh\"\n\"A.w\" = 7\n"),
                            "r");
  REQUIRE_MESSAGE(rig.has_value(), why_not(rig));
  CHECK(rig->car.source == CarSource::can);
  CHECK((rig->can->interface == "can0" && rig->can->dbc == "own.dbc"));
  REQUIRE(rig->can->signals.size() == 2);
  CHECK((rig->can->signals[0].signal == "A.v" && rig->can->signals[0].quantity == "speed_kmh"));
  CHECK((rig->can->signals[1].quantity.empty() && rig->can->signals[1].constant == 7.0));
  CHECK_FALSE(read_rig(with(""), "r")->can.has_value());
}

TEST_CASE("a CAN bus that cannot be is refused with its place") {
  for (const char* tables :
       {"[can]\n", "[can]\ninterface = \"a name too long\"\n", "[can]\ninterface = \"can0\"\ndbc = \"\"\n",
        "[can]\ninterface = \"can0\"\n[can.signals]\nspeed = \"speed_kmh\"\n",
        "[can]\ninterface = \"can0\"\n[can.signals]\n\"A.v\" = true\n",
        "[can]\ninterface = \"can0\"\n[can.signals]\n\"A.v\" = nan\n", "[car]\nsource = \"can\"\n",
        "[car]\nsource = \"can\"\nmachine = \"pc\"\n[can]\ninterface = \"can0\"\n"}) {
    CAPTURE(tables);
    const auto rig = read_rig(with(tables), "bad.toml");
    REQUIRE_FALSE(rig.has_value());
    CHECK(rig.error().where.starts_with("bad.toml:"));
  }
}

TEST_CASE("a car that is no HID device is named by its endpoints and hidraw has none") {
  const auto rig = read_rig(with("[car]\nsource = \"hid\"\n[car.usb]\ninterface = 2\nin = 0x83\nout = 4\n"), "r");
  REQUIRE_MESSAGE(rig.has_value(), why_not(rig));
  REQUIRE(rig->car.usb.has_value());
  CHECK((rig->car.usb->interface == 2 && rig->car.usb->in == 0x83 && rig->car.usb->out == 4));
  CHECK(rig->car.access == HidAccess::automatic);
  CHECK_FALSE(read_rig(with("[car]\nsource = \"hid\"\n"), "r")->car.usb.has_value());
  CHECK(read_rig(with("[car]\nsource = \"hid\"\naccess = \"libusb\"\n"), "r")->car.access == HidAccess::libusb);
  for (const char* wrong : {"access = \"usbfs\"\n", "[car.usb]\nin = 1\n", "[car.usb]\nin = 0x80\n",
                            "[car.usb]\nin = 0x90\n", "[car.usb]\nout = 0x81\n", "[car.usb]\ninterface = -1\n",
                            "[car.usb]\nendpoint = 1\n", "access = \"hidraw\"\n[car.usb]\n"}) {
    CAPTURE(wrong);
    CHECK_FALSE(read_rig(with("[car]\nsource = \"hid\"\n" + std::string(wrong)), "r").has_value());
  }
}

TEST_CASE("a joystick's controls are axes with two ends or buttons and nothing else") {
  const std::string car = "[car]\nsource = \"joystick\"\n";
  const auto rig = read_rig(
      with(car + "[car.joystick]\nbrake = { axis = 5, at_zero = 255, at_one = 0 }\nhorn = { button = 288 }\n"), "r");
  REQUIRE_MESSAGE(rig.has_value(), why_not(rig));
  REQUIRE(rig->car.joystick.size() == 2);
  CHECK(
      (rig->car.joystick[0].name == "brake" && rig->car.joystick[0].is_axis && rig->car.joystick[0].at_zero == 255.0));
  CHECK((rig->car.joystick[1].name == "horn" && !rig->car.joystick[1].is_axis && rig->car.joystick[1].code == 288));
  for (const char* table :
       {"", "[car.joystick]\n", "[car.joystick]\nbrake = { at_zero = 1 }\n", "[car.joystick]\nbrake = { axis = 64 }\n",
        "[car.joystick]\nbrake = { axis = 1, at_zero = 3, at_one = 3 }\n", "[car.joystick]\nbrakes = { axis = 1 }\n",
        "[car.joystick]\nhorn = { button = 0 }\n", "[car.joystick]\nbrake = { axis = 1, at_one = nan }\n"}) {
    CAPTURE(table);
    const auto refused = read_rig(with(car + table), "bad.toml");
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().where.starts_with("bad.toml:"));
  }
}

TEST_CASE("a rig says whether and where its drive is heard") {
  CHECK_FALSE(read_rig(with(""), "r")->sound.has_value());
  const auto usual = read_rig(with("[sound]\n"), "r");
  CHECK((usual->sound->device.empty() && usual->sound->speakers == Sound::Speakers::stereo));
  const auto car = read_rig(with("[sound]\ndevice = \"hw\"\nspeakers = \"5.1\"\nvolume_db = -6\n"), "r");
  CHECK((car->sound->device == "hw" && car->sound->speakers == Sound::Speakers::surround_51 &&
         car->sound->volume_db == -6.0));
  CHECK(read_rig(with("[sound]\nspeakers = \"7.1\"\n"), "r").error().remedy ==
        "choose one of: stereo, 5.1, headphones");
}

}  // namespace septet::rig
