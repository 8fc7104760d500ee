#!/usr/bin/env python3
"""Writes motorway.xodr: ten kilometres of motorway, five lanes each way (ASAM OpenDRIVE 1.8).

    make_motorway.py > motorway.xodr

The main line is one axis in the middle of the central reserve: lines, clothoids and arcs, cut into three roads where the
ramps of a rest area leave (6,300 m) and join (7,092 m) at direct junctions. Roads 1, 2 and 3 are the main line; 11, 12
and 13 are the exit ramp, the road through the rest area and the entry ramp. Lanes, from the axis outwards, either side:

    1 median 1.25 m · 2 inner shoulder 0.75 m · 3 to 7 driving 3.75 m · 8 outer shoulder 2.5 m

Along the deceleration and the acceleration lane lane −8 is that lane and −9 the shoulder. Metres and radians throughout.
"""
import math

from opendrive_writer import Writer, barrier, chain, junction, lane, plan_view, poly, walk

# The axis: (kind, length, curvature at the start, curvature at the end).
SEGMENTS = [("line", 300, 0, 0)]


def curve(radius, spiral, arc):
    k = 1.0 / radius
    SEGMENTS.extend([("spiral", spiral, 0, k), ("arc", arc, k, k), ("spiral", spiral, k, 0)])


curve(1800, 250, 700)
SEGMENTS.append(("line", 200, 0, 0))
curve(-1500, 240, 600)
SEGMENTS.append(("line", 320, 0, 0))
curve(2200, 250, 800)
curve(-1600, 250, 700)
SEGMENTS.append(("line", 2100, 0, 0))
curve(1800, 250, 600)
curve(-2500, 250, 500)
SEGMENTS.append(("line", 200, 0, 0))

# Height and grade at stations of the axis, joined by cubics. Level along the rest area, where the ramps run beside.
HEIGHTS = [(0, 30.0, 0.012), (700, 41.0, 0.018), (1230, 46.0, -0.004), (2000, 32.0, -0.024), (2900, 20.0, 0.004),
           (3550, 25.0, 0.008), (4300, 26.0, -0.010), (5200, 15.0, -0.012), (5800, 11.0, 0.0), (7700, 11.0, 0.0),
           (8500, 22.0, 0.024), (9300, 36.0, 0.008), (10000, 36.0, -0.008)]
LARGEST_BANKING = 0.025

# Where lane sections begin: multiples of 18 m, the period of the broken lines, so that these run on across sections.
EXIT_S, ENTRY_S, END_S = 6300.0, 7092.0, 10000.0
TAPER, LANE_LENGTH = 80.0, 306.0  # Of the deceleration and acceleration lanes, the taper included.
DRIVING, LANE_COUNT = 3.75, 5
MEDIAN, INNER_SHOULDER, OUTER_SHOULDER = 1.25, 0.75, 2.5
EDGE_T = MEDIAN + INNER_SHOULDER + LANE_COUNT * DRIVING  # Outer border of the driving lanes.
OUTER_T = EDGE_T + OUTER_SHOULDER
BRIDGE, TUNNEL = (1150.0, 160.0), (3150.0, 800.0)
GANTRIES = [620.0, 1720.0, 2820.0, 4400.0, 5300.0, 5980.0, 7650.0, 8700.0]
RAIL_GAP = 0.6  # From the outer shoulder to the guard rail.


class Axis:
    """The main line: stations, poses and what holds where."""

    def __init__(self):
        self.records = []  # (s, pose, kind, length, k0, k1)
        s, pose = 0.0, (0.0, 0.0, 0.35)
        for kind, length, k0, k1 in SEGMENTS:
            self.records.append((s, pose, kind, float(length), k0, k1))
            pose = walk(pose, kind, float(length), k0, k1)
            s += length
        assert s == END_S, s

    def pose(self, s):
        record = max((r for r in self.records if r[0] <= s), key=lambda r: r[0])
        return walk(*record[1:], part=s - record[0])

    def cut(self, s0, s1):
        """Geometry of the road from s0 to s1, with s from 0."""
        for s, pose, kind, length, k0, k1 in self.records:
            a, b = max(s, s0), min(s + length, s1)
            if b - a < 1e-9:
                continue
            assert kind == "line" or (a == s and b == s + length), "only lines are cut"
            yield a - s0, walk(pose, kind, length, k0, k1, part=a - s), kind, b - a, k0, k1

    def heights(self, s0, s1):
        """Cubics of the elevation from s0 to s1."""
        for (a, z0, g0), (b, z1, g1) in zip(HEIGHTS, HEIGHTS[1:]):
            if b <= s0 or a >= s1:
                continue
            h = b - a
            c, d = (3 * (z1 - z0) / h - 2 * g0 - g1) / h, (g0 + g1 - 2 * (z1 - z0) / h) / (h * h)
            u = max(s0 - a, 0.0)  # Written from u on, so that each road's first record starts at its 0.
            yield (a + u - s0, z0 + u * (g0 + u * (c + u * d)), g0 + u * (2 * c + 3 * d * u), c + 3 * d * u, d)

    def banking(self, s0, s1):
        """Superelevation: towards the inside of each curve, changing smoothly along its spirals."""
        for s, _, kind, length, k0, k1 in self.records:
            if s + length <= s0 or s >= s1:
                continue
            bank0, bank1 = (-LARGEST_BANKING * (k > 0) + LARGEST_BANKING * (k < 0) for k in (k0, k1))
            yield max(s - s0, 0.0), bank0, 0.0, 3 * (bank1 - bank0) / length**2, -2 * (bank1 - bank0) / length**3


def smooth(width0, width1, length):
    """Coefficients of the cubic from width0 to width1 that is level at both ends."""
    rise = width1 - width0
    return width0, 0.0, 3 * rise / length**2, -2 * rise / length**3


def carriageway(out, side, extra=None, shoulder=None, before=True, after=True, links=None):
    """The lanes of one side of the main line. `extra`: (type, widths) of a lane −8 inside the shoulder; `links`: its and
    the shoulder's (previous, next); before, after: whether the section has a neighbour on the same road."""
    def link(number):
        return dict(previous=number if before else None, next_=number if after else None)

    lanes = [(1, "median", [(0, MEDIAN)], "none", link(side)),
             (2, "shoulder", [(0, INNER_SHOULDER)], "edge", link(side * 2))]
    for i in range(LANE_COUNT):
        last = i == LANE_COUNT - 1
        mark = ("merge" if extra else "edge") if last else "lane"
        lanes.append((3 + i, "driving", [(0, DRIVING)], mark, link(side * (3 + i))))
    links = links or {}
    if extra:
        lanes.append((8, extra[0], extra[1], "edge", links.get(8, {})))
    number = 9 if extra else 8
    lanes.append((number, "shoulder", shoulder or [(0, OUTER_SHOULDER)], "none", links.get(number, link(side * number))))
    if side > 0:
        lanes.reverse()
    out.begin("left" if side > 0 else "right")
    for number, type_, widths, mark, neighbours in lanes:
        lane(out, side * number, type_, widths, mark, **neighbours)
    out.end()


def section(out, s, **right):
    out.begin("laneSection", s=s)
    carriageway(out, 1, before=right.get("before", True), after=right.get("after", True))
    out.begin("center")
    lane(out, 0, "none")
    out.end()
    carriageway(out, -1, **right)
    out.end()


def gantry(out, number, s):
    out.element("object", id=number, name="gantry", type="gantry", s=s, t=0, zOffset=0, orientation="none", hdg=0, pitch=0,
                roll=0, length=1.2, width=2 * (OUTER_T + 1.2), height=7.6, dynamic="no")


def gantry_signals(out, first_id, s, limit):
    """A speed display above each driving lane, facing its traffic."""
    for side in (-1, 1):
        for i in range(LANE_COUNT):
            t = side * (MEDIAN + INNER_SHOULDER + (i + 0.5) * DRIVING)
            out.begin("signal", s=s, t=t, id=first_id + i + (LANE_COUNT if side > 0 else 0), name="speed_display", dynamic="yes",
                      orientation="+" if side < 0 else "-", zOffset=5.8, country="DE", countryRevision="2017", type="274",
                      subtype="-1", value=limit, unit="km/h", height=1.2, width=1.2, hOffset=0, pitch=0, roll=0)
            number = side * (3 + i)
            out.element("validity", fromLane=number, toLane=number)
            out.end()


def main_road(out, axis, number, name, s0, s1, predecessor, successor, sections, right_rail):
    length = s1 - s0
    out.begin("road", name=name, length=length, id=number, junction="-1", rule="RHT")
    out.begin("link")
    if predecessor:
        out.element("predecessor", elementType="junction", elementId=predecessor)
    if successor:
        out.element("successor", elementType="junction", elementId=successor)
    out.end()
    out.begin("type", s=0, type="motorway")
    out.element("speed", max=120, unit="km/h")
    out.end()
    plan_view(out, axis.cut(s0, s1))
    out.begin("elevationProfile")
    for record in axis.heights(s0, s1):
        poly(out, "elevation", *record)
    out.end()
    out.begin("lateralProfile")
    for record in axis.banking(s0, s1):
        poly(out, "superelevation", *record)
    out.end()
    out.begin("lanes")
    for arguments in sections:
        section(out, **arguments)
    out.end()

    ids = iter(range(number * 1000, number * 1000 + 1000))
    rail_t = OUTER_T + RAIL_GAP
    out.begin("objects")
    barrier(out, next(ids), "median_barrier", "jerseyBarrier", [(0, length, 0, 0)], 0.9, 0.6)
    barrier(out, next(ids), "guard_rail_left", "guardRail", [(0, length, rail_t, rail_t)], 0.75, 0.3)
    barrier(out, next(ids), "guard_rail_right", "guardRail", right_rail, 0.75, 0.3)
    own_gantries = [s - s0 for s in GANTRIES if s0 <= s < s1]
    for s in own_gantries:
        gantry(out, next(ids), s)
    if s0 <= BRIDGE[0] < s1:
        for t in (-rail_t - 0.4, rail_t + 0.4):
            barrier(out, next(ids), "bridge_parapet", "railing", [(BRIDGE[0], BRIDGE[1], t, t)], 1.2, 0.25)
        out.element("tunnel", s=TUNNEL[0], length=TUNNEL[1], name="hill_tunnel", id=next(ids), type="standard", lighting=0.6,
                    daylight=0.2)
        out.element("bridge", s=BRIDGE[0], length=BRIDGE[1], name="valley_bridge", id=next(ids), type="concrete")
    out.end()
    out.begin("signals")
    for i, s in enumerate(own_gantries):
        gantry_signals(out, number * 1000 + 500 + 20 * i, s, 100 if s0 == 0 and s > 2700 and s < 3000 else 120)
    out.end()
    out.end()


# The ramps, in lengths and curvatures; the entry ramp is the exit ramp mirrored.
RAMP_SPIRAL, RAMP_RADIUS, RAMP_LINE = 60.0, 250.0, 60.0
RAMP = [("spiral", RAMP_SPIRAL, 0, -1 / RAMP_RADIUS), ("spiral", RAMP_SPIRAL, -1 / RAMP_RADIUS, 0), ("line", RAMP_LINE, 0, 0),
        ("spiral", RAMP_SPIRAL, 0, 1 / RAMP_RADIUS), ("spiral", RAMP_SPIRAL, 1 / RAMP_RADIUS, 0)]


def ramp_road(out, number, name, kind, records, length, predecessor, successor, height, limit, lane_links):
    out.begin("road", name=name, length=length, id=number, junction="-1", rule="RHT")
    out.begin("link")
    for element, link in (("predecessor", predecessor), ("successor", successor)):
        if link[0] == "junction":
            out.element(element, elementType="junction", elementId=link[1])
        else:
            out.element(element, elementType="road", elementId=link[1], contactPoint=link[2])
    out.end()
    out.begin("type", s=0, type="motorway")
    out.element("speed", max=limit, unit="km/h")
    out.end()
    plan_view(out, records)
    out.begin("elevationProfile")
    poly(out, "elevation", 0, height)
    out.end()
    out.element("lateralProfile")
    out.begin("lanes")
    out.begin("laneSection", s=0)
    out.begin("center")
    lane(out, 0, "none", mark="edge")
    out.end()
    out.begin("right")
    for lane_id, type_, width, mark in ((-1, kind, DRIVING, "edge"), (-2, "shoulder", OUTER_SHOULDER, "none")):
        previous, next_ = lane_links
        lane(out, lane_id, type_, [(0, width)], mark, previous=lane_id if previous else None, next_=lane_id if next_ else None)
    out.end()
    out.end()
    out.end()
    out.begin("objects")
    rail_t = -(DRIVING + OUTER_SHOULDER + RAIL_GAP)
    barrier(out, number * 1000, "guard_rail_right", "guardRail", [(0, length, rail_t, rail_t)], 0.75, 0.3)
    out.end()
    out.end()


def motorway():
    axis, out = Axis(), Writer()
    out.lines.append('<?xml version="1.0" encoding="UTF-8"?>')
    out.lines.append("<!-- Written by make_motorway.py; change that and run it again. -->")
    out.begin("OpenDRIVE")
    out.element("header", revMajor=1, revMinor=8, name="motorway", version="1.00", date="2026-01-01T00:00:00", north=0, south=0,
                east=0, west=0, vendor="Septet")

    rail_t, wide_t = -(OUTER_T + RAIL_GAP), -(OUTER_T + DRIVING + RAIL_GAP)
    exit_start, entry_end = EXIT_S - LANE_LENGTH, LANE_LENGTH
    out_taper, in_taper = smooth(0.0, DRIVING, TAPER), smooth(DRIVING, 0.0, TAPER)
    full = LANE_LENGTH - TAPER
    main_road(out, axis, 1, "main line west of the rest area", 0.0, EXIT_S, None, "100", [
        dict(s=0.0, before=False, links={8: dict(next_=-9)}),
        dict(s=exit_start, extra=("exit", [(0, *out_taper), (TAPER, DRIVING)]), after=False, links={8: {}, 9: dict(previous=-8)}),
    ], [(0, exit_start, rail_t, rail_t), (exit_start, TAPER, rail_t, wide_t), (exit_start + TAPER, full, wide_t, wide_t)])

    # Between the ramps the shoulder starts and ends with no width, where the ramp's lane still lies in its place.
    gore, opening = 50.0, 60.0
    length = ENTRY_S - EXIT_S
    shoulder = [(0, 0), (gore, *smooth(0.0, OUTER_SHOULDER, opening)), (gore + opening, OUTER_SHOULDER),
                (length - gore - opening, *smooth(OUTER_SHOULDER, 0.0, opening)), (length - gore, 0)]
    main_road(out, axis, 2, "main line along the rest area", EXIT_S, ENTRY_S, "100", "101",
              [dict(s=0.0, before=False, after=False, shoulder=shoulder)],
              [(gore + opening, length - 2 * (gore + opening), rail_t, rail_t)])
    main_road(out, axis, 3, "main line east of the rest area", ENTRY_S, END_S, "101", None, [
        dict(s=0.0, extra=("entry", [(0, DRIVING), (full, *in_taper)]), before=False, links={8: {}, 9: dict(next_=-8)}),
        dict(s=entry_end, after=False, links={8: dict(previous=-9)}),
    ], [(0, full, wide_t, wide_t), (full, TAPER, wide_t, rail_t), (entry_end, END_S - ENTRY_S - entry_end, rail_t, rail_t)])

    x, y, heading = axis.pose(EXIT_S)
    start = (x + EDGE_T * math.sin(heading), y - EDGE_T * math.cos(heading), heading)
    exit_records, exit_end, ramp_length = chain(start, RAMP)
    along = (exit_end[0] - start[0]) * math.cos(heading) + (exit_end[1] - start[1]) * math.sin(heading)
    service = (ENTRY_S - EXIT_S) - 2 * along
    service_records, service_end, _ = chain(exit_end, [("line", service, 0, 0)])
    # Mirrored and driven the other way: the curvatures keep their signs and change places.
    entry_ramp = [(kind, part, k1, k0) for kind, part, k0, k1 in reversed(RAMP)]
    entry_records, end, _ = chain(service_end, entry_ramp)
    x, y, heading = axis.pose(ENTRY_S)
    target = (x + EDGE_T * math.sin(heading), y - EDGE_T * math.cos(heading))
    assert math.dist(end[:2], target) < 1e-6, (end, target)

    height = HEIGHTS[8][1]
    ramp_road(out, 11, "exit to the rest area", "offRamp", exit_records, ramp_length, ("junction", "100"), ("road", "12", "start"),
              height, 80, (False, True))
    ramp_road(out, 12, "rest area", "driving", service_records, service, ("road", "11", "end"), ("road", "13", "start"), height, 50,
              (True, True))
    ramp_road(out, 13, "entry from the rest area", "onRamp", entry_records, ramp_length, ("road", "12", "end"), ("junction", "101"),
              height, 80, (True, False))

    through = [(n, n) for n in range(8, 0, -1)] + [(-n, -n) for n in range(1, 8)]
    junction(out, 100, "exit", [(1, 2, "start", through), (1, 11, "start", [(-8, -1), (-9, -2)])])
    junction(out, 101, "entry", [(2, 3, "start", through), (13, 3, "start", [(-1, -8), (-2, -9)])])
    out.end()
    return "\n".join(out.lines) + "\n"


if __name__ == "__main__":
    print(motorway(), end="")
