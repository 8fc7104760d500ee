#!/usr/bin/env python3
"""Writes first-lesson.xodr: a first lesson's course of 2.4 kilometres (ASAM OpenDRIVE 1.8).

    make_first_lesson.py > first-lesson.xodr

Roads 1 (country, with bends), 2 (village), 3 (village, behind the lights) and 4 (country) are the course; straight on at the
lights (junction 100), the second exit of the roundabout (junctions 201 to 204, one an arm). 21 and 22 cross at the lights, 31 and
32 meet the roundabout from the right and from the left. At each fork the first connection is the course's. Roads beside junctions
begin at them, but for 1 to 3, which are driven along s. Metres and radians throughout.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "motorway-ambulance"))
from opendrive_writer import Writer, chain, lane, plan_view, poly  # noqa: E402

LANE, PAVEMENT, SHOULDER, KERB = 3.5, 2.5, 0.75, 0.12
HALF_CROSSROADS = 16.0  # From its middle to the roads' ends.
# The roundabout: the ring's lane lies outside this circle; ways in and out touch it at this angle beside their arm, in one arc.
RING, RING_LANE, BESIDE = 16.0, 5.0, math.radians(32)
WAY_IN = RING * math.sin(BESIDE) / (1 - math.sin(BESIDE))
HALF_ROUNDABOUT = (RING + WAY_IN) * math.cos(BESIDE)
LEVEL = 12.0  # Of village and roundabout.


def bend(radius, spiral, arc):
    k = 1.0 / radius
    return [("spiral", spiral, 0, k), ("arc", arc, k, k), ("spiral", spiral, k, 0)]


def line(length):
    return [("line", length, 0, 0)]


COUNTRY = line(180) + bend(220, 50, 130) + line(90) + bend(-160, 50, 120) + line(120) + bend(400, 40, 120) + line(80)
VILLAGE = bend(-300, 40, 140) + line(180)
BEHIND_LIGHTS = line(60) + bend(250, 40, 80) + line(80)
HOMEWARD = line(100) + bend(-250, 50, 130) + line(120)
COUNTRY_HEIGHTS = [(0, 24.0, -0.01), (300, 18.0, -0.025), (620, 14.0, 0.012), (820, 15.5, -0.012), (1060, LEVEL, 0.0), (1120, LEVEL, 0.0)]
HOMEWARD_HEIGHTS = [(0, LEVEL, 0.0), (60, LEVEL, 0.0), (450, 19.0, 0.02)]
CROSSING_S, CROSSING_WIDTH = 250.0, 4.0  # On road 2: its middle.
STOP_LINE, LIGHT = 4.0, 1.0  # Before the roads' ends at the crossroads.


def ahead(pose, along, across=0.0, turn=0.0):
    x, y, heading = pose
    return (x + along * math.cos(heading) - across * math.sin(heading), y + along * math.sin(heading) + across * math.cos(heading),
            heading + turn)


def cubics(heights, length):
    """Joined by cubics, with the grade at each."""
    for (a, z0, g0), (b, z1, g1) in zip(heights, heights[1:]):
        h = b - a
        yield a, z0, g0, (3 * (z1 - z0) / h - 2 * g0 - g1) / h, (g0 + g1 - 2 * (z1 - z0) / h) / (h * h)
    if len(heights) == 1:
        yield 0.0, heights[0][1]
    assert heights[-1][0] in (0, length), (heights, length)


def link(out, name, target):
    if not target:
        return
    kind, number, *contact = target
    out.element(name, elementType=kind, elementId=number, **({"contactPoint": contact[0]} if contact else {}))


class Course:
    def __init__(self):
        self.out, self.signal_number = Writer(), 1000

    def road(self, number, name, start, segments, predecessor, successor, kind, limit, lanes, heights=((0, LEVEL, 0.0),), junction="-1",
             furniture=None):
        """Returns the pose at the road's end."""
        records, end, length = chain(start, segments)
        out = self.out
        out.begin("road", name=name, length=length, id=number, junction=junction, rule="RHT")
        out.begin("link")
        link(out, "predecessor", predecessor)
        link(out, "successor", successor)
        out.end()
        out.begin("type", s=0, type=kind)
        out.element("speed", max=limit, unit="km/h")
        out.end()
        plan_view(out, records)
        out.begin("elevationProfile")
        for record in cubics(list(heights), length):
            poly(out, "elevation", *record)
        out.end()
        out.element("lateralProfile")
        out.begin("lanes")
        out.begin("laneSection", s=0)
        lanes()
        out.end()
        out.end()
        if furniture:
            furniture(length)
        out.end()
        return end

    def two_way(self, town, before, after, mark="lane"):
        """Lanes of a road that is driven both ways; `before` and `after`: whether a road (not a junction) goes on there."""
        def lanes():
            out = self.out
            for side in (1, -1):
                if side < 0:
                    out.begin("center")
                    lane(out, 0, "none", mark=mark)
                    out.end()
                both = dict(previous=side if before else None, next_=side if after else None)
                beside = (2, "sidewalk", [(0, PAVEMENT)]) if town else (2, "shoulder", [(0, SHOULDER)])
                ordered = [(1, "driving", [(0, LANE)], "none" if town else "edge", both), (*beside, "none", {})]
                out.begin("left" if side > 0 else "right")
                for n, type_, widths, line_, links in ordered if side < 0 else reversed(ordered):
                    lane(out, side * n, type_, widths, line_, **links)
                    if type_ == "sidewalk":  # Written before the lane's end.
                        out.lines.insert(len(out.lines) - 1, "  " * (len(out.open) + 1) +
                                         f'<height sOffset="0" inner="{KERB}" outer="{KERB}"/>')
                out.end()
        return lanes

    def one_way(self, widths, previous, next_, inner="none", outer="none"):
        """The one lane of a connecting road or of the ring."""
        def lanes():
            out = self.out
            out.begin("center")
            lane(out, 0, "none", mark=inner)
            out.end()
            out.begin("right")
            lane(out, -1, "driving", widths, outer, previous=previous, next_=next_)
            out.end()
        return lanes

    def signal(self, s, t, against, name, type_, value=None, unit=None, size=0.6, z=2.1, dynamic=False, text=None, number=None,
               subtype="-1", width=None):
        self.signal_number += 1
        more = {} if dynamic else dict(country="DE", countryRevision="2017")  # Lights are of OpenDRIVE's own catalogue.
        if value is not None:
            more.update(value=value, unit=unit)
        if text:
            more["text"] = text
        self.out.element("signal", s=s, t=t, id=number or self.signal_number, name=name, dynamic="yes" if dynamic else "no",
                         orientation="-" if against else "+", zOffset=z, type=type_, subtype=subtype, height=size, width=width or size,
                         hOffset=0, pitch=0, roll=0, **more)

    def board(self, s, t, against, type_, **more):
        self.signal(s, t, against, f"sign_{type_}", type_, **more)

    def lights(self, s_end, along, number):
        """Stop line, heads on either side of the way in, for who comes to the crossroads at this end."""
        sign = -1 if along else 1
        at = lambda before: s_end + sign * before  # noqa: E731
        self.signal(at(STOP_LINE), sign * LANE / 2, not along, "stop_line", "294", z=0, size=0.01, width=LANE)
        self.signal(at(LIGHT), sign * (LANE + 0.5), not along, "traffic_light", "1000001", z=2.3, size=0.95, width=0.32, dynamic=True,
                    number=number)

    def island(self, radius):
        """In the middle of the ring, told on its first piece."""
        out = self.out
        out.begin("object", id=9000, name="middle of the roundabout", type="trafficIsland", s=0, t=RING, zOffset=0, orientation="none", hdg=0,
                  pitch=0, roll=0, length=2 * radius, width=2 * radius, height=KERB, dynamic="no")
        out.begin("outlines")
        out.begin("outline", id=0, fillType="grass", outer="true", closed="true", laneType="none")
        corners = 36
        for i in range(corners):
            angle = 2 * math.pi * i / corners
            out.element("cornerLocal", id=i, u=radius * math.cos(angle), v=radius * math.sin(angle), z=0, height=KERB)
        out.end()
        out.end()
        out.end()

    def crossing(self):
        out, half = self.out, CROSSING_WIDTH / 2
        out.begin("object", id=9001, name="crossing", type="crosswalk", s=CROSSING_S, t=0, zOffset=0, orientation="none", hdg=0, pitch=0,
                  roll=0, length=CROSSING_WIDTH, width=2 * LANE, height=0.01, dynamic="no")
        out.begin("outlines")
        out.begin("outline", id=0, fillType="paint", outer="true", closed="true", laneType="none")
        for i, (u, v) in enumerate(((-half, -LANE), (half, -LANE), (half, LANE), (-half, LANE))):
            out.element("cornerLocal", id=i, u=u, v=v, z=0, height=0.01)
        out.end()
        out.end()
        out.end()

    # What stands beside the roads, each for a road's length.

    def beside_country(self, length):
        out, t = self.out, -(LANE + SHOULDER + 1.0)
        out.begin("signals")
        self.board(30, t, False, "274", value=80, unit="km/h")
        self.board(110, t, False, "103", subtype="10", size=0.9)
        self.board(430, t, False, "103", subtype="20", size=0.9)
        self.board(length - 5, t, False, "310", text="Linden", size=0.9, width=1.4)
        self.board(60, -t, True, "103", subtype="10", size=0.9)
        out.end()

    def beside_village(self, length):
        out, t = self.out, -(LANE + 0.6)
        out.begin("objects")
        self.crossing()
        out.end()
        out.begin("signals")
        self.board(CROSSING_S - 60, t, False, "133", size=0.9)
        self.board(CROSSING_S - 3, t, False, "350")
        self.board(CROSSING_S + 3, -t, True, "350")
        self.board(length - 90, t, False, "131", size=0.9)
        self.board(5, -t, True, "311", text="Linden", size=0.9, width=1.4)
        self.lights(length, True, 901)
        out.end()

    def beside_side_street(self, number):
        def signals(_):
            self.out.begin("signals")
            self.lights(0.0, False, number)
            self.out.end()
        return signals

    def beside_behind_lights(self, length):
        self.out.begin("signals")
        self.lights(0.0, False, 903)
        self.give_way(length, True, LANE + 0.6)
        self.out.end()

    def give_way(self, s_end, along, t):
        sign = -1 if along else 1
        self.board(s_end + sign * 1.0, sign * t, not along, "205", size=0.9, z=2.8)
        self.board(s_end + sign * 1.0, sign * t, not along, "215", z=2.1)

    def beside_arm(self, homeward):
        def signals(length):
            self.out.begin("signals")
            self.give_way(0.0, False, LANE + SHOULDER + 0.6)
            if homeward:
                self.board(25, -(LANE + SHOULDER + 1.0), False, "274", value=80, unit="km/h")
            self.out.end()
        return signals


def crossroads(course, arms):
    """`arms`: (road, contact, lane in, lane out, pose looking out of the junction) counter-clockwise. Returns the connections."""
    connections, number = [], 80
    for i, (road, contact, lane_in, _, pose) in enumerate(arms):
        start = ahead(pose, 0, turn=math.pi)
        for turn in (2, 1, 3):  # Straight on first, to the right, to the left.
            target = arms[(i + turn) % 4]
            quarter = math.pi / 2 * HALF_CROSSROADS
            k = {1: -1 / HALF_CROSSROADS, 2: 0, 3: 1 / HALF_CROSSROADS}[turn]
            plan = line(2 * HALF_CROSSROADS) if turn == 2 else [("arc", quarter, k, k)]
            number += 1
            name = {1: "right", 2: "straight on", 3: "left"}[turn]
            end = course.road(number, f"{name} at the lights", start, plan, ("road", road, contact), ("road", target[0], target[1]), "town", 50,
                              course.one_way([(0, LANE)], lane_in, target[3]), junction="100")
            assert math.dist(end[:2], target[4][:2]) < 1e-6, (end, target)
            connections.append((road, number, lane_in))
    return connections


def roundabout(course, middle, arms):
    """`arms`: (road, contact, lane in, lane out) counter-clockwise, the first where the course comes from; middle: looking along it.
    Returns the connections of each arm's junction."""
    heading, found = middle[2], []
    at = lambda angle: ahead((*middle[:2], angle), RING, turn=math.pi / 2)  # noqa: E731
    k, gap = 1 / RING, math.pi / 2 - 2 * BESIDE
    turn_in = (math.pi / 2 - BESIDE) * WAY_IN
    widen, narrow = (RING_LANE - LANE) / turn_in, (LANE - RING_LANE) / turn_in
    for i, (road, contact, lane_in, lane_out) in enumerate(arms):
        angle = heading + math.pi + i * math.pi / 2
        junction, ring_before, ring_after = str(201 + i), 41 + (i + 3) % 4, 41 + i
        course.road(ring_after, "roundabout", at(angle + BESIDE), [("arc", gap * RING, k, k)], ("junction", junction),
                    ("junction", str(201 + (i + 1) % 4)), "town", 30, course.one_way([(0, RING_LANE)], None, None, "edge", "edge"),
                    furniture=island_of(course) if i == 0 else None)
        course.road(51 + i, "past an arm", at(angle - BESIDE), [("arc", 2 * BESIDE * RING, k, k)], ("road", ring_before, "end"),
                    ("road", ring_after, "start"), "town", 30, course.one_way([(0, RING_LANE)], -1, -1, "edge"), junction=junction)
        outside = ahead((*middle[:2], angle), HALF_ROUNDABOUT)
        end = course.road(61 + i, "into the roundabout", ahead(outside, 0, turn=math.pi), [("arc", turn_in, -1 / WAY_IN, -1 / WAY_IN)],
                          ("road", road, contact), ("road", ring_after, "start"), "town", 30,
                          course.one_way([(0, LANE, widen)], lane_in, -1), junction=junction)
        assert math.dist(end[:2], at(angle + BESIDE)[:2]) < 1e-6, end
        end = course.road(71 + i, "out of the roundabout", at(angle - BESIDE), [("arc", turn_in, -1 / WAY_IN, -1 / WAY_IN)],
                          ("road", ring_before, "end"), ("road", road, contact), "town", 30,
                          course.one_way([(0, RING_LANE, narrow)], -1, lane_out), junction=junction)
        assert math.dist(end[:2], outside[:2]) < 1e-6, end
        past, leave = (ring_before, 51 + i, -1), (ring_before, 71 + i, -1)
        found.append((junction, [*((leave, past) if i == 2 else (past, leave)), (road, 61 + i, lane_in)]))
    return found


def island_of(course):
    def objects(_):
        course.out.begin("objects")
        course.island(RING - 1.0)
        course.out.end()
    return objects


def write_junction(out, number, name, connections):
    out.begin("junction", id=number, name=name, type="default")
    for i, (incoming, connecting, lane_in) in enumerate(connections):
        out.begin("connection", id=i, incomingRoad=incoming, connectingRoad=connecting, contactPoint="start")
        out.element("laneLink", **{"from": lane_in, "to": -1})
        out.end()
    out.end()


def first_lesson():
    course = Course()
    out = course.out
    out.lines.append('<?xml version="1.0" encoding="UTF-8"?>')
    out.lines.append("<!-- Written by make_first_lesson.py; change that and run it again. -->")
    out.begin("OpenDRIVE")
    out.element("header", revMajor=1, revMinor=8, name="first lesson", version="1.00", date="2026-01-01T00:00:00", north=0, south=0, east=0,
                west=0, vendor="Septet")
    pose = course.road(1, "country road", (0.0, 0.0, 0.3), COUNTRY, None, ("road", 2, "start"), "rural", 80,
                       course.two_way(False, False, True), COUNTRY_HEIGHTS, furniture=course.beside_country)
    pose = course.road(2, "village", pose, VILLAGE, ("road", 1, "end"), ("junction", 100), "town", 50, course.two_way(True, True, False),
                       furniture=course.beside_village)
    lights = ahead(pose, HALF_CROSSROADS)
    out_at = lambda turn: ahead(ahead(lights, 0, turn=turn), HALF_CROSSROADS)  # noqa: E731
    for number, turn in ((21, -math.pi / 2), (22, math.pi / 2)):
        course.road(number, "side street", out_at(turn), line(120), ("junction", 100), None, "town", 50, course.two_way(True, False, False),
                    furniture=course.beside_side_street({21: 902, 22: 904}[number]))
    pose = course.road(3, "village behind the lights", out_at(0.0), BEHIND_LIGHTS, ("junction", 100), ("junction", 201), "town", 50,
                       course.two_way(True, False, False), furniture=course.beside_behind_lights)
    middle = ahead(pose, HALF_ROUNDABOUT)
    arm = lambda turn: ahead(ahead(middle, 0, turn=turn), HALF_ROUNDABOUT)  # noqa: E731
    course.road(4, "homeward", arm(0.0), HOMEWARD, ("junction", 203), None, "rural", 80, course.two_way(False, False, False),
                HOMEWARD_HEIGHTS, furniture=course.beside_arm(True))
    for number, turn, junction in ((31, -math.pi / 2, 202), (32, math.pi / 2, 204)):
        course.road(number, "country road across", arm(turn), line(150), ("junction", junction), None, "rural", 80,
                    course.two_way(False, False, False), furniture=course.beside_arm(False))

    behind = ahead(lights, -HALF_CROSSROADS, turn=math.pi)
    junctions = [("100", crossroads(course, [(2, "end", -1, 1, behind), (21, "start", 1, -1, out_at(-math.pi / 2)),
                                             (3, "start", 1, -1, out_at(0.0)), (22, "start", 1, -1, out_at(math.pi / 2))]))]
    junctions += roundabout(course, middle, [(3, "end", -1, 1), (31, "start", 1, -1), (4, "start", 1, -1), (32, "start", 1, -1)])
    for number, connections in junctions:
        write_junction(out, number, "lights" if number == "100" else "roundabout", connections)
    out.end()
    return "\n".join(out.lines) + "\n"


if __name__ == "__main__":
    print(first_lesson(), end="")
