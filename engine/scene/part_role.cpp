#include "engine/scene/part_role.hpp"

#include <array>

namespace septet::scene {
namespace {

constexpr std::array<std::string_view, 30> role_names = {"fixed",
                                                         "wheel_front_left",
                                                         "wheel_front_right",
                                                         "wheel_rear_left",
                                                         "wheel_rear_right",
                                                         "lamp_brake",
                                                         "lamp_reverse",
                                                         "lamp_indicator_left",
                                                         "lamp_indicator_right",
                                                         "lamp_head",
                                                         "lamp_tail",
                                                         "signal_red",
                                                         "signal_amber",
                                                         "signal_green",
                                                         "beacon",
                                                         "steering_wheel",
                                                         "leg_left",
                                                         "leg_right",
                                                         "shin_left",
                                                         "shin_right",
                                                         "arm_left",
                                                         "arm_right",
                                                         "pedalling_leg_left",
                                                         "pedalling_leg_right",
                                                         "pedalling_shin_left",
                                                         "pedalling_shin_right",
                                                         "crank",
                                                         "foot_left",
                                                         "foot_right",
                                                         "trunk"};
static_assert(role_names.size() == static_cast<std::size_t>(PartRole::trunk) + 1);

}  // namespace

std::string_view name_of(PartRole role) { return role_names[static_cast<std::size_t>(role)]; }

PartRole part_role(std::string_view name) {
  for (std::size_t i = 0; i < role_names.size(); ++i)
    if (role_names[i] == name) return static_cast<PartRole>(i);
  return PartRole::fixed;
}

}  // namespace septet::scene
