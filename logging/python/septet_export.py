"""Writes Septet sessions for other programs: tables as CSV, JSON or Parquet with their units, and all participants' motion as an ASAM OSI trace.

    python3 septet_export.py tables out/session.sqlite --as parquet --out tables
    python3 septet_export.py osi out/session.sqlite --out drive.mcap

Tables need pandas; Parquet needs pyarrow, the OSI trace osi-python, mcap and mcap-protobuf-support (all from PyPI). logging/python/README.md.
"""

import argparse
import json
import math
import os
import sys
from pathlib import Path

import numpy as np
import pandas

import septet_session
import septet_snapshot
from septet_session import SessionError

# Unit by the end of a column's name, longest first; UCUM's symbols.
_UNITS = (("mm_per_h", "mm/h"), ("radps", "rad/s"), ("mps2", "m/s2"), ("mps", "m/s"), ("lux", "lx"), ("rad", "rad"), ("deg", "deg"),
          ("nm", "N.m"), ("m", "m"), ("s", "s"), ("k", "K"), ("percent", "%"))
# Counts and shares have the unit one; texts, names and numeric identities have none.
_IDENTITIES = {"tick", "participant", "model", "paint", "lamps", "road", "lane", "leader", "gear", "selector", "indicator", "id", "sequence",
               "order", "end", "level"}


def unit_of(column, series):
    """The unit of a column in UCUM's symbols: "1" for shares and counts, empty for text and identities."""
    for ending, unit in _UNITS:
        if column == ending or column.endswith("_" + ending):
            return unit
    if column in _IDENTITIES or not pandas.api.types.is_numeric_dtype(series):
        return ""
    return "1"


def tables_of(session, every=12):
    """All tables of a session, by name. `every`: interval in ticks of the participants' motion."""
    tables = {"samples": session.samples, "events": session.events, "driver_inputs": session.driver_inputs,
              "questionnaire": session.questionnaire, "meta": pandas.DataFrame(session.meta.items(), columns=["key", "value"])}
    if session.has_snapshots:
        tables |= session.motion_tables(every)
    return tables


def columns_of(frame):
    return [{"name": name, "unit": unit_of(name, frame[name])} for name in frame.columns]


def _plain(value):
    """A cell in JSON's form; NaN and infinite numbers are null."""
    if isinstance(value, (np.integer, np.bool_)):
        return value.item()
    if isinstance(value, (float, np.floating)):
        return float(value) if math.isfinite(value) else None
    return value


def _write_csv(frame, path, about):
    frame.to_csv(path, index=False, float_format="%.17g")
    description = {"@context": "http://www.w3.org/ns/csvw", "url": path.name, "septet": about,
                   "tableSchema": {"columns": [{"name": c["name"], "septet:unit": c["unit"]} for c in columns_of(frame)]}}
    path.with_name(path.name + "-metadata.json").write_text(json.dumps(description, indent=2) + "\n")


def _write_json(frame, path, about):
    rows = [[_plain(value) for value in row] for row in frame.itertuples(index=False, name=None)]
    path.write_text(json.dumps({"about": about, "columns": columns_of(frame), "rows": rows}, allow_nan=False) + "\n")


def _write_parquet(frame, path, about):
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise SessionError("Parquet needs pyarrow: install it from PyPI (pip install pyarrow), or take --as csv or json") from error
    table = pyarrow.Table.from_pandas(frame, preserve_index=False)
    fields = [field.with_metadata({"unit": unit_of(field.name, frame[field.name])}) for field in table.schema]
    metadata = {b"septet": json.dumps(about).encode(), **(table.schema.metadata or {})}
    pyarrow.parquet.write_table(table.cast(pyarrow.schema(fields, metadata=metadata)), path)


_WRITERS = {"csv": _write_csv, "json": _write_json, "parquet": _write_parquet}


def _whole(path, write):
    """Writes beside it first, so that a file of that name is whole or not there."""
    draft = path.with_name(f".{os.getpid()}.{path.name}")
    try:
        write(draft)
        os.replace(draft, path)
    finally:
        draft.unlink(missing_ok=True)


def write_tables(session, folder, form="csv", every=12):
    """One file a table in the folder; the units are beside a CSV file, within a JSON or Parquet one (the fields' metadata)."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    meta = session.meta
    about = {"session": str(session.path), **{key: meta.get(key, "") for key in ("participant", "condition", "started_utc", "septet_version")}}
    written = []
    for name, frame in tables_of(session, every).items():
        path = folder / f"{name}.{form}"
        if form == "csv":
            _write_csv(frame, path, about)
        else:
            _whole(path, lambda draft, table=frame: _WRITERS[form](table, draft, about))
        written.append(path)
    return written


# --- ASAM OSI
# ---------------------------------------------------------------------------------------------------------------------------

_VEHICLE_TYPES = {"car": "TYPE_MEDIUM_CAR", "van": "TYPE_DELIVERY_VAN", "ambulance": "TYPE_DELIVERY_VAN", "lorry": "TYPE_HEAVY_TRUCK",
                  "bus": "TYPE_BUS", "motorcycle": "TYPE_MOTORBIKE", "bicycle": "TYPE_BICYCLE"}


def _osi():
    try:
        import google.protobuf
        import osi3.osi_groundtruth_pb2 as ground_truth
        import osi3.osi_object_pb2 as objects
        import osi3.osi_version_pb2 as versions
        from mcap.writer import Writer
        from mcap_protobuf.schema import build_file_descriptor_set
    except ImportError as error:
        raise SessionError(f"an OSI trace needs osi-python, mcap and mcap-protobuf-support ({error}): install them from PyPI "
                           "(pip install osi-python mcap mcap-protobuf-support)") from error
    version = versions.DESCRIPTOR.GetOptions().Extensions[versions.current_interface_version]
    return google.protobuf, ground_truth, objects, version, Writer, build_file_descriptor_set


def _set(vector, x, y, z):
    vector.x, vector.y, vector.z = x, y, z


def _turned(quaternions, vectors):
    """Vectors of the vehicles' frames in the world's; rows of w, x, y, z and of x, y, z."""
    w, axis = quaternions[:, :1], quaternions[:, 1:]
    twice = 2.0 * np.cross(axis, vectors)
    return vectors + w * twice + np.cross(axis, twice)


class _GroundTruths:
    """From snapshots to osi3.GroundTruth: positions are of the middle of the bounding box, as OSI has them."""

    def __init__(self, session):
        _, self._messages, self._objects, self._version, _, _ = _osi()
        self._models = session.vehicle_models()
        boxes = [(0.5 * m["length_m"] - m["rear_overhang_m"], 0.0, 0.5 * m["height_m"]) for m in self._models]
        self._middles = np.array(boxes)
        self._sizes = np.array([(m["length_m"], m["width_m"], m["height_m"]) for m in self._models])
        self._is_box = np.array([m["name"] == septet_snapshot.BOX for m in self._models])
        moving = self._objects.MovingObject
        self._kinds = []
        for model in self._models:
            kind, type_name = model["kind"], _VEHICLE_TYPES.get(model["kind"])
            if type_name:
                self._kinds.append((moving.TYPE_VEHICLE, moving.VehicleClassification.Type.Value(type_name)))
            else:
                self._kinds.append((moving.TYPE_PEDESTRIAN if kind == "pedestrian" else moving.TYPE_OTHER, None))

    def of(self, snapshot):
        message = self._messages.GroundTruth()
        message.version.CopyFrom(self._version)
        nanos = round(snapshot.time_s * 1e9)
        message.timestamp.seconds, message.timestamp.nanos = divmod(nanos, 10**9)
        message.host_vehicle_id.value = snapshot.car[0]
        self._add_weather(message.environmental_conditions, snapshot.environment)
        frame = septet_session.motion_of(snapshot.fields)
        place = frame["model"]
        if len(place) and int(place.max()) >= len(self._models):
            raise SessionError(f"tick {snapshot.tick} has a vehicle of model {int(place.max())}, and the session knows {len(self._models)}")
        quaternions = np.column_stack([frame[c] for c in ("qw", "qx", "qy", "qz")])
        columns = {name: np.column_stack([frame[f"{name}{axis}{unit}"] for axis in "xyz"])
                   for name, unit in (("", "_m"), ("velocity_", "_mps"), ("acceleration_", "_mps2"), ("angular_velocity_", "_radps"))}
        spin = columns["angular_velocity_"]
        sizes, middles, boxes = self._sizes[place], self._middles[place], self._is_box[place]
        if boxes.any():
            sizes[boxes] = septet_snapshot.box_sizes_m(frame)[boxes]
            middles[boxes] = 0.5 * sizes[boxes] * (0.0, 0.0, 1.0)
        to_middle = _turned(quaternions, middles)
        round_it = np.cross(spin, to_middle)
        positions = columns[""] + to_middle
        velocities = columns["velocity_"] + round_it
        accelerations = columns["acceleration_"] + np.cross(spin, round_it)  # The angular acceleration is not logged.
        for row, number in enumerate(snapshot.ids.tolist()):
            self._add(message.moving_object.add(), number, place[row], sizes[row], positions[row], velocities[row], accelerations[row], spin[row],
                      quaternions[row], int(frame["lamps"][row]))
        return message

    def _add(self, moving, number, model_index, size, position, velocity, acceleration, spin, quaternion, lamps):
        model = self._models[model_index]
        moving.id.value = number
        base = moving.base
        base.dimension.length, base.dimension.width, base.dimension.height = size
        _set(base.position, *position)
        _set(base.velocity, *velocity)
        _set(base.acceleration, *acceleration)
        w, x, y, z = quaternion
        base.orientation.roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
        base.orientation.pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * y - z * x))))
        base.orientation.yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        # Rates of roll, pitch and yaw from the angular velocity (intrinsic z, y, x); undefined at 90 degrees of pitch.
        pitch, yaw = base.orientation.pitch, base.orientation.yaw
        along = spin[0] * math.cos(yaw) + spin[1] * math.sin(yaw)
        across = -spin[0] * math.sin(yaw) + spin[1] * math.cos(yaw)
        if abs(pitch) < 1.5:
            base.orientation_rate.roll = along / math.cos(pitch)
            base.orientation_rate.pitch = across
            base.orientation_rate.yaw = spin[2] + along * math.tan(pitch)
        moving.type, vehicle = self._kinds[model_index]
        if vehicle is None:
            return
        middle = self._middles[model_index]
        attributes = moving.vehicle_attributes
        _set(attributes.bbcenter_to_rear, -middle[0], 0.0, model["wheel_radius_m"] - middle[2])
        _set(attributes.bbcenter_to_front, model["wheelbase_m"] - middle[0], 0.0, model["wheel_radius_m"] - middle[2])
        attributes.radius_wheel = model["wheel_radius_m"]
        attributes.number_wheels = 2 if model["kind"] in ("motorcycle", "bicycle") else 4
        self._classify(moving.vehicle_classification, vehicle, model["kind"], lamps)

    def _classify(self, classification, vehicle, kind, lamps):
        kinds = self._objects.MovingObject.VehicleClassification
        classification.type = vehicle
        classification.role = kinds.ROLE_AMBULANCE if kind == "ambulance" else kinds.ROLE_CIVIL
        on = {name for bit, name in enumerate(septet_session.LAMPS) if lamps >> bit & 1}
        state, light = classification.light_state, kinds.LightState

        def generic(name):
            return light.GENERIC_LIGHT_STATE_ON if name in on else light.GENERIC_LIGHT_STATE_OFF

        left, right = "indicator_left" in on, "indicator_right" in on
        state.indicator_state = (light.INDICATOR_STATE_WARNING if left and right else light.INDICATOR_STATE_LEFT if left else
                                 light.INDICATOR_STATE_RIGHT if right else light.INDICATOR_STATE_OFF)
        state.brake_light_state = light.BRAKE_LIGHT_STATE_NORMAL if "brake" in on else light.BRAKE_LIGHT_STATE_OFF
        state.head_light, state.high_beam = generic("low_beam"), generic("high_beam")
        state.reversing_light, state.rear_fog_light = generic("reverse"), generic("rear_fog")
        if kind == "ambulance":
            state.emergency_vehicle_illumination = generic("beacon")

    @staticmethod
    def _add_weather(conditions, values):
        weather = dict(zip(septet_session.ENVIRONMENT, values))
        conditions.temperature = weather["temperature_k"]
        conditions.sun.azimuth, conditions.sun.elevation = weather["sun_azimuth_rad"], weather["sun_elevation_rad"]


def write_osi(session, path, every=1):
    """A MCAP file with one osi3.GroundTruth each `every`-th tick; returns how many."""
    protobuf, messages, _, version, writer_class, build_file_descriptor_set = _osi()
    osi_version = f"{version.version_major}.{version.version_minor}.{version.version_patch}"
    meta = session.meta
    count = 0

    def write(draft):
        nonlocal count
        with open(draft, "wb") as stream:
            writer = writer_class(stream)
            writer.start(profile="", library=f"septet {meta.get('septet_version', '')}")
            writer.add_metadata("net.asam.osi.trace", {
                "version": osi_version, "min_osi_version": osi_version, "max_osi_version": osi_version,
                "min_protobuf_version": protobuf.__version__, "max_protobuf_version": protobuf.__version__,
                "creation_time": meta.get("started_utc", ""), "zero_time": meta.get("started_utc", ""),
                "description": f"Septet session {session.path.name}, participant {meta.get('participant', '')}: everybody, each {every}. tick",
                "data_sources": "septet"})
            ground_truth = messages.GroundTruth
            schema = writer.register_schema(name=ground_truth.DESCRIPTOR.full_name, encoding="protobuf",
                                            data=build_file_descriptor_set(ground_truth).SerializeToString())
            channel = writer.register_channel(topic="ground_truth", message_encoding="protobuf", schema_id=schema, metadata={
                "net.asam.osi.trace.channel.osi_version": osi_version,
                "net.asam.osi.trace.channel.protobuf_version": protobuf.__version__,
                "net.asam.osi.trace.channel.description": "all participants in the world's frame: x east, y north, z up"})
            truths = _GroundTruths(session)
            for snapshot in session.snapshots():
                if snapshot.tick % every:
                    continue
                time_ns = round(snapshot.time_s * 1e9)
                writer.add_message(channel, log_time=time_ns, publish_time=time_ns, sequence=count,
                                   data=truths.of(snapshot).SerializeToString())
                count += 1
            writer.finish()

    _whole(Path(path), write)
    return count


def _positive(text):
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("give a whole number of ticks, at least 1")
    return value


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    tables = commands.add_parser("tables", help="every table of the session as a file with units")
    tables.add_argument("--as", dest="form", choices=sorted(_WRITERS), default="csv")
    tables.add_argument("--every", type=_positive, default=12, help="interval in ticks of the participants' motion (12: ten times a second)")
    osi = commands.add_parser("osi", help="all participants at every tick as osi3.GroundTruth in a MCAP file")
    osi.add_argument("--every", type=_positive, default=1, help="interval in ticks of the ground truths (1: every tick)")
    for command, what in ((tables, "folder for the files"), (osi, "the .mcap file")):
        command.add_argument("session", help="session.sqlite of a drive")
        command.add_argument("--out", required=True, type=Path, help=what)
    options = parser.parse_args(arguments)
    try:
        with septet_session.open(options.session) as session:
            if options.command == "tables":
                for path in write_tables(session, options.out, options.form, options.every):
                    print(path)
            else:
                print(f"{options.out}: {write_osi(session, options.out, options.every)} ground truths")
    except (SessionError, OSError) as error:
        what = f"{options.out}: {error.strerror}" if isinstance(error, OSError) and error.strerror else error
        print(f"septet_export: {what}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
