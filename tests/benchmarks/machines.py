#!/usr/bin/env python3
"""Efficiency of a traced film on machines of unequal speed: measured, not simulated.

machines.py [--build FOLDER] [--programs N] [--size WIDTHxHEIGHT] [--samples N] [--film-samples N] [--frames N] [--what picture,film]
            [--schedules ours,paper,round-robin] [--session FILE] [--json FILE]

Drives a second on the shipped scenario, then traces one picture and a film with N programs of one thread each under mpirun, whose speeds go from 1 to
9 (SEPTET_FILM_PACES: a program sleeps after each tile until it has used its share of a processor), with Septet's schedule, the paper's 81 equal
buckets and the same in turn. All speeds together are 1.3 processors, so that two are enough for them.

Efficiency: the processor time of all tiles that count, over the speeds' sum, over the time from the first tile that was dealt to the last that came.
What is missing from 100 is told by where it went: tiles that another delivered first (twice), time before the first tile of another frame than the
last (frames), before other tiles (runs), and after a program's last tile (end), each weighed by the program's speed.
To make a frame ready counts as no work, and is not slowed down: it keeps a program from tracing for as long as the processor really takes. Its share
falls with the size and the samples of a frame, so that they are told with each figure.
No tile is dealt before all programs have read the session, which fifteen programs that share two processors do for longer than machines of their own.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ALL_PACES = 1.3  # Of processors, unless --processors says otherwise.


def paces(programs, processors=ALL_PACES):
    """Speeds from 1 to 9, mixed, the first program's in the middle."""
    speeds = [1.0 + 8.0 * (n * 7 % programs) / max(1, programs - 1) for n in range(programs)]
    speeds[0], middle = 5.0, speeds[0]
    if programs > 1 and middle < min(speeds):
        speeds[1] = middle
    return [processors * speed / sum(speeds) for speed in speeds]


def run(build, session, folder, schedule, shares, arguments, buckets=81):
    out = folder / f"{schedule}-{buckets}"
    number = 0
    while out.exists():
        number += 1
        out = folder / f"{schedule}-{buckets}-{number}"
    statistics = folder / (out.name + ".json")
    environment = dict(os.environ, SEPTET_FILM_PACES=",".join(f"{share:.5f}" for share in shares),
                       OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    command = ["mpirun", "-n", str(len(shares)), "--oversubscribe", "--bind-to", "none", str(build / "septet-film"), str(session),
               "--renderer", "traced", "--schedule", schedule, "--buckets", str(buckets), "--statistics", str(statistics), "--out", str(out), *arguments]
    ended = subprocess.run(command, env=environment, capture_output=True, text=True)
    if ended.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{ended.stderr}")
    made = json.loads(statistics.read_text())
    made["pictures"] = {picture.name: picture.read_bytes() for picture in sorted(out.glob("*.png"))}
    rows = [dict(zip(made["columns"], row)) for row in made.pop("tiles")]
    made["rows"], made["shares"] = rows, shares
    made["time_s"] = max(row["came_s"] for row in rows if row["counts"])
    made["work_s"] = sum(row["cpu_s"] for row in rows if row["counts"])
    made["efficiency"] = made["work_s"] / sum(shares) / made["time_s"]
    made["lost"] = losses(rows, shares, made["time_s"])
    return made


def losses(rows, shares, time_s):
    """Shares of the programs' possible work, by the cause of its loss. Each has one thread."""
    lost = dict.fromkeys(("twice", "frames", "runs", "end"), 0.0)
    for program, share in enumerate(shares):
        last_s, frame = 0.0, None
        for row in sorted((row for row in rows if row["program"] == program and row["came_s"] <= time_s), key=lambda row: row["came_s"]):
            gap_s = row["came_s"] - last_s - row["cpu_s"] / share
            lost["runs" if row["frame"] == frame else "frames"] += share * gap_s
            lost["twice"] += 0.0 if row["counts"] else row["cpu_s"]
            last_s, frame = row["came_s"], row["frame"]
        lost["end"] += share * (time_s - last_s)
    return {name: work / sum(shares) / time_s for name, work in lost.items()}


def drive(build, folder, seconds=1.2):
    subprocess.run([str(build / "septet"), "drive", "--virtual", "--seconds", str(seconds), "--out", str(folder / "drive")],
                   check=True, capture_output=True)
    return folder / "drive" / "session.sqlite"


def report(name, made, frames):
    count = sum(row["counts"] for row in made["rows"])
    lost = ", ".join(f"{name} {100 * share:.1f}" for name, share in made["lost"].items())
    return (f"{name:<48} {100 * made['efficiency']:6.1f} % of ideal ({lost}), {made['time_s']:6.1f} s, "
            f"{made['splits']} splits, {len(made['rows']) - count} of {count} tiles twice, "
            f"{(made['sent_bytes'] + made['received_bytes']) / frames / 1e6:.2f} MB and {made['master_cpu_s'] / frames:.3f} s of the master a frame")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--programs", type=int, default=15)
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--samples", type=int, default=64, help="of one picture")
    parser.add_argument("--film-samples", type=int, default=16)
    parser.add_argument("--what", default="picture,film")
    parser.add_argument("--frames", type=int, default=30, help="of the film")
    parser.add_argument("--processors", type=float, default=ALL_PACES, help="all speeds together; less on a machine that is busy with other things")
    parser.add_argument("--session", type=pathlib.Path, help="that was driven before, at least a second long")
    parser.add_argument("--schedules", default="ours,paper,round-robin")
    parser.add_argument("--json", type=pathlib.Path)
    given = parser.parse_args()
    build = given.build.resolve()
    shares = paces(given.programs, given.processors)
    print(f"{given.programs} programs, speeds 1 : {max(shares) / min(shares):.1f}, together {sum(shares):.2f} processors; load {os.getloadavg()[0]:.1f}")
    results = {}
    with tempfile.TemporaryDirectory(prefix="septet-machines-") as name:
        folder = pathlib.Path(name)
        session = given.session.resolve() if given.session else drive(build, folder)
        measured = {"picture": (1, "one picture", given.samples), "film": (given.frames, f"a film of {given.frames}", given.film_samples)}
        for frames, what, samples in (measured[word] for word in given.what.split(",")):
            what += f", {given.size}, {samples} samples"
            (folder / "shots.toml").write_text(f"[[shot]]\nfrom_s = 0.5\nto_s = {0.5 + frames / 60}\n")
            arguments = ["--shots", str(folder / "shots.toml"), "--fps", "60", "--size", given.size, "--samples", str(samples)]
            pictures = None
            for schedule in given.schedules.split(","):
                made = run(build, session, folder, schedule, shares, arguments)
                print(report(f"{what}, {schedule}", made, frames), flush=True)
                if pictures is not None and made["pictures"] != pictures:
                    sys.exit("the pictures differ")
                pictures = made.pop("pictures")
                results[f"{what}, {schedule}"] = {key: value for key, value in made.items() if key != "rows"}
    if given.json:
        given.json.write_text(json.dumps(results, indent=1))


if __name__ == "__main__":
    main()
