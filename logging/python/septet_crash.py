"""Crashes of a Septet session: the records of its log, and the same figures reckoned anew from its snapshots.

    import septet_crash, septet_session
    with septet_session.open("out/session.sqlite") as session:
        septet_crash.crashes(session)      # one row a crash, the keys of FORMAT.md; NaN: not measured
        septet_crash.recomputed(session)   # one row a crash: the log's figure, the snapshots' figure, their difference

From the record `recomputed` takes what no snapshot tells: who met whom and when, the contact's place and normal, masses,
inertias and mass centres, and the pulse. All else is of the snapshots: the motion of both at the tick before the touch
and at the last push.
"""

import math

import numpy as np
import pandas

from septet_session import SessionError

RECORD_VERSION = 1
_WORDS = ("stands",)
_NEEDED = {"tick", "ticks", "point_x_m", "point_y_m", "point_z_m", "normal_rad", "closing_speed_mps"}
_OF_BODY = ("mass_kg", "yaw_inertia_kgm2", "mass_centre_ahead_m", "delta_v_x_mps", "delta_v_y_mps", "delta_yaw_rate_radps",
            "principal_direction_rad", "crush_m")
# What recomputed() holds against the snapshots.
_MEASURED = {"with", "kinetic_before_j", "kinetic_after_j", "crush_j", "friction_j"} | {f"{of}{key}" for of in ("", "its_") for key in _OF_BODY}
_LEAST_TURN_RADPS = 0.1  # Of less the snapshots' steps are too large a share.
_MOST_TICKS = 240  # engine/world/crash_record.hpp
_CORNER_M = 0.3  # engine/physics/impact/impact.toml: vehicles' corners in plan.


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
    """One of a record's two, as the snapshots of a span have it: a row a tick."""

    def __init__(self, record, of, rows, models):
        rows = rows.sort_values("tick")
        self.mass_kg, self.inertia_kgm2 = record[f"{of}mass_kg"], record[f"{of}yaw_inertia_kgm2"]
        ahead_m = record[f"{of}mass_centre_ahead_m"]
        heading = rows.heading_rad.to_numpy()
        self.forward = np.column_stack([np.cos(heading), np.sin(heading)])
        self.left = np.column_stack([-np.sin(heading), np.cos(heading)])
        self.yaw_rate = rows.angular_velocity_z_radps.to_numpy()
        origin_m = rows[["x_m", "y_m"]].to_numpy()
        self.velocity = rows[["velocity_x_mps", "velocity_y_mps"]].to_numpy() + self.yaw_rate[:, None] * ahead_m * self.left
        self.acceleration = rows[["acceleration_x_mps2", "acceleration_y_mps2"]].to_numpy()
        self.centre_m = origin_m + ahead_m * self.forward
        model = models[int(rows.model.iloc[0])]
        self.half_m = np.array([model["length_m"], model["width_m"]]) / 2.0
        middle_m = self.half_m[0] - model["rear_overhang_m"]
        self.middle_m = origin_m + middle_m * self.forward

    def kinetic_j(self, velocity, yaw_rate):
        return 0.5 * self.mass_kg * float(velocity @ velocity) + 0.5 * self.inertia_kgm2 * yaw_rate ** 2

    def reach_m(self, row, way):
        """How far the rounded outline reaches along `way` from its middle."""
        core = self.half_m - _CORNER_M
        return abs(self.forward[row] @ way) * core[0] + abs(self.left[row] @ way) * core[1] + _CORNER_M


def _surface(body, velocity, yaw_rate, arm_m):
    return velocity + yaw_rate * np.array([-arm_m[1], arm_m[0]])


def _of_snapshots(record, bodies, tick_s):
    """The figures of a record, reckoned from two bodies' motion: key to value. Row 0 is the tick before the touch."""
    normal = np.array([math.cos(record["normal_rad"]), math.sin(record["normal_rad"])])
    point_m = np.array([record["point_x_m"], record["point_y_m"]])
    # Until the touch they moved on as they did before it.
    before = [body.velocity[0] + tick_s * body.acceleration[0] for body in bodies]
    arms_m = [point_m - body.centre_m[0] - tick_s * body.velocity[0] for body in bodies]
    surfaces = [_surface(body, velocity, body.yaw_rate[0], arm_m) for body, velocity, arm_m in zip(bodies, before, arms_m)]
    figures = {"closing_speed_mps": float((surfaces[0] - surfaces[1]) @ normal)}
    for of, body, velocity in zip(("", "its_"), bodies, before):
        change = body.velocity[-1] - velocity
        figures[f"{of}delta_v_x_mps"], figures[f"{of}delta_v_y_mps"] = change
        figures[f"{of}delta_v_mps"] = float(np.hypot(*change))
        figures[f"{of}delta_yaw_rate_radps"] = float(body.yaw_rate[-1] - body.yaw_rate[0])
        figures[f"{of}principal_direction_rad"] = math.atan2(-change @ body.left[0], -change @ body.forward[0])
    figures["kinetic_before_j"] = sum(body.kinetic_j(velocity, body.yaw_rate[0]) for body, velocity in zip(bodies, before))
    figures["kinetic_after_j"] = sum(body.kinetic_j(body.velocity[-1], body.yaw_rate[-1]) for body in bodies)
    figures |= _of_surfaces(record, bodies, before, arms_m, normal, tick_s)
    return figures


def _of_surfaces(record, bodies, before, arms_m, normal, tick_s):
    """What follows from the surfaces' speed towards each other, tick by tick, the arms held as at the touch: the depth to which they came along
    the normal, and the work of the pulse along it and across it."""
    pulse = record.get("pulse_ns")
    if pulse is None or len(pulse) > len(bodies[0].velocity) - 1:
        return {}
    # Of convex outlines at their touch, the gap along the normal is the gap.
    depth_m = bodies[0].reach_m(0, normal) + bodies[1].reach_m(0, -normal) - (bodies[1].middle_m[0] - bodies[0].middle_m[0]) @ normal
    deepest_m, along_j, across_j = depth_m, 0.0, 0.0
    last = [(velocity, body.yaw_rate[0]) for velocity, body in zip(before, bodies)]
    tangent = np.array([-normal[1], normal[0]])
    for row, impulse in enumerate(pulse, start=1):
        now = [(body.velocity[row], body.yaw_rate[row]) for body in bodies]
        speeds = [[_surface(body, *motion, arm_m) for body, motion, arm_m in zip(bodies, motions, arms_m)] for motions in (last, now)]
        mean = 0.5 * (speeds[0][0] - speeds[0][1] + speeds[1][0] - speeds[1][1])
        along_j += float(impulse @ normal) * float(mean @ normal)
        across_j += float(impulse @ tangent) * float(mean @ tangent)
        depth_m += tick_s * float(mean @ normal)
        deepest_m = max(deepest_m, depth_m)
        last = now
    return {"depth_m": deepest_m, "crush_j": along_j, "friction_j": across_j}


def _told(record, key):
    if key in ("delta_v_mps", "its_delta_v_mps"):
        of = key.removesuffix("delta_v_mps")
        return math.hypot(record[f"{of}delta_v_x_mps"], record[f"{of}delta_v_y_mps"])
    if key == "depth_m":  # What both are crushed by, as far as it carries.
        return record["crush_m"] + record["its_crush_m"]
    return record[key]


def recomputed(session):
    """One row a crash of two whose motion was measured, and figure: `logged`, `recomputed`, `difference`, and `scale`, the size
    that a difference is to be held against (a component of a vector: the vector's)."""
    columns = ["tick", "first", "with", "figure", "logged", "recomputed", "difference", "scale"]
    known = [record for record in records(session) if _has(record, _MEASURED)]
    if not known:
        return pandas.DataFrame(columns=columns)
    spans = [range(int(record["tick"]) - 1, int(record["tick"] + record["ticks"]) + 1) for record in known]
    ticks = set().union(*spans)
    everybody = session.participants()
    taken = everybody[everybody.tick.isin(ticks)]
    models, rows = session.vehicle_models(), []
    tick_s = 1.0 / float(session.meta["ticks_per_second"])
    for record, span in zip(known, spans):
        here = taken[taken.tick.isin(span)]
        of_each = [here[here.participant == number] for number in (record["first"], record["with"])]
        if any(len(of_one) != len(span) for of_one in of_each):
            raise SessionError(f"{session.path}: the snapshots around the crash of tick {record['tick']:.0f} lack one of its two")
        bodies = [_Body(record, of, of_one, models) for of, of_one in zip(("", "its_"), of_each)]
        for key, value in _of_snapshots(record, bodies, tick_s).items():
            logged = _told(record, key)
            scale = abs(logged)
            if "delta_v_" in key:
                scale = _told(record, ("its_" if key.startswith("its_") else "") + "delta_v_mps")
            elif key.endswith("principal_direction_rad"):
                value, scale = logged + math.remainder(value - logged, 2.0 * math.pi), math.pi
            elif key.endswith("_j"):
                scale = record["kinetic_before_j"] - record["kinetic_after_j"]
            elif key.endswith("delta_yaw_rate_radps"):
                scale = max(abs(record["delta_yaw_rate_radps"]), abs(record["its_delta_yaw_rate_radps"]), _LEAST_TURN_RADPS)
            rows.append((int(record["tick"]), record["first"], int(record["with"]), key, logged, value, value - logged, scale))
    return pandas.DataFrame(rows, columns=columns)
