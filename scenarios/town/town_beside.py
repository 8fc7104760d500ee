"""What stands beside the streets: rows of houses with shops in the middle of the town, houses in gardens further out, the square before
the station, the school, the church, parks. Nothing stands on a road or in another building.
"""
import math
import random

from town_geometry import moved, samples, turned
from town_plan import CHURCH, PARKS, SCHOOL, SPACING, SQUARE, Plan  # noqa: F401

CELL = 24.0
GAP = 0.3  # Between a building and a pavement.
CENTRE = [(i, j) for i in range(2, 7) for j in range(1, 6)]


class Box:
    """A building's place in plan: middle, heading, half sizes."""

    def __init__(self, x, y, heading, length, width):
        self.x, self.y, self.heading, self.half = x, y, heading, (length / 2, width / 2)
        self.along = (math.cos(heading), math.sin(heading))

    def local(self, x, y):
        dx, dy = x - self.x, y - self.y
        return dx * self.along[0] + dy * self.along[1], -dx * self.along[1] + dy * self.along[0]

    def distance(self, x, y):
        u, v = self.local(x, y)
        return math.hypot(max(abs(u) - self.half[0], 0.0), max(abs(v) - self.half[1], 0.0))

    def meets(self, other, clear):
        """Whether they come nearer than about `clear`, by the axes of both."""
        for a, b in ((self, other), (other, self)):
            for axis, half in ((a.along, a.half[0]), ((-a.along[1], a.along[0]), a.half[1])):
                apart = abs((b.x - a.x) * axis[0] + (b.y - a.y) * axis[1])
                reach = b.half[0] * abs(b.along[0] * axis[0] + b.along[1] * axis[1]) + b.half[1] * abs(-b.along[1] * axis[0] + b.along[0] * axis[1])
                if apart >= half + reach + clear:
                    return False
        return True


class Beside:
    def __init__(self, plan):
        self.plan, self.boxes, self.grid, self.paved = plan, [], {}, {}
        self.rows = {street: [] for street in plan.streets}  # Objects of each street: attributes, in order.
        self.lines = {street: [] for street in plan.streets}  # Fences, hedges, walls: (form, height, width, [(s, length, t)]).
        self.areas = []
        for street in plan.streets:
            for s, (x, y, heading) in samples(street.ends[0], street.plan, 3.0):
                self.paved.setdefault(self.cell(x, y), []).append((x, y, heading, street.edge(), street.edge(True)))
        for at, arms in plan.arms.items():
            x, y = plan.points[at]
            reach = max(arm.size for arm in arms) * 0.8
            self.paved.setdefault(self.cell(x, y), []).append((x, y, 0.0, reach, reach))
        for street in plan.streets:
            for left in (False, True):
                self.line_street(street, left)
        self.landmarks()
        for street in plan.streets:
            self.plant(street)

    @staticmethod
    def cell(x, y):
        return math.floor(x / CELL), math.floor(y / CELL)

    def near(self, table, x, y, reach):
        (i0, j0), (i1, j1) = self.cell(x - reach, y - reach), self.cell(x + reach, y + reach)
        for i in range(i0, i1 + 1):
            for j in range(j0, j1 + 1):
                yield from table.get((i, j), ())

    def is_free(self, box, clear, overlap=False):
        reach = math.hypot(*box.half) + 20.0
        for x, y, heading, right, left in self.near(self.paved, box.x, box.y, reach):
            # On the side that the box is on.
            side = (box.x - x) * -math.sin(heading) + (box.y - y) * math.cos(heading)
            if box.distance(x, y) < (left if side > 0 else right) + GAP - 0.05:
                return False
        mine = Box(box.x, box.y, box.heading, 2 * box.half[0] - 1.0, 2 * box.half[1]) if overlap else box
        return not any(mine.meets(other, clear) for other in self.near(self.grid, box.x, box.y, 40.0))

    def take(self, box):
        self.grid.setdefault(self.cell(box.x, box.y), []).append(box)

    def pose_on(self, street, s):
        return next(moved(pose, 0) for at, pose in samples(street.ends[0], street.plan, 1.0) if at >= s - 1e-9)

    def block_of(self, street, left):
        """The block on this side of the street, by its south-western crossing; none beyond the border."""
        if isinstance(street.a, str):
            return None
        (i, j), (k, m) = street.a, street.b
        if j == m:
            return (min(i, k), j if (k > i) == left else j - 1)
        if i == k:
            return (i - 1 if (m > j) == left else i, min(j, m))
        return None

    def line_street(self, street, left):
        """A row of buildings on one side."""
        block = self.block_of(street, left)
        if block in (SQUARE, SCHOOL, CHURCH, *PARKS):
            return
        chance = random.Random(f"{street.a} {street.b} {left}")
        middle = not isinstance(street.a, str) and street.a in CENTRE and street.b in CENTRE
        row = middle or street.kind in ("main", "boulevard") and not isinstance(street.a, str)
        sign, edge = (1, street.edge(True)) if left else (-1, street.edge())
        s, fronts = chance.uniform(1.0, 4.0), []
        while s < street.length - 8.0:
            if row:
                length, depth = chance.choice((10, 12, 14)), 12
                storeys = chance.choice((3, 4, 4, 5) if middle else (2, 3, 3))
                kind = "shop" if middle and (street.kind != "quiet" or "Bahnhof" in street.name or chance.random() < 0.3) else "apartments"
                height, back, gap = 3.0 * storeys + 3.5, GAP, 0.0 if chance.random() < 0.94 else 6.0
                if s > street.length * 0.45 and s < street.length * 0.55 and chance.random() < 0.35:
                    gap = 5.0
            else:
                length, depth = chance.choice((9, 10, 12)), 9
                kind, height = "house", chance.choice((6.5, 8.5, 8.5))
                back, gap = chance.choice((4.0, 5.0, 6.0)), chance.uniform(6.0, 12.0)
            if self.place(street, s + length / 2, sign, edge, back, (length, depth, height), kind, row):
                fronts.append((s, length, back))
                s += length + gap
            else:
                s += 2.5
        if not row and fronts:
            self.fence(street, sign, edge, fronts, chance)

    def place(self, street, s, sign, edge, back, size, kind, row):
        if s + size[0] / 2 > street.length + 6.0:
            return False
        x, y, heading = self.pose_on(street, min(s, street.length))
        for more in ((0.0, 0.5, 1.0, 1.6) if row else (0.0,)):
            t = sign * (edge + back + more + size[1] / 2)
            box = Box(x - t * math.sin(heading), y + t * math.cos(heading), heading, size[0], size[1])
            if self.is_free(box, 0.0 if row else 2.0, row):
                self.take(box)
                self.rows[street].append(dict(type="building", subtype=kind, s=round(s, 2), t=round(t, 2), zOffset=0, hdg=0 if sign > 0 else 3.14159,
                                              length=size[0], width=size[1], height=size[2]))
                return True
        return False

    def fence(self, street, sign, edge, fronts, chance):
        """Along the gardens, from door to door, open before each."""
        forms, doors = {}, [s + length / 2 for s, length, _ in fronts]
        for a, b in zip(doors, doors[1:]):
            form = chance.choice((("hedge", 1.2, 0.6), ("fence", 1.1, 0), ("wall", 0.8, 0.25), None))
            if form and b - a < 30.0:
                t = sign * (edge + 0.35 + 0.5 * form[2])
                forms.setdefault(form, []).append((round(a + 0.9, 2), round(b - a - 1.8, 2), round(t, 2)))
        self.lines[street] += [(*form, pieces) for form, pieces in forms.items()]

    # Landmarks

    def block_frame(self, block):
        """Middle of a block and its heading."""
        i, j = block
        corners = [self.plan.points.get((i + a, j + b), None) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        known = [corner for corner in corners if corner]
        x, y = (sum(c[n] for c in known) / len(known) for n in (0, 1))
        a, b = (corners[0], corners[1]) if corners[0] and corners[1] else (corners[3], corners[2])
        return x, y, math.atan2(b[1] - a[1], b[0] - a[0])

    def street_beside(self, block):
        """The street on the block's southern, else northern side, from which its objects are told."""
        i, j = block
        for row in (j, j + 1):
            for street in self.plan.streets:
                if {street.a, street.b} == {(i, row), (i + 1, row)}:
                    return street
        return next(street for street in self.plan.streets if (i, j) in (street.a, street.b))

    def tell(self, street, x, y, heading, **attributes):
        """An object at a place of the world, in the coordinates of a street."""
        s, pose = min(samples(street.ends[0], street.plan, 1.0), key=lambda one: math.dist(one[1][:2], (x, y)))
        along = (x - pose[0]) * math.cos(pose[2]) + (y - pose[1]) * math.sin(pose[2])
        t = -(x - pose[0]) * math.sin(pose[2]) + (y - pose[1]) * math.cos(pose[2])
        if abs(along) > 1.5:
            return False
        self.rows[street].append(dict(attributes, s=round(s, 2), t=round(t, 2), zOffset=0, hdg=round(turned(heading - pose[2]), 4)))
        return True

    def landmark(self, block, u, v, turn, size, kind):
        x, y, heading = self.block_frame(block)
        x, y, heading = moved((x, y, heading), u, v, turn)
        box = Box(x, y, heading, size[0], size[1])
        if self.is_free(box, -0.3) and self.tell(self.street_beside(block), x, y, heading, type="building", subtype=kind, length=size[0], width=size[1],
                                                height=size[2]):
            self.take(box)

    def landmarks(self):
        self.landmark(SQUARE, 0, -42, 0.0, (70, 16, 11), "station")
        self.landmark(SQUARE, 0, -42 + 16, 0.0, (1, 1, 4.5), "clock")
        self.landmark(SCHOOL, 0, -20, 0.0, (52, 14, 9.5), "school")
        self.landmark(SCHOOL, -32, 14, 0.0, (14, 28, 9.5), "school")
        self.landmark(SCHOOL, 28, 30, 0.0, (26, 16, 7.5), "gymnasium")
        self.landmark(CHURCH, 0, 0, 0.0, (30, 13, 13), "church")
        self.landmark(CHURCH, -18.4, 0, 0.0, (6.4, 6.4, 34), "tower")
        for block, rows, step, least in ((SQUARE, (-22, 38), 13, 4.0), (SCHOOL, (-60, 60), 15, 5.0), (CHURCH, (-60, 60), 17, 5.0),
                                         *((park, (-64, 64), 16, 4.0) for park in PARKS)):
            self.grove(block, rows, step, least)

    def grove(self, block, rows, step, clear):
        chance = random.Random(f"grove {block}")
        street, frame = self.street_beside(block), self.block_frame(block)
        for u in range(-64, 65, step):
            for v in range(rows[0], rows[1] + 1, step):
                tree = moved(frame, u + chance.uniform(-3, 3), v + chance.uniform(-3, 3))
                if chance.random() < (0.75 if block in PARKS else 0.4):
                    self.tree(street, tree[0], tree[1], clear, chance)

    def tree(self, street, x, y, clear, chance):
        box = Box(x, y, 0.0, 2.0, 2.0)
        if self.is_free(box, clear):
            if chance.random() < 0.2:
                self.tell(street, x, y, 0.0, type="vegetation", subtype="bush", radius=0.8, height=round(chance.uniform(1.2, 2.2), 1))
            else:
                self.tell(street, x, y, 0.0, type="tree", radius=2, height=round(chance.uniform(6.0, 10.5), 1))

    def plant(self, street):
        """Trees along the boulevard, and in gardens and yards."""
        chance = random.Random(f"trees {street.a} {street.b}")
        if street.kind == "boulevard":
            s = 14.0
            while s < street.length - 14.0:
                for t in (7.4, -7.4):
                    self.rows[street].append(dict(type="tree", s=s, t=t, zOffset=0, radius=2, height=round(chance.uniform(5.5, 6.5), 1)))
                s += 15.0
            return
        for sign, edge in ((1, street.edge(True)), (-1, street.edge())):
            s = chance.uniform(6, 16)
            while s < street.length - 6.0:
                x, y, heading = self.pose_on(street, s)
                t = sign * (edge + (3.0 if chance.random() < 0.4 else chance.uniform(20, 34)))
                self.tree(street, x - t * math.sin(heading), y + t * math.cos(heading), 2.2, chance)
                s += chance.uniform(12, 26)

    # Writing

    def write(self, town, street, _):
        out = town.out
        for row in self.rows[street]:
            out.element("object", id=town.number(), **row)
        for form, height, width, pieces in self.lines[street]:
            s, length, t = pieces[0]
            out.begin("object", id=town.number(), type="barrier", subtype=form, s=s, t=t, zOffset=0, length=length, width=width or 0.1, height=height)
            for s, length, t in pieces:
                out.element("repeat", s=s, length=length, distance=0, tStart=t, tEnd=t, heightStart=height, heightEnd=height, zOffsetStart=0,
                            zOffsetEnd=0, **(dict(widthStart=width, widthEnd=width) if width else {}))
            out.end()

    @staticmethod
    def write_island(town, radius):
        out = town.out
        out.begin("object", id=town.number(), name="middle of the roundabout", type="trafficIsland", subtype="grass", s=0, t=radius + 1.0, zOffset=0, length=2 * radius,
                  width=2 * radius, height=0.12)
        out.begin("outline", fillType="grass", closed="true")
        for i in range(32):
            angle = 2 * math.pi * i / 32
            out.element("cornerLocal", u=round(radius * math.cos(angle), 3), v=round(radius * math.sin(angle), 3), z=0, height=0.12)
        out.end()
        out.end()
        # The ring's road turns to the left: t of the middle is the radius.
        for s, t in ((0, 16.0), (4, 9.0), (7, 11.0), (1, 24.0), (6, 22.0)):
            out.element("object", id=town.number(), type="tree" if t < 16.0 else "vegetation", s=s, t=t, zOffset=0, radius=1, height=5 if t < 16.0 else 2)
