"""Each script of samples/scripts in a drive of its own, which is then verified and filmed: sample_scripts_check.py SEPTET.

Of one of the drives an edit is altered by one byte and packed again: `replay --verify` names its tick and node.
"""
import concurrent.futures
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
import zlib

from edited_drive import EditedDrive, root, run, triangle_glb, use_module_of

septet_program = pathlib.Path(sys.argv[1])
use_module_of(septet_program)
import septet  # noqa: E402

TRANSFORM_SET, HIDE_SET, MOTION_SET, CREATE_NAME = 10, 14, 29, 5
#: Drives at once: they wait for their scripts most of the time.
DRIVES_AT_ONCE = 6


def varint(data: bytes, at: int) -> tuple:
    value = shift = 0
    while True:
        byte = data[at]
        value, shift, at = value | (byte & 127) << shift, shift + 7, at + 1
        if byte < 128:
            return value, at


def as_varint(value: int) -> bytes:
    out = b""
    while value > 127:
        out, value = out + bytes([value & 127 | 128]), value >> 7
    return out + bytes([value])


def commands_of(data: bytes) -> list:
    """Of one row of scene_edits (logging/FORMAT.md)."""
    _, at = varint(data, 0)
    unpacked, at, commands = zlib.decompress(data[at:]), 0, []
    while at < len(unpacked):
        size, at = varint(unpacked, at)
        commands.append(unpacked[at : at + size])
        at += size
    return commands


def row_of(commands: list) -> bytes:
    unpacked = b"".join(as_varint(len(command)) + command for command in commands)
    return as_varint(len(unpacked)) + zlib.compress(unpacked, 3)


class Logged:
    """What a session tells of a script."""

    def __init__(self, session: pathlib.Path) -> None:
        database = sqlite3.connect(session)
        rows = database.execute("SELECT tick, data FROM scene_edits WHERE tick > 0 ORDER BY id").fetchall()
        self.edits = [(tick, command) for tick, data in rows for command in commands_of(data)]
        self.events = database.execute("SELECT kind, detail FROM events ORDER BY id").fetchall()
        self.last_s = database.execute("SELECT max(simulated_time_s) FROM snapshots").fetchone()[0]
        database.close()

    def ticks_of(self, opcode: int) -> set:
        return {tick for tick, command in self.edits if command[0] == opcode}

    def names(self, name: str) -> bool:
        return any(command[0] == CREATE_NAME and command.endswith(name.encode()) for _, command in self.edits)

    def details(self, kind: str) -> list:
        return [detail for event, detail in self.events if event == kind]


def lift(drive: EditedDrive) -> None:
    """The barrier's script has its call from another key."""
    with septet.connect("127.0.0.1", drive.port, drive.keys / "desk/desk.key") as desk:
        while not desk.find("stimuli/arm"):
            time.sleep(0.1)
        desk.call("lift", "stimuli/barrier", degrees=90)
        while abs(desk.get("stimuli/hinge").wxyz[1] - 0.5**0.5) > 1e-9:
            time.sleep(0.1)


def no_gap(table: pathlib.Path) -> bool:
    """A row for each tenth of a second of which a tick came."""
    rows = table.read_text().splitlines()[1:]
    tenths = [int(float(row.split(",")[0]) * 10 + 0.01) for row in rows]
    return len(set(tenths)) == len(tenths) > 9


def steps(said: str) -> list:
    return [round(float(line.split()[0]), 2) for line in said.splitlines()]


#: By script: its arguments behind the keys, and whether its drive shows what it is for.
SCRIPTS = {
    "ball.py": (["ball.glb"], lambda log, said, folder: log.names("stimuli/ball") and len(log.ticks_of(TRANSFORM_SET)) > 10 and log.ticks_of(HIDE_SET)),
    "barrier.py": (["6"], lambda log, said, folder: said.startswith("lifted for desk at ") and any("name=lift" in text for text in log.details("call"))),
    "deer.py": (["ball.glb"], lambda log, said, folder: log.names("stimuli/deer") and len(log.ticks_of(MOTION_SET)) == 1),
    "follow_me.py": (["ball.glb", "2"], lambda log, said, folder: log.names("stimuli/target") and len(log.ticks_of(MOTION_SET)) > 5),
    "log_gaze.py": (["gaze.csv", "3"], lambda log, said, folder: not log.edits and no_gap(folder / "gaze.csv")),
    "n_back.py": (["5"], lambda log, said, folder: log.names("stimuli/gantry") and sum("note=n-back" in text for text in log.details("mark")) > 1),
    "rain_in_bends.py": (["2"], lambda log, said, folder: any(text.startswith("by=lab wish=conditions") for text in log.details("operator"))),
    "repaint_traffic.py": ([], lambda log, said, folder: said.startswith("repainted ") and int(said.split()[1]) > 0 and len({tick for tick, _ in log.edits}) == 1),
    "sign_at_200_m.py": ([], lambda log, said, folder: said.startswith("changed at ") and log.names("stimuli/sign")),
    "step_by_step.py": (["4"], lambda log, said, folder: len(steps(said)) == 4 and abs(steps(said)[3] - steps(said)[0] - 0.3) < 0.02),
    "too_close.py": (["2"], lambda log, said, folder: log.names("stimuli/too-close") and log.ticks_of(HIDE_SET)),
}


def film(session: pathlib.Path, folder: pathlib.Path, until_s: float) -> bytes:
    """A picture of the drive shortly before that instant."""
    (folder / "end.toml").write_text(f"[[shot]]\nfrom_s = {until_s - 0.25:.3f}\nto_s = {until_s:.3f}\ninterior = true\n")
    run(str(septet_program), "film", str(session), "--shots", str(folder / "end.toml"), "--out", str(folder / "film"), "--fps", "4", "--size", "96x64",
        "--renderer", "raster", "--software", "--no-sound")
    (picture,) = sorted((folder / "film").glob("*.png"))
    return picture.read_bytes()


def drive_with(script: str, folder: pathlib.Path) -> pathlib.Path:
    """Drives, runs the script, and proves what the log has of it; returns the session."""
    folder.mkdir()
    (folder / "ball.glb").write_bytes(triangle_glb())
    arguments, is_shown = SCRIPTS[script]
    arguments = [str(folder / word) if "." in word else word for word in arguments]
    with EditedDrive(septet_program, folder, ["lab=edit operate", "desk=edit operate"]) as drive:
        running = subprocess.Popen([sys.executable, str(root / "samples/scripts" / script), str(drive.keys / "lab"), *arguments], stdout=subprocess.PIPE, text=True)
        if script == "barrier.py":
            lift(drive)
        said, _ = running.communicate(timeout=600)
        assert running.returncode == 0, (script, said)
    log = Logged(drive.session)
    assert is_shown(log, said, folder), (script, said, log.edits, log.events)
    verified = run(str(septet_program), "replay", "--verify", str(drive.session))
    assert "every state hash agrees" in verified and "the scene is the one that was driven in" in verified, (script, verified)
    picture = film(drive.session, folder, log.last_s - 0.1)
    assert picture.startswith(b"\x89PNG") and len(picture) > 1000, (script, len(picture))
    return drive.session


def an_altered_edit_is_named(session: pathlib.Path, folder: pathlib.Path) -> None:
    """One byte of a place of the ball, in a row that is packed as before."""
    altered = folder / "altered.sqlite"
    shutil.copy(session, altered)
    database = sqlite3.connect(altered)
    rows = database.execute("SELECT id, tick, data FROM scene_edits WHERE tick > 0 ORDER BY id DESC").fetchall()
    row, tick, commands = next((row, tick, commands_of(data)) for row, tick, data in rows if commands_of(data)[0][0] == TRANSFORM_SET)
    place = len(commands[0]) - 4
    commands[0] = commands[0][:place] + bytes([commands[0][place] ^ 1]) + commands[0][place + 1 :]
    database.execute("UPDATE scene_edits SET data = ? WHERE id = ?", (row_of(commands), row))
    database.commit()
    database.close()
    for words in (("replay", "--verify"), ("check",)):
        done = subprocess.run([str(septet_program), *words, str(altered)], capture_output=True, text=True, timeout=600)
        assert done.returncode != 0 and f'"stimuli/ball" from tick {tick} on is not the one that was made' in done.stdout + done.stderr, (words, done)


assert set(SCRIPTS) == {path.name for path in (root / "samples/scripts").glob("*.py")}
begun = time.monotonic()
with tempfile.TemporaryDirectory() as name:
    with concurrent.futures.ThreadPoolExecutor(DRIVES_AT_ONCE) as drives:
        driven = {script: drives.submit(drive_with, script, pathlib.Path(name) / script.split(".")[0]) for script in SCRIPTS}
    sessions = {script: session.result() for script, session in driven.items()}
    an_altered_edit_is_named(sessions["ball.py"], pathlib.Path(name))
print(f"{len(sessions)} scripts, each in its drive: {time.monotonic() - begun:.0f} s")
