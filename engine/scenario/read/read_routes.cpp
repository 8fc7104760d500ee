#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {

Route read_route(Reading& reading, const Element& element) {
  Route route;
  element.label("name");
  if (element.required_boolean("closed", false)) {
    element.warning("a closed route is not supported; it ends at its last waypoint",
                    "name its waypoints as often as they are to be passed");
  }
  for (const Element& waypoint : element.children("Waypoint")) {
    const bool shortest = waypoint.word<bool>(
        "routeStrategy", {{"shortest", true}, {"fastest", false}, {"leastIntersections", false}, {"random", false}},
        true);
    if (!shortest)
      waypoint.warning("this routeStrategy is not supported; \"shortest\" is taken",
                       "write routeStrategy=\"shortest\"");
    route.waypoints.push_back(read_position(reading, waypoint));
  }
  if (route.waypoints.size() < 2) element.error("it has less than two waypoints", "add <Waypoint>");
  return route;
}

std::shared_ptr<const Route> read_route_in(Reading& reading, const Element& parent) {
  Element route = parent.child("Route");
  route = route ? with_declared_parameters(route) : resolve_catalog_reference(reading, parent, {"Route"});
  if (!route && parent && !parent.child("CatalogReference"))
    parent.error("it has no route", "add <Route> or <CatalogReference>");
  Route found = route ? read_route(reading, route) : Route{};
  auto& routes = reading.scenario.routes;
  found.index = routes.size();
  return routes.emplace_back(std::make_shared<const Route>(std::move(found)));
}

RoutePosition read_route_position(Reading& reading, const Element& element) {
  RoutePosition position;
  position.route = read_route_in(reading, element.required("RouteRef"));
  const Element in = element.required("InRoutePosition");
  if (const Element lane = in.child("FromLaneCoordinates")) {
    position.path_s_m = lane.number("pathS", 0.0, 1e6);
    position.lane = lane.integer("laneId", -1000, 1000);
    position.offset_m = lane.number_or("laneOffset", 0.0);
  } else if (const Element road = in.child("FromRoadCoordinates")) {
    position.path_s_m = road.number("pathS", 0.0, 1e6);
    position.t_m = road.number("t");
  } else if (const Element entity = in.child("FromCurrentEntity")) {
    position.entity = read_entity_reference(reading, entity);
  } else if (in) {
    in.error("it is empty", "add <FromLaneCoordinates>");
  }
  position.orientation = read_orientation(reading, element);
  return position;
}

}  // namespace septet::scenario
