#include "engine/road/lane.hpp"

namespace septet::road {

bool is_drivable(LaneType type) {
  switch (type) {
    case LaneType::driving:
    case LaneType::entry:
    case LaneType::exit:
    case LaneType::on_ramp:
    case LaneType::off_ramp:
    case LaneType::connecting_ramp:
    case LaneType::slip_lane:
    case LaneType::bidirectional:
      return true;
    default:
      return false;
  }
}

const char* name_of(LaneType type) {
  switch (type) {
    case LaneType::driving:
      return "driving";
    case LaneType::entry:
      return "entry";
    case LaneType::exit:
      return "exit";
    case LaneType::on_ramp:
      return "onRamp";
    case LaneType::off_ramp:
      return "offRamp";
    case LaneType::connecting_ramp:
      return "connectingRamp";
    case LaneType::slip_lane:
      return "slipLane";
    case LaneType::bidirectional:
      return "bidirectional";
    case LaneType::shoulder:
      return "shoulder";
    case LaneType::stop:
      return "stop";
    case LaneType::border:
      return "border";
    case LaneType::curb:
      return "curb";
    case LaneType::median:
      return "median";
    case LaneType::sidewalk:
      return "sidewalk";
    case LaneType::biking:
      return "biking";
    case LaneType::parking:
      return "parking";
    case LaneType::restricted:
      return "restricted";
    case LaneType::road_works:
      return "roadWorks";
    case LaneType::rail:
      return "rail";
    case LaneType::tram:
      return "tram";
    case LaneType::bus:
      return "bus";
    case LaneType::taxi:
      return "taxi";
    case LaneType::hov:
      return "HOV";
    case LaneType::none:
    case LaneType::other:
      break;
  }
  return "none";
}

}  // namespace septet::road
