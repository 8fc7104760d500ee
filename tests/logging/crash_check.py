"""crash_check.py SESSION NAME: the figures of its crashes, reckoned anew from its snapshots, are the log's within 1 %."""
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "logging" / "python"))
import septet_crash  # noqa: E402
import septet_session  # noqa: E402

with septet_session.open(sys.argv[1]) as session:
    crashes = septet_crash.crashes(session)
    found = septet_crash.recomputed(session)
    records = septet_crash.records(session)
assert len(crashes) >= 1, "no crash is told"
assert len(found) > 0, "no crash has both its bodies' motion"
found["share"] = found.difference.abs() / found.scale
print(found.to_string())
figures = {"closing_speed_mps", "delta_v_mps", "its_delta_v_mps", "delta_yaw_rate_radps", "its_delta_yaw_rate_radps", "principal_direction_rad",
           "its_principal_direction_rad", "kinetic_before_j", "kinetic_after_j", "depth_m", "crush_j", "friction_j"}
assert figures <= set(found.figure), figures - set(found.figure)
worst = found.loc[found.share.idxmax()]
assert worst.share <= 0.01, worst
for record in records:
    if "kinetic_before_j" not in record:
        continue
    lost = record["kinetic_before_j"] - record["kinetic_after_j"]
    told = sum(record[part] for part in ("crush_j", "friction_j", "debris_j", "wheels_j"))
    assert abs(lost - told) <= 0.001 * lost, record
if sys.argv[2] == "walker":
    # A person is thrown by the car: what nobody measured is missing.
    person = [record for record in records if record["first"] == 1]
    assert person and "kinetic_before_j" not in person[0] and "its_delta_v_x_mps" not in person[0], person
    assert "delta_v_x_mps" in person[0] and person[0]["pulse_ns"].shape[1] == 2
