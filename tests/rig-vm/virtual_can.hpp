#pragma once
/// A virtual CAN interface that is up, removed at the end.

#include <string>
#include <utility>

#include <linux/can.h>

#include "tests/rig-vm/guest.hpp"

namespace septet::rig_vm {

class VirtualCan {
 public:
  explicit VirtualCan(std::string name, int mtu = CANFD_MTU) : name_(std::move(name)), mtu_(mtu) { add(); }
  ~VirtualCan() { remove(); }
  VirtualCan(const VirtualCan&) = delete;
  VirtualCan& operator=(const VirtualCan&) = delete;

  void add() {
    command("/tools/ip link add dev " + name_ + " type vcan && /tools/ip link set " + name_ + " mtu " +
            std::to_string(mtu_) + " up");
    is_there_ = true;
  }
  void remove() {
    if (std::exchange(is_there_, false)) last_command("/tools/ip link del " + name_);
  }
  void set(const char* state) { command("/tools/ip link set " + name_ + " " + state); }

 private:
  std::string name_;
  int mtu_;
  bool is_there_ = false;
};

}  // namespace septet::rig_vm
