#pragma once
/// The CAN bus of a rig as it is used: its DBC file read, and what of it is sent and heard.

#include <filesystem>
#include <optional>

#include "car-io/can/can_plan.hpp"
#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

struct RigCan {
  CanPlan plan;
  std::filesystem::path dbc;    ///< The file that was read.
  std::optional<Error> notice;  ///< Messages of the file that are left unread, which the rig does not name.
};

/// `rig_file`: the DBC file lies beside it. The rig has a [can] table. Error: the file cannot be read, the rig names what it has not, or the
/// rig's car is driven by a bus that carries no control. Opens no interface.
Expected<RigCan> read_rig_can(const rig::Rig& rig, const std::filesystem::path& rig_file);

}  // namespace septet::car_io
