"""Sessions that were altered at random: what `septet check` passes, every other reader reads.

    mutated_sessions.py SEPTET COUNT SEED [--film-every N]

Drives for a second, alters copies of the session (bytes, pages, rows, values, types, meta rows, an end cut off), and asks check; those that pass are
verified, reported, heard, read in Python, and a sample is filmed. Prints each breach with its number, from which it is made again.
"""
import argparse
import pathlib
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
PAGE_BYTES = 16384
KEYS = {"meta": "key", "files": "rowid", "snapshots": "tick", "driver_inputs": "tick", "scene_edits": "id", "samples": "tick", "events": "id",
        "questionnaire": "id", "saved_states": "tick", "edit_fingerprints": "id", "actuators": "tick", "head_positions": "tick"}


# Deliberately crafted files; check reports each.
CRAFTED = {
    "no scene": "DELETE FROM scene_edits",
    "a third of the scene random": "UPDATE scene_edits SET data = randomblob(length(data)) WHERE id % 3 = 0",
    "the scene's edits exchanged": "UPDATE scene_edits SET id = -id",
    "speeds of 1e300": "UPDATE samples SET speed_mps = 1e300, x_m = 1e300, lateral_position_m = 1e300",
    "speeds that are text": "UPDATE samples SET speed_mps = 'fast'",
    "negative ticks": "UPDATE samples SET tick = -tick - 1",
    "empty snapshots": "UPDATE snapshots SET data = x''",
    "a selector of -7": "UPDATE driver_inputs SET selector = -7",
    "no files": "DELETE FROM files",
    "another rig": "UPDATE files SET content = CAST('[[screen]]' AS BLOB) WHERE role = 'rig'",
    "another seed": "UPDATE meta SET value = '99' WHERE key = 'seed.drive'",
    "an operator's command": "INSERT INTO events VALUES(NULL, 10, 0.1, 'operator_command', NULL, 'fog visibility_m=30')",
    "a trigger": "CREATE TRIGGER t AFTER INSERT ON questionnaire BEGIN DELETE FROM snapshots; END",
    "an endless view": "DROP TABLE actuators; CREATE VIEW actuators AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) "
                       "SELECT x AS tick, 1.0 a, 1.0 b, 1.0 c, 1.0 d, 0 e FROM c",
    "an endless view in capitals": "DROP TABLE actuators; CREATE VIEW ACTUATORS AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) "
                                   "SELECT x AS tick FROM c",
    "deep models": "UPDATE meta SET value = replace(hex(zeroblob(50000)), '0', '[') WHERE key = 'vehicle_models'",
    "models that are a number": "UPDATE meta SET value = '7' WHERE key = 'vehicle_models'",
    "names that are a list": "UPDATE meta SET value = '[1, 2]' WHERE key = 'participant_names'",
    "names that are no JSON": "UPDATE meta SET value = '{' WHERE key = 'participant_names'",
    "an outcome that is none": "UPDATE meta SET value = '{}' WHERE key = 'outcome'",
    "digests that are none": "UPDATE meta SET value = '[]' WHERE key = 'digests'",
    "text that is no UTF-8": "UPDATE events SET detail = CAST(x'ff80' AS TEXT)",
    "a column of a function": "ALTER TABLE samples ADD COLUMN more AS (hex(zeroblob(1000000)))",
}

# No check need find these: every reader takes what it understands of them.
PASSED_OVER = {
    "a crash of nobody's": "INSERT INTO events VALUES(NULL, 10, 0.1, 'crash', 1, 'version=1 tick=9 ticks=4294967295 point_x_m=1 point_y_m=1 point_z_m=nan "
                           "normal_rad=1 closing_speed_mps=1 pulse_ns=1:1,')",
    "a crash without words": "INSERT INTO events VALUES(NULL, 10, 0.1, 'crash', NULL, '')",
}


def flip_bytes(path, dice):
    data = bytearray(path.read_bytes())
    for _ in range(dice.choice([1, 2, 8])):
        data[dice.randrange(len(data))] = dice.randrange(256)
    path.write_bytes(data)
    return "bytes flipped"


def cut_off(path, dice):
    data = path.read_bytes()
    path.write_bytes(data[:dice.randrange(len(data))])
    return "cut off"


def alter_page(path, dice):
    data = bytearray(path.read_bytes())
    pages = len(data) // PAGE_BYTES
    one, other = dice.randrange(1, pages), dice.randrange(1, pages)
    how = dice.choice(["zeroed", "copied", "exchanged"])
    a, b = slice(one * PAGE_BYTES, (one + 1) * PAGE_BYTES), slice(other * PAGE_BYTES, (other + 1) * PAGE_BYTES)
    if how == "zeroed":
        data[a] = bytes(PAGE_BYTES)
    elif how == "copied":
        data[a] = data[b]
    else:
        data[a], data[b] = data[b], data[a]
    path.write_bytes(data)
    return f"page {how}"


def altered(value, dice):
    """Something else in the place of a value."""
    how = dice.randrange(6)
    if how == 0:
        return dice.choice([None, "text", b"bytes", 1, -7, 1e300, float("inf"), 0, 2**62, "", b"", "[" * 100000, "{}"])
    if isinstance(value, bytes) and value:
        data = bytearray(value)
        if how == 1:
            return bytes(data[:dice.randrange(len(data))])
        if how == 2:
            return bytes(data) + b"more"
        data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
        return bytes(data)
    if isinstance(value, str) and value:
        at = dice.randrange(len(value))
        return value[:at] + dice.choice(["", "x", "\x00", "9", '"', "}"]) + value[at + 1:]
    if isinstance(value, (int, float)):
        return dice.choice([value + 1, -value - 1, value * 2, float(value), 0, value + 0.5, value + 1e-6, 10**9])
    return dice.choice([0, 1.5, "x"])


def alter_rows(path, dice):
    database = sqlite3.connect(path, isolation_level=None)
    database.text_factory = lambda data: data.decode(errors="replace")
    table = dice.choice(list(KEYS))
    key = KEYS[table]
    rows = [row[0] for row in database.execute(f"SELECT {key} FROM {table}")]
    if not rows:
        table, key = "snapshots", "tick"
        rows = [row[0] for row in database.execute("SELECT tick FROM snapshots")]
    row = dice.choice(rows)
    columns = [column[1] for column in database.execute(f"PRAGMA table_info({table})")]
    how = dice.choice(["value", "value", "value", "deleted", "cleared", "moved", "exchanged"])
    text = f"{table} {row!r} {how}"
    try:
        if how == "value":
            column = dice.choice(columns)
            (value,) = database.execute(f"SELECT {column} FROM {table} WHERE {key} = ?", (row,)).fetchone()
            new = altered(value, dice)
            text += f" {column}: {str(value)[:30]!r} -> {str(new)[:30]!r}"
            database.execute(f"UPDATE {table} SET {column} = ? WHERE {key} = ?", (new, row))
        elif how == "deleted":
            database.execute(f"DELETE FROM {table} WHERE {key} = ?", (row,))
        elif how == "cleared":
            database.execute(f"DELETE FROM {table} WHERE {key} >= ?", (row,))
        elif how == "moved":
            database.execute(f"UPDATE {table} SET {key} = ? WHERE {key} = ?", (f"{row}x" if table == "meta" else row + 100000, row))
        else:
            other = dice.choice(rows)
            column = dice.choice([column for column in columns if column != key] or columns)
            values = [database.execute(f"SELECT {column} FROM {table} WHERE {key} = ?", (which,)).fetchone()[0] for which in (row, other)]
            database.execute(f"UPDATE {table} SET {column} = ? WHERE {key} = ?", (values[1], row))
            database.execute(f"UPDATE {table} SET {column} = ? WHERE {key} = ?", (values[0], other))
    except (sqlite3.Error, OverflowError) as error:
        text += f" (refused: {error})"
    database.close()
    return text


def mutate(path, dice):
    return dice.choices([flip_bytes, cut_off, alter_page, alter_rows], [3, 1, 2, 10])[0](path, dice)


PYTHON = """
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[2])
import septet_session
try:
    with septet_session.open(sys.argv[1]) as session:
        session.meta, session.files, session.samples, session.events, session.questionnaire, session.actuators, session.driver_inputs
        session.motion_tables(12)
except septet_session.SessionError as error:
    sys.exit(f"SessionError: {error}")
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("septet", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("seed", type=int)
    parser.add_argument("--film-every", type=int, default=0)
    parser.add_argument("--from", type=int, default=0, dest="first")
    options = parser.parse_args()
    python = pathlib.Path(__file__).resolve().parents[2] / "logging" / "python"

    def run(*words):
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, errors="replace", timeout=600, check=False)
        return done.returncode, (done.stdout + done.stderr).strip()[-400:]

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        status, said = run(options.septet, "drive", "--no-screens", "--driver", "plain", "--seconds", "1.1", "--out", folder / "good")
        assert status == 0, said
        good, session = folder / "good" / "session.sqlite", folder / "altered" / "session.sqlite"
        session.parent.mkdir()
        readers = {"verify": [options.septet, "replay", "--verify", session],
                   "report": [options.septet, "report", session, "--out", folder / "report.html"],
                   "sound": [options.septet, "sound", session, "--out", folder / "sound.wav"],
                   "Python": ["/usr/bin/python3", "-c", PYTHON, session, python],
                   "film": [options.septet, "film", session, "--size", "64x36", "--fps", "1", "--out", folder / "film"]}
        passed = breaches = 0
        for what, sql in CRAFTED.items():
            shutil.copyfile(good, session)
            database = sqlite3.connect(session)
            database.executescript(sql)
            database.close()
            status, said = run(options.septet, "check", session)
            python_status, python_said = run(*readers["Python"])
            if status != 1 or str(session) not in said or (python_status != 0 and not python_said.startswith("SessionError: ")):
                breaches += 1
                print(f"{what}: check ends with {status}: {said}; Python with {python_status}: {python_said}", flush=True)
        for what, sql in PASSED_OVER.items():
            shutil.copyfile(good, session)
            database = sqlite3.connect(session)
            database.executescript(sql)
            database.close()
            for reader in ("verify", "report", "Python"):
                status, said = run(*readers[reader])
                if status != 0:
                    breaches += 1
                    print(f"{what}: {reader} ends with {status}: {said}", flush=True)
        for number in range(options.first - 1, options.first + options.count):  # The first is the good one itself.
            dice = random.Random(f"{options.seed} {number}")
            shutil.copyfile(good, session)
            is_good = number < options.first
            what = "nothing" if is_good else mutate(session, dice)
            status, said = run(options.septet, "check", session)
            if status not in (0, 1) or (status == 1 and "error" not in said) or (is_good and status != 0):
                breaches += 1
                print(f"{number}: {what}: check ends with {status}: {said}", flush=True)
            if status != 0:
                # Python says what is wrong, or reads what it understands, and never ends otherwise.
                status, said = run(*readers["Python"])
                if status not in (0, 1) or (status == 1 and not said.startswith("SessionError: ")):
                    breaches += 1
                    print(f"{number}: {what}: Python ends with {status}: {said}", flush=True)
                continue
            passed += 1
            for reader, words in readers.items():
                if reader == "film" and not (options.film_every and passed % options.film_every == 1):
                    continue
                (folder / "sound.wav").unlink(missing_ok=True)
                shutil.rmtree(folder / "film", ignore_errors=True)
                status, said = run(*words)
                if status != 0:
                    breaches += 1
                    print(f"{number}: {what}: passed check, and {reader} ends with {status}: {said}", flush=True)
        print(f"{options.count} sessions altered, {passed - 1} of them passed check, {breaches} breaches")
        return 1 if breaches or passed == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
