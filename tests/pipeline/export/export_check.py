"""export_check.py SEPTET FORM...: drives for a moment, exports the session in each form, and reads that back with other people's programs.

Exit status 77 where a form's packages are not installed.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "logging" / "python"))
try:
    import pandas
    if "parquet" in sys.argv:
        import pyarrow.parquet
    if "osi" in sys.argv:
        import osi3trace.osi_trace
        import mcap_protobuf  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}; .ci/install-checkers installs it from PyPI")
    sys.exit(77)
import numpy as np  # noqa: E402
import septet_export  # noqa: E402
import septet_session  # noqa: E402

EVERY = 12
UNITS = {"samples": {"speed_mps": "m/s", "x_m": "m", "heading_rad": "rad", "accelerator": "1", "tick": "", "lane": ""},
         "participants": {"velocity_x_mps": "m/s", "acceleration_y_mps2": "m/s2", "angular_velocity_z_radps": "rad/s", "qw": "1", "model": ""},
         "driver_car": {"steering_torque_nm": "N.m", "simulated_time_s": "s"},
         "environment": {"rain_mm_per_h": "mm/h", "temperature_k": "K", "sun_illuminance_lux": "lx"}, "who": {"name": "", "length_m": "m"}}


def run(session, *arguments):
    assert septet_export.main([arguments[0], str(session), *map(str, arguments[1:])]) == 0


def same(read, expected, name):
    assert list(read.columns) == list(expected.columns) and len(read) == len(expected), name
    for column in expected.columns:
        if pandas.api.types.is_numeric_dtype(expected[column]) and expected[column].notna().any():
            assert np.array_equal(pandas.to_numeric(read[column]).to_numpy(float), expected[column].to_numpy(float), equal_nan=True), (name, column)


def check_tables(session, folder, form):
    run(session, "tables", "--as", form, "--every", EVERY, "--out", folder)
    with septet_session.open(session) as opened:
        expected = septet_export.tables_of(opened, EVERY)
    for name, frame in expected.items():
        path = folder / f"{name}.{form}"
        if form == "csv":
            read = pandas.read_csv(path, float_precision="round_trip")
            columns = json.loads(path.with_name(path.name + "-metadata.json").read_text())["tableSchema"]["columns"]
            units = {c["name"]: c["septet:unit"] for c in columns}
        elif form == "json":
            content = json.loads(path.read_text())
            units = {c["name"]: c["unit"] for c in content["columns"]}
            read = pandas.DataFrame(content["rows"], columns=list(units))
        else:
            table = pyarrow.parquet.read_table(path)
            units = {field.name: field.metadata[b"unit"].decode() for field in table.schema}
            assert json.loads(table.schema.metadata[b"septet"])["participant"] == "P07"
            read = table.to_pandas()
        if len(frame):
            same(read, frame, name)
        assert list(units) == list(frame.columns), name
        for column, unit in UNITS.get(name, {}).items():
            assert units[column] == unit, (name, column, units[column])
    who = expected["who"].set_index("participant")
    assert who.loc[1, "is_driver"] and who.is_driver.sum() == 1 and (who.kind == "ambulance").any()
    assert set(expected["participants"].participant) <= set(who.index) and len(who) > 20


def turned(base, vector):
    """A vector of the vehicle's frame in the world's, by OSI's angles: Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = base.orientation.roll, base.orientation.pitch, base.orientation.yaw
    cr, sr, cp, sp, cy, sy = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch), math.cos(yaw), math.sin(yaw)
    matrix = [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr], [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
              [-sp, cp * sr, cp * cr]]
    return [sum(m * v for m, v in zip(row, vector)) for row in matrix]


def check_osi(session, folder):
    path = folder / "drive.mcap"
    run(session, "osi", "--out", path)
    with septet_session.open(session) as opened:
        frame, cars, models = opened.participants(every=1), opened.driver_car(every=1), opened.vehicle_models()
    trace = osi3trace.osi_trace.OSITrace(str(path), "GroundTruth")
    assert [m.name for m in trace.get_file_metadata()] == ["net.asam.osi.trace"]
    ticks = 0
    for message, (tick, rows) in zip(trace, frame.groupby("tick")):
        ticks += 1
        time_s = message.timestamp.seconds + 1e-9 * message.timestamp.nanos
        assert abs(time_s - rows.simulated_time_s.iloc[0]) < 1e-9 and message.host_vehicle_id.value == 1
        assert [m.id.value for m in message.moving_object] == rows.participant.tolist(), tick
        if tick % 10:
            continue
        for moving, row in zip(message.moving_object, rows.itertuples()):
            model, base = models[row.model], moving.base
            rear = moving.vehicle_attributes.bbcenter_to_rear
            # From the middle of the box to the middle of the rear axle on the ground, which is where Septet says that a
            # vehicle is.
            to_origin = turned(base, (rear.x, rear.y, rear.z - model["wheel_radius_m"]))
            for found, offset, expected in zip((base.position.x, base.position.y, base.position.z), to_origin, (row.x_m, row.y_m, row.z_m)):
                assert abs(found + offset - expected) < 1e-6, (tick, row.participant)
            assert abs(base.dimension.length - model["length_m"]) < 1e-9
            speed = math.hypot(row.velocity_x_mps, row.velocity_y_mps)
            assert abs(math.hypot(base.velocity.x, base.velocity.y) - speed) < 1.0 + 3.0 * abs(row.angular_velocity_z_radps)
            state = moving.vehicle_classification.light_state
            assert (state.brake_light_state == state.BRAKE_LIGHT_STATE_NORMAL) == bool(row.lamps & 1)
    trace.close()
    assert ticks == len(cars) > 100, (ticks, len(cars))


with tempfile.TemporaryDirectory() as temporary:
    place = pathlib.Path(temporary)
    subprocess.run([sys.argv[1], "drive", "--rig", "seven-screens", "--scenario", "motorway-ambulance", "--no-screens", "--seconds", "1",
                    "--participant", "P07", "--out", str(place / "drive")], check=True, stdout=subprocess.DEVNULL)
    drive = place / "drive" / "session.sqlite"
    for wanted in sys.argv[2:]:
        if wanted == "osi":
            check_osi(drive, place)
        else:
            check_tables(drive, place / wanted, wanted)
        print(f"{wanted}: read back")
