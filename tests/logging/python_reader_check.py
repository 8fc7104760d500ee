"""python_reader_check.py SESSION EXPECTED.csv: all participants at every tick, as in the C++ reader, within a hair."""
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "logging" / "python"))
import pandas  # noqa: E402
import septet_crash  # noqa: E402
import septet_session  # noqa: E402

expected = pandas.read_csv(sys.argv[2])
with septet_session.open(sys.argv[1]) as session:
    found = session.participants()
    car = session.driver_car()
    assert session.names()["32769"] == "stimuli/a wall", session.names()
    assert len(session.samples) > 10 and "time_headway_s" in session.samples and session.meta["participant"] == "P07"
assert len(found) == len(expected) > 1000, (len(found), len(expected))
assert car.tick.is_monotonic_increasing and (car.speed_mps == 30.0).all() and (car.lane == -2).all()
for column in expected.columns:
    worst = (found[column] - expected[column]).abs().max()
    assert worst <= 1e-9, (column, worst)

# A solid's name is the rest of a record, whatever it holds.
record = septet_crash._record(1, 'version=1 tick=3 with=32769 closing_speed_mps=5 what="stimuli/a wall tick=9"')
assert (record["tick"], record["what"]) == (3, "stimuli/a wall tick=9"), record
