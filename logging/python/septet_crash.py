"""Crashes of a Septet session: the records of its log, and the same figures reckoned anew from its snapshots.

    import septet_crash, septet_session
    with septet_session.open("out/session.sqlite") as session:
        septet_crash.crashes(session)      # one row a crash, the keys of FORMAT.md; NaN: not measured
        septet_crash.recomputed(session)   # one row a figure of a crash: the log's, the snapshots', their difference

From the record `recomputed` takes what no snapshot tells: who met whom and when, the point at which the surfaces' speeds
are compared, masses, inertias and mass centres. All else is of the snapshots: outlines and motion of both at the tick
before the touch, and until that of the last push. Left out is what no snapshot holds: crush, which the law shares out by
stiffness and keeps where the outlines spring back; the work of crush and friction, debris and wheels, which tell apart
pushes within a tick; what stands beside the road; what a person or a two-wheeler took of a vehicle, whose wheels brake it
meanwhile: of such a crash the closing speed alone is reckoned. Where another crash still pushes one of the two at their touch, its
motion then is in no snapshot either, and of figures the depth alone is reckoned.
"""

import math

import numpy as np
import pandas

import septet_snapshot
from septet_session import SessionError

RECORD_VERSION = 1
_WORDS = ("stands",)
_NEEDED = {"tick", "ticks", "point_x_m", "point_y_m", "point_z_m", "normal_rad", "closing_speed_mps"}
# Of one whose motion was measured.
_OF_BODY = ("mass_kg", "yaw_inertia_kgm2", "mass_centre_ahead_m", "mass_centre_above_m", "delta_v_x_mps", "delta_v_y_mps", "delta_yaw_rate_radps")
_LEAST_TURN_RADPS = 0.1  # Of less the snapshots' steps are too large a share.
_MOST_TICKS = 240  # engine/world/crash_record.hpp
_CORNER_M = 0.3  # engine/physics/impact/impact.toml: vehicles' corners in plan.
_THROWN = ("pedestrian", "bicycle", "motorcycle")
_BOX_CORNER_M = 0.02  # engine/simulation/effects/body_box.cpp


def _number(text):
    try:
        value = float(text)
    except ValueError:
        return math.nan
    return value if abs(value) < 1e12 else math.nan


def _pulse(text):
    pairs = [pair.split(":") for pair in text.split(",")]
    return np.array([[_number(x) for x in pair] for pair in pairs if len(pair) == 2]).reshape(-1, 2)


def _record(participant, detail):
    """A record's keys, or None for what is none of this version."""
    # The name of a solid comes last, and may hold blanks.
    detail, _, name = detail.partition(' what="')
    words = dict(word.split("=", 1) for word in detail.split(" ") if "=" in word)
    if words.get("version") != str(RECORD_VERSION):
        return None
    record = {"first": participant}
    for key, text in words.items():
        if key == "pulse_ns":
            record[key] = _pulse(text)
        elif key in _WORDS:
            record[key] = text.replace("_", " ")
        elif key != "version":
            record[key] = _number(text)
    if name.endswith('"'):
        record["what"] = name[:-1]
    return record


def _has(record, keys):
    return all(math.isfinite(record.get(key, math.nan)) for key in keys)


def records(session):
    """All records, by the tick of their touch, as dictionaries; a key that is missing was not measured."""
    found = []
    events = session.events
    for participant, detail in events[events.kind == "crash"][["participant", "detail"]].itertuples(index=False):
        record = _record(int(participant), detail) if participant == participant and isinstance(detail, str) else None
        if record is not None and _has(record, _NEEDED) and record["tick"] >= 1 and 0 <= record["ticks"] < _MOST_TICKS:
            found.append(record)
    return sorted(found, key=lambda record: record["tick"])


def crashes(session):
    """One row a crash; `delta_v_mps` and `its_delta_v_mps` are lengths, beside their components."""
    frame = pandas.DataFrame([{key: value for key, value in record.items() if key != "pulse_ns"} for record in records(session)])
    for of in ("", "its_"):
        if f"{of}delta_v_x_mps" in frame:
            frame[f"{of}delta_v_mps"] = np.hypot(frame[f"{of}delta_v_x_mps"], frame[f"{of}delta_v_y_mps"])
    return frame


class _Body:
    """One of a record's two, as the snapshots have it: a row a tick, the first the tick before the touch.

    Its motion at the touch is that of this tick, carried on as it has changed since the tick before."""

    def __init__(self, record, of, rows, models):
        rows = rows.sort_values("tick")
        first = int((rows.tick < record["tick"]).sum()) - 1
        model = models[int(rows.model.iloc[0])]
        self.of, self.mass_kg, self.inertia_kgm2 = of, record.get(f"{of}mass_kg", math.nan), record.get(f"{of}yaw_inertia_kgm2", math.nan)
        origin_m = rows[["x_m", "y_m", "z_m"]].to_numpy()
        axes = _axes(rows[["qw", "qx", "qy", "qz"]].to_numpy())
        spin = rows[["angular_velocity_x_radps", "angular_velocity_y_radps", "angular_velocity_z_radps"]].to_numpy()
        arm_m = axes @ np.array([record[f"{of}mass_centre_ahead_m"], 0.0, record[f"{of}mass_centre_above_m"]])
        velocity = rows[["velocity_x_mps", "velocity_y_mps", "velocity_z_mps"]].to_numpy() + np.cross(spin, arm_m)
        motion = np.column_stack([velocity[:, :2], spin[:, 2]])
        before = 2.0 * motion[first] - motion[max(0, first - 1)]
        self.centre_m, self.velocity, self.yaw_rate = (origin_m + arm_m)[first:, :2], motion[first:, :2], motion[first:, 2]
        self.before, self.yaw_rate_before = before[:2], float(before[2])
        size_m, rear_m, corner_m = (model["length_m"], model["width_m"], model["height_m"]), model["rear_overhang_m"], _CORNER_M
        if model["name"] == septet_snapshot.BOX:
            size_m = septet_snapshot.box_sizes_m(rows.iloc[:1])[0]
            rear_m, corner_m = 0.5 * size_m[0], _BOX_CORNER_M
        half_m = np.array(size_m[:2]) / 2.0
        low_m = model.get("clearance_m", 0.2)
        to_middle_m = axes @ np.array([half_m[0] - rear_m, 0.0, 0.5 * (low_m + size_m[2])])
        forward = axes[:, :2, 0] / np.linalg.norm(axes[:, :2, 0], axis=1, keepdims=True)
        self.outlines = [_Outline(middle_m, ahead, half_m, corner_m)
                         for middle_m, ahead in zip((origin_m + to_middle_m)[first:, :2], forward[first:])]

    def moved(self, time_s):
        """Its outline so long after the first row."""
        turn_rad = time_s * self.yaw_rate_before
        cosine, sine = math.cos(turn_rad), math.sin(turn_rad)
        first, turn = self.outlines[0], np.array([[cosine, -sine], [sine, cosine]])
        centre_m = self.centre_m[0] + time_s * self.before
        return _Outline(centre_m + turn @ (first.middle_m - self.centre_m[0]), turn @ first.forward, first.half_m, first.round_m)

    def surface(self, point_m, tick_s):
        """Velocity of its surface there, at the touch."""
        arm_m = point_m - self.centre_m[0] - tick_s * self.before
        return self.before + self.yaw_rate_before * np.array([-arm_m[1], arm_m[0]])

    def kinetic_j(self, velocity, yaw_rate):
        return 0.5 * self.mass_kg * float(velocity @ velocity) + 0.5 * self.inertia_kgm2 * yaw_rate ** 2

    def kinetic_lost_j(self):
        return self.kinetic_j(self.before, self.yaw_rate_before) - self.kinetic_j(self.velocity[-1], self.yaw_rate[-1])


def _axes(quaternions):
    """A rotation matrix a row: forward, left and up in the world."""
    w, x, y, z = quaternions.T
    return np.stack([np.column_stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)]),
                     np.column_stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)]),
                     np.column_stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])], axis=1)


class _Outline:
    """A vehicle in plan: a rectangle with rounded corners."""

    def __init__(self, middle_m, forward, half_m, corner_m):
        self.middle_m, self.forward, self.half_m = middle_m, forward, half_m
        self.left = np.array([-forward[1], forward[0]])
        self.round_m = min(corner_m, *half_m)
        self.core_m = half_m - self.round_m

    def core_reach_m(self, way):
        """How far the middles of the corners reach along `way` from the outline's middle."""
        return abs(self.forward @ way) * self.core_m[0] + abs(self.left @ way) * self.core_m[1]

    def corners_m(self):
        return [self.middle_m + x * self.core_m[0] * self.forward + y * self.core_m[1] * self.left for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1))]

    def stretch_m(self, way):
        """Where the outline begins and ends along `way`."""
        reach_m = self.core_reach_m(way) + self.round_m
        return self.middle_m @ way - reach_m, self.middle_m @ way + reach_m


def _nearest(first, second):
    """The gap between two outlines, negative where they overlap, and its direction from the first to the second."""
    apart_m = second.middle_m - first.middle_m
    axes = [sign * axis for axis in (first.forward, first.left, second.forward, second.left) for sign in (1.0, -1.0)]
    gaps = [apart_m @ axis - first.core_reach_m(axis) - second.core_reach_m(axis) for axis in axes]
    widest = int(np.argmax(gaps))
    gap_m, normal = gaps[widest], axes[widest]
    if gap_m > 0.0:
        between = _between(first.corners_m(), second.corners_m())
        gap_m = float(np.linalg.norm(between))
        normal = between / gap_m
    return gap_m - first.round_m - second.round_m, normal


def _between(first, second):
    """Of two polygons apart, the way from the first's nearest point to the second's."""
    ways = [_to_edge(corner, second[i - 1], second[i]) for corner in first for i in range(len(second))]
    ways += [-_to_edge(corner, first[i - 1], first[i]) for corner in second for i in range(len(first))]
    return min(ways, key=lambda way: way @ way)


def _to_edge(point, begin, end):
    along = end - begin
    square = along @ along
    share = np.clip((point - begin) @ along / square, 0.0, 1.0) if square > 0.0 else 0.0
    return begin + share * along - point


def _touch_normal(first, second, tick_s):
    """Direction from the first to the second at the instant in the tick at which their outlines closed."""
    early_s, late_s = 0.0, tick_s
    if _nearest(first.moved(0.0), second.moved(0.0))[0] <= 0.0:
        early_s = tick_s
    for _ in range(40):
        middle_s = 0.5 * (early_s + late_s)
        if _nearest(first.moved(middle_s), second.moved(middle_s))[0] > 0.0:
            early_s = middle_s
        else:
            late_s = middle_s
    return _nearest(first.moved(late_s), second.moved(late_s))[1]


def _overlap_m(first, second, approach):
    """Width on which two outlines meet, seen along their approach, and that of the narrower one."""
    across = np.array([-approach[1], approach[0]]) / np.linalg.norm(approach)
    (own_from, own_to), (its_from, its_to) = first.stretch_m(across), second.stretch_m(across)
    narrower_m = min(own_to - own_from, its_to - its_from)
    return min(max(0.0, min(own_to - its_from, its_to - own_from)), narrower_m), narrower_m


def _of_motion(body, tick_s):
    """What a crash changed of one's motion."""
    change = body.velocity[-1] - body.before
    touching = body.moved(tick_s)
    figures = {"delta_v_x_mps": change[0], "delta_v_y_mps": change[1], "delta_v_mps": float(np.hypot(*change)),
               "delta_yaw_rate_radps": float(body.yaw_rate[-1] - body.yaw_rate_before),
               "principal_direction_rad": math.atan2(-change @ touching.left, -change @ touching.forward)}
    return {f"{body.of}{key}": value for key, value in figures.items()}


def _of_meeting(record, first, second, tick_s):
    """How two outlines met."""
    point_m = np.array([record["point_x_m"], record["point_y_m"]])
    normal = _touch_normal(first, second, tick_s)
    approach = first.surface(point_m, tick_s) - second.surface(point_m, tick_s)
    overlap_m, narrower_m = _overlap_m(first.moved(tick_s), second.moved(tick_s), approach)
    gaps = [_nearest(own, its)[0] for own, its in zip(first.outlines[1:], second.outlines[1:])]
    return {"normal_rad": math.atan2(normal[1], normal[0]), "closing_speed_mps": float(approach @ normal), "overlap_m": overlap_m,
            "overlap_share": overlap_m / narrower_m, "depth_m": max(0.0, *(-gap for gap in gaps))}


def _is_pushed_by_another(record, everyone):
    """True where another crash still pushes one of the two at their touch."""
    two = {record["first"], record.get("with", record["first"])}
    return any(other is not record and other["tick"] <= record["tick"] <= other["tick"] + other["ticks"] and
               two & {other["first"], other.get("with", other["first"])} for other in everyone)


def _of_throw(record, bodies, rows, tick_s):
    """Of a vehicle that meets a person or a two-wheeler, who moves as a whole until then."""
    before = rows[rows.tick < record["tick"]].sort_values("tick")
    if before.empty or len(bodies) != 1:
        return {}
    velocity = before[["velocity_x_mps", "velocity_y_mps"]].to_numpy()[-1]
    normal = np.array([math.cos(record["normal_rad"]), math.sin(record["normal_rad"])]) * (1.0 if bodies[0].of == "" else -1.0)
    point_m = np.array([record["point_x_m"], record["point_y_m"]])
    return {"closing_speed_mps": float((bodies[0].surface(point_m, tick_s) - velocity) @ normal)}


def _of_snapshots(record, bodies, tick_s):
    """The figures of a record that its bodies' snapshots tell."""
    figures = {}
    for body in bodies:
        figures |= _of_motion(body, tick_s)
    if len(bodies) == 2:
        figures |= _of_meeting(record, *bodies, tick_s)
    elif "stands" in record:
        normal = np.array([math.cos(record["normal_rad"]), math.sin(record["normal_rad"])])
        figures["closing_speed_mps"] = float(bodies[0].surface(np.array([record["point_x_m"], record["point_y_m"]]), tick_s) @ normal)
    figures["kinetic_lost_j"] = sum(body.kinetic_lost_j() for body in bodies)
    return figures


def _told(record, key):
    if key in ("delta_v_mps", "its_delta_v_mps"):
        of = key.removesuffix("delta_v_mps")
        return math.hypot(record[f"{of}delta_v_x_mps"], record[f"{of}delta_v_y_mps"])
    if key == "kinetic_lost_j":
        return record.get("kinetic_before_j", math.nan) - record.get("kinetic_after_j", math.nan)
    return record.get(key, math.nan)


def _scale(record, key, logged):
    """What a difference is to be held against: of a component its vector, of a direction one radian, of turns 0.1 rad/s at least."""
    if key.endswith("_rad"):
        return 1.0
    if "delta_v_" in key:
        return _told(record, ("its_" if key.startswith("its_") else "") + "delta_v_mps")
    if key.endswith("delta_yaw_rate_radps"):
        turns = (record.get("delta_yaw_rate_radps", 0.0), record.get("its_delta_yaw_rate_radps", 0.0))
        return max(*map(abs, turns), _LEAST_TURN_RADPS)
    return abs(logged)


def _measured_sides(record):
    """Of the two those whose motion was measured, with the beginning of their keys."""
    sides = ((record["first"], ""), (record.get("with", math.nan), "its_"))
    return [(int(number), of) for number, of in sides if _has({**record, "number": number}, {"number", *(f"{of}{key}" for key in _OF_BODY)})]


def recomputed(session):
    """One row a crash and figure, of those whose motion was measured: `logged`, `recomputed`, `difference`, and `scale`, the size
    that a difference is to be held against."""
    columns = ["tick", "first", "with", "figure", "logged", "recomputed", "difference", "scale"]
    everyone = records(session)
    known = [(record, sides) for record in everyone if (sides := _measured_sides(record))]
    if not known:
        return pandas.DataFrame(columns=columns)
    spans = [range(max(0, int(record["tick"]) - 2), int(record["tick"] + record["ticks"]) + 1) for record, _ in known]
    everybody = session.participants()
    taken = everybody[everybody.tick.isin(set().union(*spans))]
    models, rows = session.vehicle_models(), []
    tick_s = 1.0 / float(session.meta["ticks_per_second"])
    for (record, sides), span in zip(known, spans):
        here = taken[taken.tick.isin(span)]
        of_each = [here[here.participant == number] for number, _ in sides]
        if any(set(range(int(record["tick"]) - 1, span.stop)) - set(of_one.tick) for of_one in of_each):
            raise SessionError(f"{session.path}: the snapshots around the crash of tick {record['tick']:.0f} lack one of its two")
        try:
            bodies = [_Body(record, of, of_one, models) for (_, of), of_one in zip(sides, of_each)]
        except (IndexError, KeyError, TypeError):
            raise SessionError(f"{session.path}: its vehicle_models are not what Septet writes: use an unaltered session") from None
        thrown = [one for number in (record["first"], record.get("with", math.nan))
                  if not (one := here[here.participant == number]).empty and models[int(one.model.iloc[0])].get("kind") in _THROWN]
        depends_on_others = _is_pushed_by_another(record, everyone)
        figures = _of_snapshots(record, bodies, tick_s) if not thrown else _of_throw(record, bodies, thrown[0], tick_s)
        for key, value in figures.items():
            logged = _told(record, key)
            if not math.isfinite(logged) or (depends_on_others and key != "depth_m"):
                continue
            if key.endswith("_rad"):
                value = logged + math.remainder(value - logged, 2.0 * math.pi)
            rows.append((int(record["tick"]), record["first"], record.get("with", math.nan), key, logged, value, value - logged,
                         _scale(record, key, logged)))
    return pandas.DataFrame(rows, columns=columns)
