"""crash_check.py SESSION FIGURE…: the figures of its crashes, reckoned anew from its snapshots, are the log's within 1 %.

FIGURE: what must be among them."""
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "logging" / "python"))
import septet_crash  # noqa: E402
import septet_session  # noqa: E402

with septet_session.open(sys.argv[1]) as session:
    found = septet_crash.recomputed(session)
    records = septet_crash.records(session)
assert len(records) >= 1, "no crash is told"
found["share"] = found.difference.abs() / found.scale
print(found.to_string())
missing = set(sys.argv[2:]) - set(found.figure)
assert not missing, f"not reckoned: {sorted(missing)}"
wrong = found[~(found.share <= 0.01)]
assert wrong.empty, "\n" + wrong.to_string()
for record in records:
    if "kinetic_before_j" in record:
        lost = record["kinetic_before_j"] - record["kinetic_after_j"]
        told = sum(record[part] for part in ("crush_j", "friction_j", "debris_j", "wheels_j"))
        assert abs(lost - told) <= 0.001 * lost, record
