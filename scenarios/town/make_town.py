#!/usr/bin/env python3
"""Writes the town's roads (ASAM OpenDRIVE 1.8) and its scenario (ASAM OpenSCENARIO 1.3).

    make_town.py town.xodr > town.xodr
    make_town.py town.xosc > town.xosc

town_plan.py says what lies where; this file writes streets, crossings and their signs, town_beside.py what stands beside the streets.
Streets run along s from one crossing to the next; each lane that turns has a connecting road of its own. At each crossing the first
connection is the scenario's way, else straight on.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "motorway-ambulance"))
from opendrive_writer import Writer, plan_view, poly  # noqa: E402
from town_beside import Beside  # noqa: E402
from town_geometry import biarc, end_of, fillet, moved, turned  # noqa: E402
from town_plan import BETWEEN, KERB, LIMIT, PROFILES, ROUNDABOUTS, WAY, ZEBRAS, Plan  # noqa: E402
from town_roundabout import BESIDE, HALF, ISLAND, LANE, RING, WAY as WAY_RADIUS, WAY_LENGTH, ring_point  # noqa: E402
from town_scenario import scenario  # noqa: E402

PARKING_FROM, PARKING_RAMP = 18.0, 2.5  # Parking lanes begin so far from a street's end, and widen over the ramp.
ZEBRA = 4.0
CROSSING_FROM = 1.0  # From a street's end to its crossing with lights.
STOP_LINE = CROSSING_FROM + ZEBRA + 1.0
RING_PAVEMENT = PROFILES["main"][1][1]


def rounded(value):
    return round(value, 5)


class Town:
    def __init__(self):
        self.plan, self.out = Plan(), Writer()
        self.numbers = {street: number for number, street in enumerate(self.plan.streets, 1)}
        self.next_road, self.next_signal, self.next_object = 1000, 1, 1
        self.junctions, self.groups = [], []
        self.lights = []  # Of each crossing with lights: (number, name, [(signal, group, is it for walkers)]).
        self.beside = Beside(self.plan)

    # Roads

    def road(self, number, name, start, plan, links, junction, limit, lanes, heights, furniture=None):
        out, records, s, pose = self.out, [], 0.0, start
        for piece in plan:
            x, y, heading = pose
            kind, length, k0, k1 = piece
            records.append((rounded(s), (rounded(x), rounded(y), round(turned(heading), 7)), kind, rounded(length), round(k0, 9), round(k1, 9)))
            pose, s = end_of(pose, [piece]), s + length
        out.begin("road", name=name, length=rounded(s), id=number, junction=junction, rule="RHT")
        if any(links):
            out.begin("link")
            for end, (kind, target, *contact) in zip(("predecessor", "successor"), links):
                if target is not None:
                    out.element(end, elementType=kind, elementId=target, **({"contactPoint": contact[0]} if contact else {}))
            out.end()
        out.begin("type", s=0, type="town")
        out.element("speed", max=limit, unit="km/h")
        out.end()
        plan_view(out, records)
        (z0, z1), length = heights, s
        out.begin("elevationProfile")
        rise = z1 - z0
        poly(out, "elevation", 0, z0, 0, round(3 * rise / length**2, 12), round(-2 * rise / length**3, 15))
        out.end()
        out.begin("lanes")
        lanes(length)
        out.end()
        if furniture:
            furniture(length)
        out.end()

    def lane(self, number, kind, widths, mark=None, links=(None, None), heights=()):
        out = self.out
        out.begin("lane", id=number, type=kind)
        if links != (None, None):
            out.begin("link")
            for end, target in zip(("predecessor", "successor"), links):
                if target is not None:
                    out.element(end, id=target)
            out.end()
        for width in widths:
            poly(out, "width", *width, station="sOffset")
        if mark:
            out.element("roadMark", sOffset=0, type=mark, color="standard", width=0.12)
        for s, height in heights:
            out.element("height", sOffset=s, inner=height, outer=height)
        out.end()

    def street_lanes(self, street):
        def widths(kind, width, outside, length):
            if outside is None:
                return [(0, width)]
            # A lane between the crossings takes its place from the pavement outside of it.
            begin, end, full = PARKING_FROM, length - PARKING_FROM - PARKING_RAMP, outside
            base, sign = (0.0, 1) if kind in BETWEEN else (width + outside, -1)
            c, d = 3 * full / PARKING_RAMP**2, -2 * full / PARKING_RAMP**3
            return [(0, base), (begin, base, 0, sign * c, sign * d), (begin + PARKING_RAMP, base + sign * full),
                    (end, base + sign * full, 0, -sign * c, -sign * d), (end + PARKING_RAMP, base)]

        def side(lanes, sign, length):
            between = next((width for kind, width in lanes if kind in BETWEEN), None)
            rows = []
            for number, (kind, width) in enumerate(lanes, 1):
                changes = between if kind in (*BETWEEN, "sidewalk") else None
                raised = [(0, KERB)] if kind in ("sidewalk", "biking", "none") else ()
                next_kind = lanes[number][0] if number < len(lanes) else None
                mark = {("driving", "driving"): "broken"}.get((kind, next_kind))
                rows.append((sign * number, kind, widths(kind, width, changes, round(length, 3)), mark, (None, None), raised))
            return rows

        def write(length):
            out = self.out
            if street.offset:
                poly(out, "laneOffset", 0, street.offset)
            out.begin("laneSection", s=0)
            out.begin("left")
            for row in reversed(side(street.left, 1, length)):
                self.lane(*row)
            out.end()
            out.begin("center")
            self.lane(0, "none", (), {"main": "broken", "boulevard": "solid solid"}.get(street.kind))
            out.end()
            out.begin("right")
            for row in side(street.right, -1, length):
                self.lane(*row)
            out.end()
            out.end()
        return write

    def one_lane(self, widths, links=(None, None), pavement=None, inner=None):
        def write(_):
            out = self.out
            out.begin("laneSection", s=0)
            out.begin("center")
            self.lane(0, "none", (), inner)
            out.end()
            out.begin("right")
            self.lane(-1, "driving", widths, None, links)
            if pavement:
                self.lane(-2, "sidewalk", [(0, pavement)], None, (None, None), [(0, KERB)])
            out.end()
            out.end()
        return write

    def streets(self):
        for street, number in self.numbers.items():
            links = []
            for at, at_start in ((street.a, True), (street.b, False)):
                links.append((None, None) if isinstance(at, str) else ("junction", self.junction_of(at, street, at_start)))
            self.road(number, street.name, street.ends[0], street.plan, links, "-1", LIMIT[street.kind], self.street_lanes(street),
                      street.heights, lambda length, street=street: self.furniture(street, length))

    def junction_of(self, at, street, at_start):
        """Each arm of a roundabout has a junction of its own."""
        number = 100 * (at[0] + 1) + 10 * at[1]
        if at in ROUNDABOUTS:
            number += next(i for i, arm in enumerate(self.plan.arms[at]) if arm.street is street and arm.at_start == at_start)
        return number

    # Crossings

    def connections_of(self, at):
        """(arm in, lane in, arm out, lane out, turn), for each lane in: the way first, then straight on, to the right, to the left."""
        arms, found = self.plan.arms[at], []
        for arm in arms:
            lanes_in, rows = arm.lanes(False), []
            for other in arms:
                lanes_out = other.lanes(True)
                if other is arm or not lanes_in or not lanes_out:
                    continue
                turn = turned(other.heading - arm.heading - math.pi)
                if abs(turn) < 0.6:
                    pairs = [(lanes_in[min(k, len(lanes_in) - 1)], lane) for k, lane in enumerate(lanes_out)] if len(lanes_in) > 1 else [
                        (lanes_in[0], lanes_out[0])]
                elif turn < 0:
                    pairs = [(lanes_in[-1], lanes_out[-1])]
                else:
                    pairs = [(lanes_in[0], lanes_out[0])]
                rows += [(arm, a, other, b, turn) for a, b in pairs]
            before, ahead = self.neighbour(at, arm), None
            ahead = self.plan.next_on_way.get((before, at))
            found += sorted(rows, key=lambda row: (self.neighbour(at, row[2]) != ahead, abs(row[4])))
        return found

    @staticmethod
    def neighbour(at, arm):
        return arm.street.b if arm.street.a == at else arm.street.a

    def pose_at(self, at, arm, outwards, shift):
        pose = moved((*self.plan.points[at], arm.heading), arm.size)
        return moved(pose, 0, -shift) if outwards else moved(pose, 0, shift, math.pi)

    def crossing(self, at):
        junction, z = self.junction_of(at, None, None), self.plan.height_of(at)
        connections, roads = [], []
        for arm, (lane_in, shift_in, width_in), other, (lane_out, shift_out, width_out), turn in self.connections_of(at):
            start, end = self.pose_at(at, arm, False, shift_in), self.pose_at(at, other, True, shift_out)
            plan = biarc(start, end) if abs(turn) < 0.6 else fillet(start, end)
            length, number = sum(piece[1] for piece in plan), self.next_road
            self.next_road += 1
            reached = end_of(start, plan)
            assert math.dist(reached[:2], end[:2]) < 1e-6 and abs(turned(reached[2] - end[2])) < 1e-6, (at, reached, end)
            widths = [(0, width_in, rounded((width_out - width_in) / length))] if width_in != width_out else [(0, width_in)]
            links = [("road", self.numbers[a.street], "start" if a.at_start else "end") for a in (arm, other)]
            self.road(number, "", start, plan, links, junction, min(LIMIT[arm.street.kind], LIMIT[other.street.kind]),
                      self.one_lane(widths, (lane_in, lane_out)), (z, z))
            connections.append((self.numbers[arm.street], number, lane_in))
            roads.append((number, arm, other))
        self.junctions.append((junction, self.name_of(at), connections, self.priorities(at, roads), self.controllers(at, junction)))

    def name_of(self, at):
        return " / ".join(dict.fromkeys(arm.street.name for arm in self.plan.arms[at]))

    def priorities(self, at, roads):
        if self.plan.priority(at) != "signs":
            return []
        return [(high, low) for high, a, _ in roads if not self.plan.is_minor(at, a) for low, b, _ in roads if self.plan.is_minor(at, b)]

    def controllers(self, at, junction):
        return [f"{junction}{group}" for group in (0, 1)] if self.plan.priority(at) == "lights" else []

    def roundabout(self, at):
        plan, arms = self.plan, self.plan.arms[at]
        middle, z, first, k = plan.points[at], plan.height_of(at), self.next_road, 1 / RING
        self.next_road += 16
        heights, junctions = (z, z), [self.junction_of(at, arm.street, arm.at_start) for arm in arms]
        for i, arm in enumerate(arms):
            ring, before, angle = first + i, first + (i + 3) % 4, arm.heading
            past, into, out_of = first + 4 + i, first + 8 + i, first + 12 + i
            number, contact, street = self.numbers[arm.street], "start" if arm.at_start else "end", arm.street
            self.road(ring, "Kreisverkehr", ring_point(middle, angle + BESIDE), [("arc", (math.pi / 2 - 2 * BESIDE) * RING, k, k)],
                      [("junction", junctions[i]), ("junction", junctions[(i + 1) % 4])], "-1", 30,
                      self.one_lane([(0, LANE)], pavement=RING_PAVEMENT, inner="solid"), heights, self.island if i == 0 else None)
            self.road(past, "", ring_point(middle, angle - BESIDE), [("arc", 2 * BESIDE * RING, k, k)],
                      [("road", before, "end"), ("road", ring, "start")], junctions[i], 30, self.one_lane([(0, LANE)], (-1, -1), inner="solid"), heights)
            outside = moved((*middle, angle), HALF)
            (lane_in, _, width_in), (lane_out, _, width_out) = arm.lanes(False)[0], arm.lanes(True)[0]
            turn = [("arc", WAY_LENGTH, -1 / WAY_RADIUS, -1 / WAY_RADIUS)]
            self.road(into, "", moved(outside, 0, turn=math.pi), turn, [("road", number, contact), ("road", ring, "start")], junctions[i], 30,
                      self.one_lane([(0, width_in, rounded((LANE - width_in) / WAY_LENGTH))], (lane_in, -1)), heights)
            self.road(out_of, "", ring_point(middle, angle - BESIDE), turn, [("road", before, "end"), ("road", number, contact)], junctions[i], 30,
                      self.one_lane([(0, LANE, rounded((width_out - LANE) / WAY_LENGTH))], (-1, lane_out)), heights)
            leaves = any(b == at and c == self.neighbour(at, arm) for (_, b), c in plan.next_on_way.items())
            ways = [(before, past, -1), (before, out_of, -1)]
            self.junctions.append((junctions[i], "Kreisverkehr", [*(reversed(ways) if leaves else ways), (number, into, lane_in)],
                                   [(past, into)], []))
        self.groups.append((junctions[0], junctions))

    def island(self, _):
        self.out.begin("objects")
        self.beside.write_island(self, ISLAND)
        self.out.end()

    # Signs, lights, crossings on foot, and what stands beside

    def number(self):
        self.next_object += 1
        return self.next_object - 1

    def signal(self, s, t, against, type_, number=None, subtype="-1", size=0.6, width=None, z=2.2, value=None, unit=None, text=None, turn=None,
               dynamic=False):
        if number is None:
            number, self.next_signal = self.next_signal, self.next_signal + 1
        more = {} if dynamic else dict(country="DE", countryRevision="2017")
        for name, given in (("value", value), ("unit", unit), ("text", text), ("hOffset", turn)):
            if given is not None:
                more[name] = given
        self.out.element("signal", s=round(s, 2), t=round(t, 2), id=number, dynamic="yes" if dynamic else "no", orientation="-" if against else "+",
                         zOffset=z, type=type_, subtype=subtype, height=size, width=width or size, **more)
        return number

    def crosswalk(self, street, s):
        out, low, high = self.out, -street.kerb(), street.kerb(True)
        out.begin("object", id=self.number(), type="crosswalk", s=round(s, 2), t=0, zOffset=0, orientation="none", length=ZEBRA,
                  width=round(high - low, 2), height=0.01)
        out.begin("outline")
        for u, v in ((-ZEBRA / 2, low), (ZEBRA / 2, low), (ZEBRA / 2, high), (-ZEBRA / 2, high)):
            out.element("cornerLocal", u=u, v=v, z=0, height=0.01)
        out.end()
        out.end()

    def zebras(self, street, length):
        """Stations of crossings on foot: without lights, then with lights."""
        plain = []
        for pair in ZEBRAS:
            if set(pair) == {street.a, street.b}:
                plain.append(length / 2 if "quiet" in street.kind else 26.0 if street.a == pair[0] else length - 26.0)
        near = CROSSING_FROM + ZEBRA / 2
        lit = [s for at, s in ((street.a, near), (street.b, length - near)) if not isinstance(at, str) and self.plan.priority(at) == "lights"]
        return plain, lit

    def furniture(self, street, length):
        out, (plain, lit) = self.out, self.zebras(street, length)
        out.begin("objects")
        for s in plain + lit:
            self.crosswalk(street, s)
        self.beside.write(self, street, length)
        out.end()
        out.begin("signals")
        for at, at_start in ((street.a, True), (street.b, False)):
            if isinstance(at, str):
                self.signs_of_entry(street, length, at)
            else:
                self.signs_at_end(street, length, at, at_start)
        for s in plain:
            self.signal(s - ZEBRA / 2 - 0.6, -street.kerb() - 0.6, False, "350")
            if not street.one_way:
                self.signal(s + ZEBRA / 2 + 0.6, street.kerb(True) + 0.6, True, "350")
        out.end()

    def signs_of_entry(self, street, length, at):
        t = street.edge() + 0.6
        self.signal(30, -t, False, "310", size=0.9, width=1.5, text="Septetsburg")
        self.signal(28, t, True, "311", size=0.9, width=1.5, text="Septetsburg")

    def signs_at_end(self, street, length, at, at_start):
        plan = self.plan
        arm = next(a for a in plan.arms[at] if a.street is street and a.at_start == at_start)
        s_of = lambda before: before if at_start else length - before  # noqa: E731
        side = 1 if at_start else -1  # Of who comes to the crossing.
        kerb_in, kerb_out = side * street.kerb(at_start), -side * street.kerb(not at_start)
        comes, leaves = bool(arm.lanes(False)), bool(arm.lanes(True))
        beside_in, beside_out = kerb_in + side * 0.6, kerb_out - side * 0.6
        order = plan.priority(at)
        if order == "lights":
            self.lights_at_end(street, at, arm, s_of, side, kerb_in, kerb_out)
        elif order == "roundabout":
            self.signal(s_of(1.0), beside_in, at_start, "205", size=0.9, z=2.9)
            self.signal(s_of(1.0), beside_in, at_start, "215")
        elif order == "signs" and comes:
            if plan.is_minor(at, arm):
                if plan.has_stop(at):
                    self.signal(s_of(0.8), side * (abs(kerb_in) - 1.5), at_start, "294", z=0, size=0.01, width=3.0)
                    self.signal(s_of(1.0), beside_in, at_start, "206", size=0.9)
                else:
                    self.signal(s_of(1.0), beside_in, at_start, "205", size=0.9)
            else:
                self.signal(s_of(14.0), beside_in, at_start, "306", size=0.6)
        other_kinds = {a.street.kind for a in plan.arms[at] if a is not arm}
        if street.kind == "quiet" and other_kinds & {"main", "boulevard"}:
            if leaves:
                self.signal(s_of(7.0), beside_out, not at_start, "274.1", size=0.84, width=0.6, value=30, unit="km/h")
            if comes:
                self.signal(s_of(7.0), beside_out, at_start, "274.2", size=0.84, width=0.6, value=30, unit="km/h")
        if street.one_way and not comes:
            self.signal(s_of(4.0), beside_out, not at_start, "220", subtype="20", size=0.3, width=0.8)
        if street.one_way and not leaves:
            for t in (beside_in, beside_out):
                self.signal(s_of(2.0), t, not at_start, "267")

    def lights_at_end(self, street, at, arm, s_of, side, kerb_in, kerb_out):
        plan = self.plan
        junction = self.junction_of(at, None, None)
        if not self.lights or self.lights[-1][0] != junction:
            known = next((entry for entry in self.lights if entry[0] == junction), None)
            if known is None:
                self.lights.append((junction, self.name_of(at), []))
        heads = next(entry for entry in self.lights if entry[0] == junction)[2]
        # Group 0 is the row's streets.
        group = 0 if min(abs(turned(arm.heading - plan.axes[at][0])), abs(turned(arm.heading - plan.axes[at][0] - math.pi))) < 0.5 else 1
        at_start = arm.at_start
        lanes = arm.lanes(False)
        if lanes:
            self.signal(s_of(STOP_LINE), side * (lanes[0][1] + 1.5), at_start, "294", z=0, size=0.01, width=3.0)
            heads.append((self.signal(s_of(0.6), kerb_in + side * 0.5, at_start, "1000001", size=0.95, width=0.32, z=2.4, dynamic=True), group, False))
        across = s_of(CROSSING_FROM + ZEBRA + 0.4)
        for t in (kerb_in + side * 0.5, kerb_out - side * 0.5):
            turn = math.pi / 2 if t > 0 else -math.pi / 2
            heads.append((self.signal(across, t, False, "1000002", size=0.64, width=0.32, z=2.3, turn=round(turn, 4), dynamic=True), 1 - group, True))

    # The file

    def write_junctions(self):
        out = self.out
        for junction, _, heads in self.lights:
            for group in (0, 1):
                out.begin("controller", id=f"{junction}{group}", name=("row", "column")[group])
                for signal, of, walkers in heads:
                    if of == group:
                        out.element("control", signalId=signal, type="walkers" if walkers else "cars")
                out.end()
        for number, name, connections, priorities, controllers in self.junctions:
            out.begin("junction", id=number, name=name, type="default")
            for i, (incoming, connecting, lane) in enumerate(connections):
                out.begin("connection", id=i, incomingRoad=incoming, connectingRoad=connecting, contactPoint="start")
                out.element("laneLink", **{"from": lane, "to": -1})
                out.end()
            for high, low in priorities:
                out.element("priority", high=high, low=low)
            for i, controller in enumerate(controllers):
                out.element("controller", id=controller, sequence=i)
            out.end()
        for number, junctions in self.groups:
            out.begin("junctionGroup", id=number, type="roundabout")
            for junction in junctions:
                out.element("junctionReference", junction=junction)
            out.end()

    def roads(self):
        out = self.out
        out.lines += ['<?xml version="1.0" encoding="UTF-8"?>', "<!-- Written by make_town.py; change that and run it again. -->"]
        out.begin("OpenDRIVE")
        out.element("header", revMajor=1, revMinor=8, name="town", version="1.00", date="2026-01-01T00:00:00", north=0, south=0, east=0, west=0,
                    vendor="Septet")
        self.streets()
        for at in self.plan.points:
            self.roundabout(at) if at in ROUNDABOUTS else self.crossing(at)
        self.write_junctions()
        out.end()
        return "\n".join(line.lstrip() for line in out.lines) + "\n"


if __name__ == "__main__":
    town = Town()
    roads = town.roads()
    print(roads if sys.argv[1] == "town.xodr" else scenario(town), end="")
