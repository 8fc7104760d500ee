"""The snapshots of a Septet session file: from a row's bytes to all participants' motion (engine/world/SNAPSHOT.md, logging/FORMAT.md).

Those who want a session open it with septet_session.
"""

import math
import struct
import zlib

import numpy as np

SNAPSHOT_VERSION = 2
PACKED_VERSION = 3

LAMPS = ("brake", "reverse", "indicator_left", "indicator_right", "low_beam", "high_beam", "rear_fog", "beacon", "siren", "horn")

ENVIRONMENT = ("sun_azimuth_rad", "sun_elevation_rad", "sun_illuminance_lux", "visibility_m", "cloud_cover", "rain_mm_per_h",
                "road_wetness", "snow_cover", "temperature_k", "wind_speed_mps", "wind_direction_rad")
DRIVER_CAR = ("speed_mps", "engine_radps", "steering_wheel_rad", "steering_torque_nm", "accelerator", "brake", "clutch",
              "yaw_rate_radps", "gaze_heading_rad", "road_s_m", "lateral_position_m", "lane_width_m")
DIAGNOSTICS = ("bad_numbers", "collisions", "input_stale_ticks")

# A participant's integers in the order of SNAPSHOT.md, and the value of one step of each.
_SPIN_STEPS = 1 << 16
_UNIT_OF_FIELD = [
    ("model", 1), ("paint", 1), ("lamps", 1), ("x_m", 1 / 4096), ("y_m", 1 / 4096), ("z_m", 1 / 4096),
    ("orientation", 1), ("orientation", 1), ("orientation", 1), ("orientation", 1),
    ("velocity_x_mps", 1 / 1024), ("velocity_y_mps", 1 / 1024), ("velocity_z_mps", 1 / 1024),
    ("acceleration_x_mps2", 1 / 256), ("acceleration_y_mps2", 1 / 256), ("acceleration_z_mps2", 1 / 256),
    ("angular_velocity_x_radps", 1 / 16384), ("angular_velocity_y_radps", 1 / 16384), ("angular_velocity_z_radps", 1 / 16384),
    ("front_steer_rad", 1 / 16384), ("wheel_spin_rad", 2.0 * math.pi / _SPIN_STEPS), ("wheel_spin_radps", 1 / 64),
    ("lift_front_left_m", 1 / 4096), ("lift_front_right_m", 1 / 4096), ("lift_rear_left_m", 1 / 4096), ("lift_rear_right_m", 1 / 4096)]
FIELDS, _UNITS = zip(*_UNIT_OF_FIELD)
BOX = "box"  # Of vehicle_models: each participant of this one has a size of its own.
_POSITION, _VELOCITY, _ACCELERATION = slice(3, 6), slice(10, 13), slice(13, 16)
_LARGEST, _SMALLEST = 6, slice(7, 10)
_WHEEL_SPIN, _WHEEL_SPIN_RATE = 20, 21
_ORIENTATION_STEPS = float((1 << 19) - 1)
_POSITION_LIMIT = 524288 * 4096 - 1
_VELOCITY_LIMIT = 1024 * 1024


def box_sizes_m(participants):
    """Length, width and height, a row a participant, of those that are boxes. They are told as binary logarithms where a vehicle's wheel lifts
    are (engine/world/SNAPSHOT.md)."""
    return np.exp2(np.column_stack([participants[f"lift_{of}_m"] for of in ("front_left", "front_right", "rear_left")]))


class SessionError(Exception):
    """A file's fault, its place, and the remedy."""


class _Bytes:
    """Walks through the bytes of one snapshot."""

    def __init__(self, data):
        self.data = data
        self.at = 0

    def u8(self):
        self.at += 1
        return self.data[self.at - 1]

    def doubles(self, count):
        values = struct.unpack_from(f"<{count}d", self.data, self.at)
        self.at += 8 * count
        return values

    def u64(self):
        (value,) = struct.unpack_from("<Q", self.data, self.at)
        self.at += 8
        return value

    def varint(self):
        value = shift = 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            value |= (byte & 0x7F) << shift
            if byte < 0x80:
                return value
            shift += 7
            if shift > 63:
                raise SessionError("a number of more than 64 bits")

    def signed(self):
        value = self.varint()
        return (value >> 1) ^ -(value & 1)

    def ids(self, count):
        """Ascending ids, each read when it is asked for: the first one, then the gaps less one."""
        next_id = 0
        for _ in range(count):
            next_id += self.varint()
            yield next_id
            next_id += 1


class Snapshot:
    """One tick as it lies in the file: `fields` has a row of integers for each participant of `ids`, ascending."""

    __slots__ = ("tick", "time_s", "state_hash", "environment", "car", "game", "head", "ids", "fields", "went_wrong")


def _rounded(values):
    return np.trunc(values + np.copysign(0.49999999999999994, values)).astype(np.int64)


def _moved_on(fields, seconds):
    """Predicted participants some time later: the reference of differences (SNAPSHOT.md)."""
    moved = fields.copy()
    velocity = fields[:, _VELOCITY].astype(float)
    acceleration = fields[:, _ACCELERATION].astype(float)
    step = velocity * seconds * 4.0 + acceleration * (0.5 * seconds * seconds) * 16.0
    moved[:, _POSITION] = (moved[:, _POSITION] + _rounded(step)).clip(-_POSITION_LIMIT, _POSITION_LIMIT)
    moved[:, _VELOCITY] = (moved[:, _VELOCITY] + _rounded(acceleration * seconds * 4.0)).clip(-_VELOCITY_LIMIT, _VELOCITY_LIMIT)
    turned = _rounded(fields[:, _WHEEL_SPIN_RATE] / 64.0 * seconds / (2.0 * math.pi) * _SPIN_STEPS)
    moved[:, _WHEEL_SPIN] = (moved[:, _WHEEL_SPIN] + turned) & (_SPIN_STEPS - 1)
    return moved


def _decode(data, baseline):
    """The snapshot in `data`, a difference to `baseline` where it names one."""
    read = _Bytes(data)
    version, flags = read.u8(), read.u8()
    if version != SNAPSHOT_VERSION or flags & ~15:
        raise SessionError(f"snapshot of version {version}, flags {flags}: this reader knows version {SNAPSHOT_VERSION}")
    snapshot = Snapshot()
    snapshot.tick = read.varint()
    if flags & 1:
        age = read.varint()
        if baseline is None or baseline.tick != snapshot.tick - age:
            raise SessionError(f"tick {snapshot.tick} is a difference to a tick that is not at hand")
    else:
        baseline = None
    (snapshot.time_s,) = read.doubles(1)
    snapshot.state_hash = read.u64()
    snapshot.environment = read.doubles(len(ENVIRONMENT)) if flags & 2 else baseline.environment
    ids = (read.varint(), read.signed(), read.varint(), read.signed())
    snapshot.car = ids + read.doubles(len(DRIVER_CAR)) + tuple(read.varint() for _ in DIAGNOSTICS)
    snapshot.game = (read.varint(), read.u8(), *read.doubles(4)) if flags & 4 else None
    snapshot.head = read.doubles(4) if flags & 8 else (0.0, 0.0, 0.0, 0.0)

    ids, fields = np.empty(0, np.int64), np.empty((0, len(FIELDS)), np.int64)
    if baseline is not None:
        ids, fields = baseline.ids, _moved_on(baseline.fields, min(max(snapshot.time_s - baseline.time_s, 0.0), 1.0))
    removed = list(read.ids(read.varint()))
    if removed:
        kept = ~np.isin(ids, removed)
        ids, fields = ids[kept], fields[kept]
    row_of = {number: row for row, number in enumerate(ids.tolist())}
    added = {}
    for number in read.ids(read.varint()):
        row = row_of.get(number)
        target = fields[row] if row is not None else added.setdefault(number, np.zeros(len(FIELDS), np.int64))
        mask = read.varint()
        while mask:
            low = mask & -mask
            target[low.bit_length() - 1] += read.signed()
            mask ^= low
    if added:
        ids = np.concatenate([ids, np.fromiter(added, np.int64)])
        fields = np.concatenate([fields, np.array(list(added.values()))])
        order = np.argsort(ids)
        ids, fields = ids[order], fields[order]
    snapshot.ids, snapshot.fields = ids, fields
    return snapshot


# Position, and which component of the orientation is the largest, and the others: they go on going wrong as they did
# (FORMAT.md).
_LASTING = slice(3, 10)
_LASTING_HIGH = np.array([_POSITION_LIMIT] * 3 + [3] + [int(_ORIENTATION_STEPS)] * 3)
_LASTING_LOW = np.array([-_POSITION_LIMIT] * 3 + [0] + [-int(_ORIENTATION_STEPS)] * 3)
_ESCAPE = 255


def unpack(data, baseline):
    """The snapshot in the bytes of a row: packed, or as formats before 2 kept them."""
    if data[0] != PACKED_VERSION:
        return _decode(data, baseline)
    read = _Bytes(data)
    read.u8()
    size = read.varint()
    snapshot = _decode(data[read.at:read.at + size], baseline)
    read.at += size
    moved_on = dict(zip(snapshot.ids.tolist(), snapshot.fields))
    kind = read.u8()
    if kind > 1:
        raise SessionError(f"participants told in way {kind}: this reader knows 0 and 1")
    ids = list(read.ids(read.varint())) if kind == 1 else snapshot.ids.tolist()
    size = read.varint()
    went_wrong = baseline.went_wrong if baseline is not None else {}
    cells = len(ids) * len(FIELDS)
    if not cells <= size <= 11 * cells:  # A byte each, and those that are large ten more.
        raise SessionError(f"{size} bytes of columns for {len(ids)} participants")
    columns = zlib.decompressobj(wbits=-15).decompress(data[read.at:], max_length=size) if ids else b""
    differences = np.frombuffer(columns, np.uint8, cells).astype(np.int64)
    escapes = _Bytes(columns[cells:])
    for cell in np.flatnonzero(differences == _ESCAPE):
        differences[cell] += escapes.varint()
    differences = ((differences >> 1) ^ -(differences & 1)).reshape(len(FIELDS), len(ids)).T
    fields = np.zeros((len(ids), len(FIELDS)), np.int64)
    snapshot.went_wrong = {}
    for row, number in enumerate(ids):
        if number not in moved_on:
            continue
        fields[row] = moved_on[number]
        if number in went_wrong:
            fields[row, _LASTING] = (fields[row, _LASTING] + went_wrong[number]).clip(_LASTING_LOW, _LASTING_HIGH)
    fields += differences
    for row, number in enumerate(ids):
        if number in moved_on:
            error = fields[row, _LASTING] - moved_on[number][_LASTING]
            if error[3] != 0:
                error[3:] = 0
            snapshot.went_wrong[number] = error
    snapshot.ids, snapshot.fields = np.array(ids, np.int64), fields
    return snapshot


def _orientations(fields):
    """Unit quaternions w, x, y, z: three components travel, the largest follows from them."""
    small = fields[:, _SMALLEST] / (_ORIENTATION_STEPS * math.sqrt(2.0))
    rows, largest = np.arange(len(fields)), fields[:, _LARGEST]
    quaternions = np.empty((len(fields), 4))
    others = np.arange(4)[None, :] != largest[:, None]
    quaternions[others] = small.reshape(-1)
    quaternions[rows, largest] = np.sqrt(np.maximum(0.0, 1.0 - (small * small).sum(axis=1)))
    return quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)


def motion_of(fields):
    """Motion of all participants, column to array: a row for each of `fields`, as in a Snapshot."""
    w, x, y, z = _orientations(fields).T
    frame = {}
    for index, name in enumerate(FIELDS):
        if name == "orientation":
            if index == _LARGEST:
                frame |= {"qw": w, "qx": x, "qy": y, "qz": z,
                          "heading_rad": np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))}
        else:
            frame[name] = fields[:, index] if index < _POSITION.start else fields[:, index] * _UNITS[index]
    return frame
