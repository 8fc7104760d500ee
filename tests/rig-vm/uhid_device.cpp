#include "tests/rig-vm/uhid_device.hpp"

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include <doctest/doctest.h>

namespace septet::rig_vm {
namespace {

void hand_over(int file, const uhid_event& event) {
  REQUIRE(write(file, &event, sizeof event) == static_cast<ssize_t>(sizeof event));
}

std::span<const std::byte> handed_over(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const std::byte*>(data), size};
}

template <std::size_t size>
void copy_text(const std::string& text, std::uint8_t (&to)[size]) {
  REQUIRE(text.size() < size);
  std::memcpy(to, text.c_str(), text.size() + 1);
}

}  // namespace

UhidDevice::UhidDevice(const UhidIdentity& identity, UhidAnswers answers)
    : file_(open("/dev/uhid", O_RDWR | O_CLOEXEC)), answers_(std::move(answers)) {
  REQUIRE(file_ >= 0);
  uhid_event event{};
  event.type = UHID_CREATE2;
  auto& made = event.u.create2;
  copy_text(identity.name, made.name);
  copy_text(identity.serial, made.uniq);
  REQUIRE(identity.descriptor.size() <= sizeof made.rd_data);
  std::ranges::copy(identity.descriptor, made.rd_data);
  made.rd_size = static_cast<std::uint16_t>(identity.descriptor.size());
  made.bus = BUS_USB;
  made.vendor = identity.vendor;
  made.product = identity.product;
  hand_over(file_, event);
  thread_ = std::thread([this] { serve(); });
}

UhidDevice::~UhidDevice() {
  is_ending_ = true;
  thread_.join();
  close(file_);
}

void UhidDevice::send(std::span<const std::byte> report) {
  uhid_event event{};
  event.type = UHID_INPUT2;
  event.u.input2.size = static_cast<std::uint16_t>(report.size());
  std::memcpy(event.u.input2.data, report.data(), report.size());
  hand_over(file_, event);
}

void UhidDevice::serve() {
  while (!is_ending_) {
    pollfd waiting{file_, POLLIN, 0};
    if (poll(&waiting, 1, 20) <= 0) continue;
    uhid_event event{}, answer{};
    if (read(file_, &event, sizeof event) <= 0) continue;
    if (event.type == UHID_OUTPUT) {
      answers_.output(handed_over(event.u.output.data, event.u.output.size));
    } else if (event.type == UHID_SET_REPORT) {
      answer.type = UHID_SET_REPORT_REPLY;
      answer.u.set_report_reply.id = event.u.set_report.id;
      answer.u.set_report_reply.err = static_cast<std::uint16_t>(
          answers_.set_feature(handed_over(event.u.set_report.data, event.u.set_report.size)));
      hand_over(file_, answer);
    } else if (event.type == UHID_GET_REPORT) {
      const Bytes report = answers_.get_feature();
      answer.type = UHID_GET_REPORT_REPLY;
      answer.u.get_report_reply.id = event.u.get_report.id;
      answer.u.get_report_reply.size = static_cast<std::uint16_t>(report.size());
      std::memcpy(answer.u.get_report_reply.data, report.data(), report.size());
      hand_over(file_, answer);
    }
  }
}

}  // namespace septet::rig_vm
