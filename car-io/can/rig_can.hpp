#pragma once
/// The CAN bus of a rig: its DBC file, and the plan of sent and heard messages.

#include <filesystem>
#include <optional>

#include "car-io/can/can_plan.hpp"
#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

struct RigCan {
  CanPlan plan;
  std::filesystem::path dbc;    ///< The parsed file.
  std::optional<Error> notice;  ///< Unread messages of the file, which the rig does not name.
};

/// `rig_file`: the DBC file lies beside it. Precondition: the rig has a [can] table. Error: the file cannot be read,
/// the rig names something that it lacks, or the rig's car is driven by a bus that carries no control. Opens no
/// interface.
Expected<RigCan> read_rig_can(const rig::Rig& rig, const std::filesystem::path& rig_file);

}  // namespace septet::car_io
