#!/usr/bin/env python3
"""Writes the catalog of hazards and the scenario in which they stand along a way through the town (ASAM OpenSCENARIO 1.3).

    make_hazards.py catalog > ../catalogs/hazards.xosc
    make_hazards.py scenario > hazards.xosc

A hazard is an act. Its first actor, the place, stands in a lane; all others come into the world beside it by maneuvers of the
catalog, which are set by the names of these entities and by what the hazard is to be like. So the same act serves a lesson,
whose Init places the first actor, and an operator, who places it by a click on the map. docs/hazards.md tells what each teaches.
"""
import pathlib
import sys
from xml.sax.saxutils import quoteattr

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "town"))
from make_town import Town  # noqa: E402
from town_plan import WAY  # noqa: E402
from town_scenario import phases  # noqa: E402

LAST_S = 32.0  # On the last road, where the way ends.
DATE = "2026-11-29T12:00:00"


def tag(element, /, *children, **attributes):
    """An element; children are texts of elements, one a line."""
    head = element + "".join(f" {key}={quoteattr(str(value))}" for key, value in attributes.items())
    inside = [line for child in children for line in child.splitlines()]
    return f"<{head}/>" if not inside else "\n".join([f"<{head}>", *(f"  {line}" for line in inside), f"</{element}>"])


def command(kind, content):
    return f'<UserDefinedAction><CustomCommandAction type="septet:{kind}">{content}</CustomCommandAction></UserDefinedAction>'


# Positions and conditions

def beside(entity, ahead, left, turned=0):
    inside = [tag("Orientation", type="relative", h=turned)] if turned else []
    return tag("Position", tag("RelativeObjectPosition", *inside, entityRef=entity, dx=ahead, dy=left))


def condition(name, test, delay=0):
    return tag("Condition", test, name=name, delay=delay, conditionEdge="none")


def trigger(*conditions):
    return tag("StartTrigger", tag("ConditionGroup", *conditions))


def at_once():
    return trigger(condition("at once", tag("ByValueCondition", tag("SimulationTimeCondition", value=0, rule="greaterOrEqual"))))


def of_driver(test):
    who = tag("TriggeringEntities", tag("EntityRef", entityRef="$driver"), triggeringEntitiesRule="any")
    return tag("ByEntityCondition", who, tag("EntityCondition", test))


def seconds_away(of, seconds, delay=0):
    """The driver needs so long at most to the place, as he drives now."""
    return condition("the driver comes", of_driver(tag("TimeHeadwayCondition", entityRef=of, value=seconds, freespace="false",
                     coordinateSystem="entity", relativeDistanceType="euclidianDistance", rule="lessThan")), delay)


def metres_away(of, metres, delay=0):
    return condition("the driver is near", of_driver(tag("RelativeDistanceCondition", entityRef=of, value=metres, freespace="false",
                     coordinateSystem="entity", relativeDistanceType="euclidianDistance", rule="lessThan")), delay)


# Actions

def private(*inside):
    return tag("PrivateAction", *inside)


def comes(who, where):
    return tag("GlobalAction", tag("EntityAction", tag("AddEntityAction", where), entityRef=who))


def goes(who):
    return tag("GlobalAction", tag("EntityAction", tag("DeleteEntityAction"), entityRef=who))


def moves_to(where):
    return private(tag("TeleportAction", where))


def speed(mps, mps2=None):
    shape = {"dynamicsShape": "linear", "dynamicsDimension": "rate", "value": mps2} if mps2 else \
            {"dynamicsShape": "step", "dynamicsDimension": "time", "value": 0}
    return private(tag("LongitudinalAction", tag("SpeedAction", tag("SpeedActionDynamics", **shape),
                   tag("SpeedActionTarget", tag("AbsoluteTargetSpeed", value=mps)))))


def walks(*places):
    vertices = [tag("Vertex", place, time=0) for place in places]
    path = tag("Trajectory", tag("ParameterDeclarations"), tag("Shape", tag("Polyline", *vertices)), name="way", closed="false")
    return private(tag("RoutingAction", tag("FollowTrajectoryAction", tag("TrajectoryRef", path), tag("TimeReference", tag("None")),
                   tag("TrajectoryFollowingMode", followingMode="position"))))


def lamps(kind, mode="flashing"):
    return private(tag("AppearanceAction", tag("LightStateAction", tag("LightType", tag("VehicleLight", vehicleLightType=kind)),
                   tag("LightState", mode=mode))))


def lane_change(beside_whom, to_left, seconds):
    return private(tag("LateralAction", tag("LaneChangeAction",
                   tag("LaneChangeActionDynamics", dynamicsShape="sinusoidal", dynamicsDimension="time", value=seconds),
                   tag("LaneChangeTarget", tag("RelativeTargetLane", entityRef=beside_whom, value=to_left)))))


def lane_offset(metres):
    return private(tag("LateralAction", tag("LaneOffsetAction", tag("LaneOffsetActionDynamics", dynamicsShape="sinusoidal", maxLateralAcc=1.2),
                   tag("LaneOffsetTarget", tag("AbsoluteTargetLaneOffset", value=metres)), continuous="false")))


def visibility(metres):
    return tag("GlobalAction", tag("EnvironmentAction", tag("Environment", tag("Weather", tag("Fog", visualRange=metres)), name="fog")))


def event(name, start, *actions):
    numbered = [tag("Action", action, name=f"{name} {i}") for i, action in enumerate(actions)]
    return tag("Event", *numbered, start, name=name, priority="parallel", maximumExecutionCount=1)


def maneuver(name, parameters, *events):
    declared = [tag("ParameterDeclaration", name=key, parameterType="string" if isinstance(value, str) else "double", value=value)
                for key, value in parameters.items()]
    return tag("Maneuver", tag("ParameterDeclarations", *declared), *events, name=name)


WHO = {"place": "place", "driver": "ego"}
PARKED = -2.75  # Of a parked car's middle from that of the lane.


# By name: parameters, and events. Lengths in metres, times in seconds, speeds in m/s. `seconds`: how long the driver would need to the
# place when it begins.
MANEUVERS = {
    "stands-aside": ({**WHO, "aside": PARKED}, [
        event("stands aside", at_once(), moves_to(beside("$place", 0, "$aside")))]),
    "warns": (WHO, [
        event("warns", at_once(), lamps("warningLights"))]),
    "runs-out": ({**WHO, "who": "who", "ahead": 6.2, "left": -0.3, "far": 9.0, "speed": 3.0, "seconds": 2.6, "delay": 0.8}, [
        event("is there", at_once(), comes("$who", beside("$place", "$ahead", "$left", 1.5708))),
        event("runs out", trigger(seconds_away("$place", "$seconds", "$delay")), command("hazard", "somebody runs out"),
              walks(beside("$who", 0, 0), beside("$who", "$far", 0)), speed("$speed")),
        event("stays", trigger(seconds_away("$place", "$seconds", "${$delay + $far / $speed}")), speed(0))]),
    "rolls-out": ({**WHO, "who": "who", "ahead": 7.4, "left": -0.6, "far": 8.0, "speed": 4.0, "seconds": 2.6}, [
        event("is there", at_once(), comes("$who", beside("$place", "$ahead", "$left", 1.5708))),
        event("rolls out", trigger(seconds_away("$place", "$seconds")), walks(beside("$who", 0, 0), beside("$who", "$far", 0)), speed("$speed")),
        event("lies", trigger(seconds_away("$place", "$seconds", "${$far / $speed}")), speed(0))]),
    "opens-door": ({**WHO, "door": "door", "seconds": 2.4, "open": 8.0}, [
        event("opens", trigger(seconds_away("$place", "$seconds")), command("hazard", "a door opens"), comes("$door", beside("$place", 1.75, 1.47, 1.25))),
        event("closes", trigger(seconds_away("$place", "$seconds", "$open")), goes("$door"))]),
    "gets-out": ({**WHO, "who": "who", "seconds": 2.4, "delay": 1.5}, [
        event("gets out", trigger(seconds_away("$place", "$seconds", "$delay")), comes("$who", beside("$place", 0.9, 1.3, 3.1416)),
              walks(beside("$place", 0.9, 1.3), beside("$place", -1.9, 1.3), beside("$place", -2.1, -1.6)), speed(1.2)),
        event("stays", trigger(seconds_away("$place", "$seconds", "${$delay + 4.8}")), speed(0))]),
    "pulls-out": ({**WHO, "aside": -2.95, "seconds": 3.0, "speed": 7.0}, [
        event("indicates", trigger(seconds_away("$place", "$seconds")), lamps("indicatorLeft")),
        event("pulls out", trigger(seconds_away("$place", "$seconds", 0.7)), command("hazard", "somebody pulls out"),
              speed("$speed", 2.5), lane_change("$driver", 0, 2.5)),
        event("has pulled out", trigger(seconds_away("$place", "$seconds", 3.5)), lamps("indicatorLeft", "off")),
        event("lets pass", trigger(seconds_away("$place", "$seconds", 6.0)), lamps("indicatorRight"), lane_offset("$aside"), speed(0, 1.5))]),
    "drives-on": ({**WHO, "seconds": 2.6, "delay": 10.0, "speed": 8.0}, [
        event("drives on", trigger(seconds_away("$place", "$seconds", "$delay")), speed("$speed", 1.0))]),
    "crosses": ({**WHO, "metres": 55.0, "speed": 9.0, "acceleration": 2.5}, [
        event("crosses", trigger(metres_away("$place", "$metres")), command("hazard", "somebody comes from the side"),
              speed("$speed", "$acceleration")),
        event("is gone", trigger(metres_away("$place", "$metres", 14)), goes("$place"))]),
    "rides-beside": ({**WHO, "seconds": 4.5, "near": 35.0, "speed": 5.0}, [
        event("rides", trigger(seconds_away("$place", "$seconds")), speed("$speed", 1.0)),
        event("is near", trigger(metres_away("$place", "$near")), command("hazard", "a cyclist at the right")),
        event("is gone", trigger(metres_away("$place", "$near", 25)), goes("$place"))]),
    "comes-against": ({**WHO, "seconds": 7.0, "speed": 9.0, "near": 40.0}, [
        event("turns", at_once(), moves_to(beside("$place", 0, 0, 3.1416))),
        event("comes", trigger(seconds_away("$place", "$seconds")), command("hazard", "somebody drives the wrong way"),
              lamps("lowBeam", "on"), speed("$speed", 2.5)),
        event("swerves", trigger(metres_away("$place", "$near")), lane_change("$place", -1, 1.6)),
        event("is gone", trigger(seconds_away("$place", "$seconds", 14)), goes("$place"))]),
    "comes-slowly": ({**WHO, "seconds": 14.0, "speed": 6.0}, [
        event("comes", trigger(seconds_away("$place", "$seconds")), speed("$speed", 1.0)),
        event("is gone", trigger(seconds_away("$place", "$seconds", 20)), goes("$place"))]),
    "overtakes-towards": ({**WHO, "who": "who", "behind": 14.0, "slow": 6.0, "from": 14.0, "seconds": 9.0, "speed": 13.0}, [
        event("is there", at_once(), comes("$who", beside("$place", "${0 - $behind}", 0))),
        event("follows", trigger(seconds_away("$place", "$from")), speed("$slow", 1)),
        event("pulls out", trigger(seconds_away("$place", "$seconds")), command("hazard", "an oncoming car overtakes"),
              lane_change("$place", 1, 2.0), speed("$speed", 3)),
        event("is back", trigger(seconds_away("$place", "$seconds", 4.5)), lane_change("$place", 0, 2.0)),
        event("is gone", trigger(seconds_away("$place", "$from", 20)), goes("$who"))]),
    "with-siren": ({**WHO, "metres": 80.0, "speed": 12.0}, [
        event("sounds", trigger(metres_away("$place", 200)), command("siren", "$place on"), lamps("specialPurposeLights", "on")),
        event("comes", trigger(metres_away("$place", "$metres")), command("hazard", "an ambulance crosses at red"), speed("$speed", 2.5)),
        event("is gone", trigger(metres_away("$place", "$metres", 20)), goes("$place"))]),
    "freezes": ({**WHO, "length": 40.0, "millimetres": 4.0, "seconds": 3.0}, [
        event("freezes", at_once(), command("black-ice", "$place $length $millimetres")),
        event("is met", trigger(seconds_away("$place", "$seconds")), command("hazard", "black ice"))]),
    "fog": ({**WHO, "metres": 60.0, "far": 3000.0, "seconds": 8.0, "lasts": 20.0}, [
        event("thickens", trigger(seconds_away("$place", "$seconds")), visibility("${$metres * 4}")),
        event("is thick", trigger(seconds_away("$place", "$seconds", 1.5)), command("hazard", "a bank of fog"), visibility("$metres")),
        event("thins", trigger(seconds_away("$place", "$seconds", "$lasts")), visibility("${$metres * 4}")),
        event("is gone", trigger(seconds_away("$place", "$seconds", "${$lasts + 2}")), visibility("$far"))]),
}


# The scenario

def in_catalog(name, kind, catalog="participants"):
    return tag("ScenarioObject", tag("CatalogReference", catalogName=catalog, entryName=kind), name=name)


def walker(name):
    return in_catalog(name, "pedestrian", "people")


def vehicle(name, model, category, length, width, height, middle, wheel, front, track=1.8, role="none"):
    """Of a kind that the catalog of participants has not."""
    box = tag("BoundingBox", tag("Center", x=middle, y=0, z=height / 2), tag("Dimensions", width=width, length=length, height=height))
    axle = {"wheelDiameter": wheel, "trackWidth": track, "positionZ": wheel / 2}
    axles = tag("Axles", tag("FrontAxle", maxSteering=0.6, **axle, positionX=front), tag("RearAxle", maxSteering=0, **axle, positionX=0))
    performance = tag("Performance", maxSpeed=30, maxAcceleration=3, maxDeceleration=9)
    return tag("ScenarioObject", tag("Vehicle", box, performance, axles, name=model, vehicleCategory=category, role=role), name=name)


def bus(name):
    return vehicle(name, "city-bus", "bus", 12.0, 2.55, 3.1, 2.6, 0.96, 5.9, 2.1)


def cyclist(name):
    return vehicle(name, "bicycle", "bicycle", 1.8, 0.6, 1.73, 0.53, 0.68, 1.05, 0)


def ambulance(name):
    return vehicle(name, "ambulance", "van", 6.1, 2.08, 2.75, 1.7, 0.69, 3.66, 1.72, "ambulance")


def thing(name, kind, length, width, height, foot, mass):
    box = tag("BoundingBox", tag("Center", x=0, y=0, z=round(foot + height / 2, 3)), tag("Dimensions", width=width, length=length, height=height))
    return tag("ScenarioObject", tag("MiscObject", box, name=kind, miscObjectCategory="obstacle", mass=mass), name=name)


def car(name):
    return in_catalog(name, "saloon")


def van(name):
    return in_catalog(name, "van")


def ball(name):
    return thing(name, "ball", 0.24, 0.24, 0.24, 0, 0.4)


def door(name):
    return thing(name, "opened-door", 0.95, 0.07, 0.95, 0.3, 25)


# Hazards: the maker of each entity by its word, the first of which is the place; then (actor or nobody, maneuver, what it is set to).
PARKED_ON_PAVEMENT = ("place", "stands-aside", {"aside": -2.95})  # Wholly beside a lane of 3.75 m.
HAZARDS = {
    "black ice": ({"place": car}, [("place", "freezes", {}), PARKED_ON_PAVEMENT, ("place", "warns", {})]),
    "bus stop": ({"place": bus, "who": walker}, [("place", "stands-aside", {"aside": -0.5}), ("place", "warns", {}),
                                                 ("who", "runs-out", {"ahead": -4.4, "left": -1.0, "far": 9, "speed": 2.2, "delay": 0}),
                                                 ("place", "drives-on", {})]),
    "door": ({"place": car, "who": walker, "door": door}, [PARKED_ON_PAVEMENT, ("place", "opens-door", {}), ("who", "gets-out", {})]),
    "car from the right": ({"place": car}, [("place", "crosses", {})]),
    "ball and child": ({"place": van, "who": walker, "ball": ball}, [PARKED_ON_PAVEMENT, ("ball", "rolls-out", {"who": "ball"}), ("who", "runs-out", {})]),
    "pulling out": ({"place": car}, [PARKED_ON_PAVEMENT, ("place", "pulls-out", {})]),
    "oncoming car overtakes": ({"place": van, "who": car}, [("place", "comes-slowly", {}), ("who", "overtakes-towards", {})]),
    "ambulance at red": ({"place": ambulance}, [("place", "with-siren", {"metres": 118})]),
    "wrong way": ({"place": car}, [("place", "comes-against", {})]),
    "cyclist at the right": ({"place": cyclist}, [("place", "stands-aside", {"aside": -1.1}), ("place", "rides-beside", {})]),
    "bank of fog": ({"place": car}, [PARKED_ON_PAVEMENT, ("place", "warns", {}), (None, "fog", {})]),
}
# Where they stand along the town's way: road, lane, s of the place; and, of one who turns, whereto.
ALONG_THE_WAY = [
    ("black ice", 110, -1, 150), ("bus stop", 19, 1, 90), ("door", 20, -1, 70), ("car from the right", 30, 1, 34, (79, 1, 60)), ("ball and child", 37, -1, 80),
    ("pulling out", 38, -1, 70), ("oncoming car overtakes", 92, -1, 30), ("ambulance at red", 25, 1, 50),
    ("cyclist at the right", 90, 1, 75), ("bank of fog", 113, 1, 150),
]


def names_of(hazard, label):
    return {word: f"{label}: {word}" if word != "place" else label for word in HAZARDS[hazard][0]}


def entities(hazard, label):
    names = names_of(hazard, label)
    return [make(names[word]) for word, make in HAZARDS[hazard][0].items()]


def act(hazard, label, waits):
    """`waits`: for an operator, who places its first actor and begins it."""
    names, groups = names_of(hazard, label), []
    for number, (actor, done, settings) in enumerate(HAZARDS[hazard][1]):
        given = {**names, **{key: names.get(value, value) for key, value in settings.items()}}
        assigned = [tag("ParameterAssignment", parameterRef=key, value=value) for key, value in given.items() if key in MANEUVERS[done][0]]
        actors = [tag("EntityRef", entityRef=names[actor])] if actor else []
        groups.append(tag("ManeuverGroup", tag("Actors", *actors, selectTriggeringEntities="false"),
                          tag("CatalogReference", tag("ParameterAssignments", *assigned), catalogName="hazards", entryName=done),
                          name=f"{number} {done}", maximumExecutionCount=1))
    starts = trigger(condition("an operator", tag("ByValueCondition", tag("SimulationTimeCondition", value=1e9, rule="greaterThan")))) if waits else at_once()
    return tag("Act", *groups, starts, name=label)


def lane_place(road, lane, s):
    return tag("Position", tag("LanePosition", roadId=road, laneId=lane, s=s, offset=0))


def of_placed(hazard, road, lane, s, turns_to=None):
    actions = [private(tag("TeleportAction", lane_place(road, lane, s)))]
    if turns_to:
        actions.append(private(tag("RoutingAction", tag("AcquirePositionAction", lane_place(*turns_to)))))
    return tag("Private", *actions, entityRef=f"{hazard} on the way")


def header(description):
    return tag("FileHeader", revMajor=1, revMinor=3, date=DATE, author="Septet", description=description)


def lights(town):
    """The town's lights, as its own scenario switches them."""
    for _, name, heads in town.lights:
        turn = [tag("Phase", *(tag("TrafficSignalState", trafficSignalId=signal, state=state) for signal, state in states), name=phase, duration=seconds)
                for phase, seconds, states in phases(heads)]
        yield tag("TrafficSignalController", *turn, name=name)


def swarm():
    weights = {"car": 0.86, "van": 0.1, "truck": 0.04}
    mix = tag("VehicleCategoryDistribution", *(tag("VehicleCategoryDistributionEntry", category=kind, weight=weight) for kind, weight in weights.items()))
    drivers = tag("ControllerDistribution", tag("ControllerDistributionEntry", tag("Controller", tag("Properties"), name="septet-traffic", controllerType="movement"), weight=1))
    return tag("GlobalAction", tag("TrafficAction", tag("TrafficSwarmAction", tag("CentralObject", entityRef="ego"),
               tag("TrafficDefinition", mix, drivers, name="town by day"), tag("DirectionOfTravelDistribution", same=0.5, opposite=0.5),
               innerRadius=30, semiMajorAxis=400, semiMinorAxis=400, offset=0, numberOfVehicles="$vehicles"), trafficName="town traffic"))


def weather():
    return tag("GlobalAction", tag("EnvironmentAction", tag("Environment", tag("TimeOfDay", animation="false", dateTime="2026-11-21T10:30:00"),
               tag("Weather", tag("Sun", azimuth=2.7, elevation=0.35, illuminance=30000), tag("Fog", visualRange=3000),
                   tag("Precipitation", precipitationType="dry", precipitationIntensity=0), tag("Wind", direction=0.6, speed=1),
                   fractionalCloudCover="fourOktas", temperature=270.15),
               tag("RoadCondition", frictionScaleFactor=1, wetness="dry"), name="a cold morning")))


def way(town):
    """The route of the driver's car: the middle of each street on the town's way, and where the drive ends."""
    found = []
    for a, b in zip(WAY, WAY[1:]):
        street, number = next((street, number) for street, number in town.numbers.items() if {street.a, street.b} == {a, b})
        found.append(tag("Waypoint", lane_place(number, -1 if street.a == a else 1, LAST_S if b == WAY[-1] else round(street.length / 2, 1)), routeStrategy="shortest"))
    return private(tag("RoutingAction", tag("AssignRouteAction", tag("Route", *found, name="past the hazards", closed="false"))))


def ends(last):
    reached = tag("ReachPositionCondition", tag("Position", tag("LanePosition", roadId=last, laneId=1, s=LAST_S + 8, offset=0)), tolerance=10)
    out = condition("out of the town", of_driver(reached).replace("$driver", "ego"))
    late = condition("a quarter of an hour", tag("ByValueCondition", tag("SimulationTimeCondition", value=900, rule="greaterOrEqual")))
    return tag("StopTrigger", tag("ConditionGroup", out), tag("ConditionGroup", late))


def scenario():
    town = Town()
    town.roads()  # Numbers the lights.
    of_entry = {street.a: number for street, number in town.numbers.items() if isinstance(street.a, str)}
    placed = [(f"{hazard} on the way", hazard) for hazard, *_ in ALONG_THE_WAY]
    spare = [(hazard, hazard) for hazard in HAZARDS]
    parameters = tag("ParameterDeclarations", tag("ParameterDeclaration", name="vehicles", parameterType="unsignedInt", value=40))
    catalogs = tag("CatalogLocations", *(tag(f"{kind}Catalog", tag("Directory", path="../catalogs")) for kind in ("Vehicle", "Pedestrian", "Maneuver")))
    starts = tag("Private", private(tag("TeleportAction", tag("Position", tag("LanePosition", roadId=of_entry["west"], laneId=-1, s=20, offset=0)))), way(town), entityRef="ego")
    things = [line for label, hazard in placed + spare for line in entities(hazard, label)]
    acts = [act(hazard, label, waits) for some, waits in ((placed, False), (spare, True)) for label, hazard in some]
    return [header("Ten hazards along a way through the town, and eleven for the operator"), parameters, catalogs,
            tag("RoadNetwork", tag("LogicFile", filepath="../town/town.xodr"), tag("TrafficSignals", *lights(town))),
            tag("Entities", tag("ScenarioObject", tag("CatalogReference", catalogName="participants", entryName="volvo-s80"), name="ego"), *things),
            tag("Storyboard", tag("Init", tag("Actions", weather(), swarm(), starts, *(of_placed(*one) for one in ALONG_THE_WAY))),
                tag("Story", *acts, name="hazards"), ends(of_entry["south east"]))]


def maneuvers():
    """All of them. The first declares the others' parameters too, as ASAM's checker looks at a catalog's first declarations alone."""
    everything = {key: value for parameters, _ in reversed(MANEUVERS.values()) for key, value in parameters.items()}
    for number, (name, (parameters, events)) in enumerate(MANEUVERS.items()):
        yield maneuver(name, {**parameters, **everything, **parameters} if number == 0 else parameters, *events)


def main():
    if sys.argv[1:] == ["catalog"]:
        parts = [header("What endangers a driver in town"), tag("Catalog", *maneuvers(), name="hazards")]
    elif sys.argv[1:] == ["scenario"]:
        parts = scenario()
    else:
        sys.exit(__doc__)
    print('<?xml version="1.0" encoding="UTF-8"?>\n<!-- Written by make_hazards.py; change that and run it again. -->')
    print(tag("OpenSCENARIO", *parts))


main()
