"""The plan of the town: crossings on a bent grid, streets between them, what each is, and the way that the scenario drives.

A crossing is a pair (column, row). Metres; x to the east, y to the north.
"""
import math
import random

from town_geometry import biarc, moved, turned
from town_roundabout import HALF

COLUMNS, ROWS, SPACING = 9, 8, 190.0
KERB = 0.12
# Lanes outwards from the middle: (type, width). Those of BETWEEN are there away from the crossings only; there the pavement is wider.
BETWEEN = ("parking", "none")
PROFILES = {
    "boulevard": [("driving", 3.25), ("driving", 3.25), ("none", 1.8), ("biking", 1.6), ("sidewalk", 3.0)],
    "main": [("driving", 3.75), ("sidewalk", 3.2)],
    "quiet": [("driving", 3.25), ("parking", 2.3), ("sidewalk", 2.4)],
}
ONE_WAY = [("driving", 3.8), ("parking", 2.3), ("sidewalk", 2.4)]
ONE_WAY_LEFT = [("parking", 2.3), ("sidewalk", 2.4)]
RADIUS = {"boulevard": 10.0, "main": 10.0, "quiet": 8.0}  # Of kerbs at corners.
LIMIT = {"boulevard": 50, "main": 50, "quiet": 30}

LIGHTS = [(2, 3), (4, 3), (6, 3), (2, 5)]
ROUNDABOUTS = [(6, 5), (2, 1)]
ENTRIES = {"west": (0, 3), "east": (8, 3), "south": (2, 0), "south east": (6, 0), "north": (2, 7), "north east": (6, 7)}
# Streets driven one way only, from the first crossing on through all others.
ONE_WAYS = [[(4, 1), (4, 0), (5, 0), (5, 1), (4, 1)], [(3, 2), (3, 1)], [(5, 2), (5, 3)], [(3, 5), (3, 4)], [(7, 4), (7, 3)], [(1, 3), (1, 4)]]
SQUARE, SCHOOL, CHURCH, PARKS = (4, 0), (7, 1), (3, 3), [(3, 4), (0, 1), (7, 5)]  # Blocks, by their south-western crossing.
ZEBRAS = [((4, 3), (4, 2)), ((4, 2), (4, 1)), ((4, 3), (4, 4)), ((6, 1), (6, 2)), ((2, 3), (2, 4)), ((4, 5), (5, 5)), ((1, 3), (2, 3))]
# The way of the scenario: an entry, crossings, an entry.
WAY = ["west", (0, 3), (1, 3), (2, 3), (3, 3), (4, 3), (4, 4), (4, 5), (5, 5), (6, 5), (6, 4), (6, 3), (6, 2), (6, 1), (5, 1), (4, 1), (4, 0),
       (5, 0), (6, 0), "south east"]
ROW_NAMES = ["Südring", "Bahnhofsplatz", "Gartenstraße", "Hauptstraße", "Lindenweg", "Marktstraße", "Schillerstraße", "Nordring"]
COLUMN_NAMES = ["Westring", "Mühlenweg", "Kölner Straße", "Rosenweg", "Bahnhofstraße", "Kirchgasse", "Berliner Straße", "Schulstraße", "Ostring"]


class Street:
    """Runs from crossing (or entry) a to b; `ends`: pose at either end, looking along the street from a to b."""

    def __init__(self, a, b, kind, name, one_way=False):
        self.a, self.b, self.kind, self.name, self.one_way = a, b, kind, name, one_way
        self.right = ONE_WAY if one_way else PROFILES[kind]
        self.left = ONE_WAY_LEFT if one_way else PROFILES[kind]
        self.offset = 0.5 * ONE_WAY[0][1] if one_way else 0.0  # t of the middle line.

    def kerb(self, left=False):
        """Distance of the kerb from the axis at a crossing."""
        lanes, sign = (self.left, 1) if left else (self.right, -1)
        return sign * self.offset + sum(width for kind, width in lanes if kind == "driving")

    def edge(self, left=False):
        """Distance of the pavement's outer edge."""
        lanes, sign = (self.left, 1) if left else (self.right, -1)
        return sign * self.offset + sum(width for _, width in lanes)


class Arm:
    """A street's end at a crossing; `heading` looks away from it."""

    def __init__(self, street, at_start, heading):
        self.street, self.at_start, self.heading, self.size = street, at_start, heading, 0.0

    def lanes(self, outwards):
        """Driving lanes (id, shift of the inner border to the right of who drives there, width), from the middle on."""
        street = self.street
        right = outwards == self.at_start  # Who leaves at the street's start drives along s.
        if street.one_way and not right:
            return []
        at, found = -street.offset, []
        for number, (kind, width) in enumerate(street.right if right else street.left, 1):
            if kind == "driving":
                found.append((-number if right else number, at, width))
            at += width
        return found

    def kerb(self):
        """The larger distance of both kerbs from the axis."""
        return max(self.street.kerb(), self.street.kerb(True))


def grid_point(column, row, chance):
    x = (column - (COLUMNS - 1) / 2) * SPACING + 18 * math.sin(0.9 * row + 0.35 * column) + chance.uniform(-6, 6)
    y = (row - (ROWS - 1) / 2) * SPACING + 18 * math.sin(0.8 * column + 1.3) + chance.uniform(-6, 6)
    return x, y


def height(x, y):
    """Of crossings, which are level."""
    return round(14.0 + 3.0 * math.sin(x / 330 + 0.5) + 2.5 * math.cos(y / 300), 3)


def kind_between(a, b):
    (i, j), (k, _) = a, b
    if a[1] == b[1]:
        if j == 3:
            return "boulevard" if 2 <= min(i, k) and max(i, k) <= 6 else "main"
        return "main" if j == 5 and 2 <= min(i, k) and max(i, k) <= 6 else "quiet"
    return "main" if i in (2, 6) else "quiet"


class Plan:
    def __init__(self):
        chance = random.Random(1)
        self.points = {(i, j): grid_point(i, j, chance) for j in range(ROWS) for i in range(COLUMNS)}
        corners = [(i, j) for i in (0, COLUMNS - 1) for j in (0, ROWS - 1)]
        self.streets = []
        one_way = {pair for way in ONE_WAYS for pair in zip(way, way[1:])}
        for pair in self.pairs(corners, chance, one_way):
            a, b = pair[::-1] if pair[::-1] in one_way else pair
            name = ROW_NAMES[a[1]] if a[1] == b[1] else COLUMN_NAMES[a[0]]
            self.streets.append(Street(a, b, kind_between(a, b), name, (a, b) in one_way))
        for i, j in corners:
            del self.points[i, j]
        for name, at in ENTRIES.items():
            self.streets.append(Street(name, at, "main", f"Landstraße ({name})"))
        self.axes = {at: self.axis_headings(at) for at in self.points}
        self.arms = {at: self.arms_of(at) for at in self.points}
        self.set_sizes()
        self.draw()
        self.next_on_way = {(a, b): c for a, b, c in zip(WAY, WAY[1:], WAY[2:])}

    def pairs(self, corners, chance, one_way):
        """Crossings with a street between them: the grid, its corners rounded, less some quiet streets so that there are T's."""
        pairs = [((i, j), (i + 1, j)) for j in range(ROWS) for i in range(COLUMNS - 1)]
        pairs += [((i, j), (i, j + 1)) for i in range(COLUMNS) for j in range(ROWS - 1)]
        pairs = [pair for pair in pairs if not set(pair) & set(corners)]
        degree = {at: sum(at in pair for pair in pairs) + (at in ENTRIES.values()) for at in self.points}
        kept = {frozenset(pair) for pair in zip(WAY, WAY[1:])} | {frozenset(pair) for pair in [*ZEBRAS, *one_way]}
        tried = [pair for pair in pairs if kind_between(*pair) == "quiet" and frozenset(pair) not in kept and not set(pair) & set(ROUNDABOUTS)]
        chance.shuffle(tried)
        removed = 0
        for a, b in tried:
            if removed < 22 and min(degree[a], degree[b]) > 3:
                pairs.remove((a, b))
                degree[a] -= 1
                degree[b] -= 1
                removed += 1
        last_column, last_row = COLUMNS - 1, ROWS - 1
        return pairs + [((0, 1), (1, 0)), ((last_column - 1, 0), (last_column, 1)), ((0, last_row - 1), (1, last_row)),
                        ((last_column - 1, last_row), (last_column, last_row - 1))]

    def axis_headings(self, at):
        """Headings of the lines through a crossing, along its row and its column: those between the neighbours."""
        def between(back, ahead):
            a, b = self.points.get(back, self.points[at]), self.points.get(ahead, self.points[at])
            return math.atan2(b[1] - a[1], b[0] - a[0])
        i, j = at
        row, column = between((i - 1, j), (i + 1, j)), between((i, j - 1), (i, j + 1))
        mean = row + 0.5 * turned(column - math.pi / 2 - row)
        return (mean, mean + math.pi / 2) if at in ROUNDABOUTS else (row, column)

    def arms_of(self, at):
        """Counter-clockwise, from the east on."""
        arms = {}
        for street in self.streets:
            if at not in (street.a, street.b):
                continue
            other = street.b if street.a == at else street.a
            if isinstance(other, str):
                side = {"west": 2, "east": 0, "south": 3, "north": 1}[other.split()[0]]
            elif at[1] == other[1]:
                side = 0 if other[0] > at[0] else 2
            elif at[0] == other[0]:
                side = 1 if other[1] > at[1] else 3
            else:  # A rounded corner goes on along the border.
                side = (0 if other[0] > at[0] else 2) if at[1] in (0, ROWS - 1) else (1 if other[1] > at[1] else 3)
            arms[side] = Arm(street, street.a == at, self.axes[at][side % 2] + (math.pi if side >= 2 else 0.0))
        return [arms[side] for side in sorted(arms)]

    def set_sizes(self):
        """Distance of each street's end from the crossing: there the kerbs' arcs end."""
        for at, arms in self.arms.items():
            if at in ROUNDABOUTS:
                continue
            for arm in arms:
                for other in arms:
                    apart = abs(turned(other.heading - arm.heading))
                    if other is arm or apart > 2.6:
                        continue
                    radius = min(RADIUS[arm.street.kind], RADIUS[other.street.kind])
                    if "quiet" not in (arm.street.kind, other.street.kind):
                        radius = max(RADIUS[arm.street.kind], RADIUS[other.street.kind])
                    if arm.street.one_way or other.street.one_way:  # Who turns left there has the inner kerb beside him.
                        radius = max(radius, 12.0)
                    corner = (other.kerb() + arm.kerb() * math.cos(apart)) / math.sin(apart)
                    arm.size = max(arm.size, corner + radius / math.tan(apart / 2))

    def draw(self):
        """Poses of the streets' ends, and their curves."""
        for at in ROUNDABOUTS:
            for arm in self.arms[at]:
                arm.size = HALF
        ends = {}
        for at, arms in self.arms.items():
            for arm in arms:
                pose = moved((*self.points[at], arm.heading), arm.size)
                ends[arm.street, arm.at_start] = pose if arm.at_start else (pose[0], pose[1], pose[2] + math.pi)
        for street in self.streets:
            if isinstance(street.a, str):
                street.ends = [moved(ends[street, False], -240.0), ends[street, False]]
            else:
                street.ends = [ends[street, True], ends[street, False]]
            street.plan = [piece for piece in biarc(*street.ends)]
            street.length = sum(piece[1] for piece in street.plan)
            street.heights = [height(*(self.points[c] if c in self.points else pose[:2])) for c, pose in zip((street.a, street.b), street.ends)]

    def height_of(self, at):
        return height(*self.points[at])

    def priority(self, at):
        """What orders a crossing: lights, roundabout, signs, or who comes from the right."""
        if at in LIGHTS:
            return "lights"
        if at in ROUNDABOUTS:
            return "roundabout"
        kinds = {arm.street.kind != "quiet" for arm in self.arms[at]}
        return "signs" if len(kinds) == 2 else "right"

    def is_minor(self, at, arm):
        return self.priority(at) == "signs" and arm.street.kind == "quiet"

    def has_stop(self, at):
        return (at[0] + at[1]) % 3 == 0
