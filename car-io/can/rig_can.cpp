#include "car-io/can/rig_can.hpp"

#include <utility>

#include "car-io/can/dbc.hpp"
#include "engine/core/check.hpp"
#include "engine/core/regular_file.hpp"

namespace septet::car_io {

Expected<RigCan> read_rig_can(const rig::Rig& rig, const std::filesystem::path& rig_file) {
  SEPTET_CHECK(rig.can, "the rig {} has no CAN bus", rig.name);
  RigCan can{.plan = {}, .dbc = rig_file.parent_path() / rig.can->dbc, .notice = {}};
  const auto text = read_regular_file(can.dbc);
  if (!text) return tl::unexpected(text.error());
  const auto database = dbc::read_dbc(*text, can.dbc.string());
  if (!database) return tl::unexpected(database.error());
  auto plan = plan_can(*database, *rig.can);
  if (!plan) return tl::unexpected(plan.error());
  can.plan = std::move(*plan);
  if (rig.car.source == rig::CarSource::can && can.plan.heard.empty())
    return failure("none of its signals is a control of the car", can.dbc.string(),
                   "name some in the rig's [can.signals], or choose another [car] source");
  can.notice = dbc::notice_of(*database);
  return can;
}

}  // namespace septet::car_io
