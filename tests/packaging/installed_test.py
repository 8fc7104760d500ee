#!/usr/bin/env python3
"""What a Septet that is installed can do, away from its tree: drive, list, explain itself, and be built upon.

    installed_test.py PREFIX             # installed there, by cmake or from the Debian packages
    installed_test.py --install BUILD    # installs this build into a folder of its own first
"""
import gzip
import json
import os
import pathlib
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAMS = ("septet", "septet-server", "septet-screen", "septet-film", "septet-sound", "septet-sight", "septet-ice", "septet-car")
prefix = work = None  # The installed Septet; a folder of this test's own, where nothing of Septet's tree lies above.


def run(*command, **more):
    environment = {name: value for name, value in os.environ.items() if name != "SEPTET_DATA"} | {"LP_NUM_THREADS": "0"}
    done = subprocess.run([str(word) for word in command], cwd=work, env=environment, capture_output=True, text=True, **more)
    if done.returncode:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def program(name):
    return prefix / "bin" / name


def commands_of(name, words=()):
    """Every command of a program as a list of words, with its --help."""
    text = run(program(name), *words, "--help")
    yield list(words), text
    for below in re.findall(r"^  ([a-z-]+) ", text.partition("\nSubcommands:\n")[2].partition("\n\n")[0], re.M):
        yield from commands_of(name, [*words, below])


def options_of(help_text):
    return set(re.findall(r"^  (?:-h,)?(--[a-z-]+)", help_text, re.M))


class Installed(unittest.TestCase):
    def test_every_program_says_its_version(self):
        versions = {run(program(name), "--version").strip() for name in PROGRAMS}
        self.assertEqual(len(versions), 1, versions)
        self.assertRegex(versions.pop(), r"^\d+\.\d+\.\d+")

    def test_what_is_listed_lies_below_the_prefix(self):
        data = prefix / "share/septet"
        listed = {kind: {line.split()[0] for line in run(program("septet"), "list", kind).splitlines()} for kind in ("rigs", "scenarios", "vehicles")}
        self.assertEqual(listed["rigs"], {file.stem for file in (data / "rigs").glob("*.toml")})
        self.assertEqual(listed["vehicles"], {file.stem for file in (data / "vehicles").glob("*.toml")})
        self.assertEqual(listed["scenarios"], {file.stem for file in data.glob("scenarios/*/*.xosc") if file.stem == file.parent.name})
        self.assertIn("motorway-ambulance", listed["scenarios"])

    def test_a_drive_is_drawn_logged_and_summed_up(self):
        run(program("septet"), "drive", "--virtual", "--rig", "desktop", "--seconds", "2", "--out", "drawn")
        self.assertTrue((work / "drawn/panorama.png").read_bytes().startswith(b"\x89PNG"))
        self.assertTrue(json.loads((work / "drawn/summary.json").read_text()))
        log = sqlite3.connect(work / "drawn/session.sqlite")
        self.assertEqual(log.execute("SELECT COUNT(*) FROM snapshots").fetchone(), (241,))
        run(program("septet"), "replay", "--verify", "drawn/session.sqlite")

    def test_sumos_module_is_found(self):
        if not (prefix / "lib/septet/modules/septet-sumo.so").exists() or not pathlib.Path("/usr/bin/sumo").exists():
            self.skipTest("built without SUMO")
        run(program("septet"), "drive", "--no-screens", "--traffic", "sumo", "--seconds", "0.5", "--out", "sumo")

    def test_samples_build_and_agree_with_the_programs(self):
        samples = pathlib.Path(prefix / "share/doc/libseptet-dev/samples")
        run("cmake", "-G", "Ninja", "-S", samples, "-B", "samples", f"-DCMAKE_PREFIX_PATH={prefix}")
        run("cmake", "--build", "samples")
        run("ctest", "--test-dir", "samples", "--output-on-failure")
        data, built = prefix / "share/septet", work / "samples"

        stepped = run(built / "step_car", data / "vehicles/volvo-s80.toml")
        tested = run(program("septet"), "vehicle", "test", "--manoeuvre", "acceleration", "--vehicle", "volvo-s80")
        self.assertAlmostEqual(float(re.search(r"0 to 100 km/h in ([\d.]+) s", stepped)[1]), float(re.search(r"0-100 km/h +([\d.]+) s", tested)[1]), delta=0.06)

        road = data / "scenarios/motorway-ambulance/motorway.xodr"
        read = run(built / "read_road", road)
        for length, identity in re.findall(r'<road name="[^"]*" length="([^"]+)" id="([^"]+)"', road.read_text()):
            self.assertRegex(read, rf'(?m)^road {identity} ".*": {float(length):.1f} m$')
        # The motorway's main line, 3.75 m lanes beyond 2 m of median: there and back gives the lane's middle.
        for lane, s_m, t_m in re.findall(r"(?m)^  lane +(-?\d) driving.*: road 1, s ([\d.]+) m, t (-?[\d.]+) m$", read):
            self.assertAlmostEqual(float(s_m), 3150.0, delta=0.006)
            self.assertAlmostEqual(abs(float(t_m)), 2.0 + 3.75 * (abs(int(lane)) - 2.5), delta=0.006)

        decoded = run(built / "decode_log", built / "drive/session.sqlite")
        log = sqlite3.connect(built / "drive/session.sqlite")
        self.assertIn("\n241 ticks\n", decoded)
        rows = re.findall(r"tick +(\d+) +[\d.]+ s +x +(-?[\d.]+) m +y +(-?[\d.]+) m +([\d.]+) km/h", decoded)
        self.assertEqual([int(row[0]) for row in rows], [0, 60, 120, 180, 240])
        for tick, x_m, y_m, speed_kmh in rows:
            logged = log.execute("SELECT x_m, y_m, speed_mps * 3.6 FROM samples WHERE tick = ?", (int(tick),)).fetchone()
            for read_value, logged_value, delta in zip((x_m, y_m, speed_kmh), logged, (0.005, 0.005, 0.06)):
                self.assertAlmostEqual(float(read_value), logged_value, delta=delta)

    def test_the_sample_editor_changes_a_running_drive_and_saves_what_a_second_one_reads(self):
        samples = pathlib.Path(prefix / "share/doc/libseptet-dev/samples")
        run("cmake", "-G", "Ninja", "-S", samples, "-B", "editor", f"-DCMAKE_PREFIX_PATH={prefix}")
        run("cmake", "--build", "editor", "--target", "edit_drive")
        scenario = ["--virtual", "--rig", "desktop", "--scenario", "behind-ambulance"]
        drive = subprocess.Popen([program("septet"), "drive", *scenario, "--seconds", "3000", "--editors", "keys", "--out", "edited"], cwd=work,
                                 env=os.environ | {"LP_NUM_THREADS": "0"}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            while not (work / "keys/address").exists():
                self.assertIsNone(drive.poll())
                time.sleep(0.05)
            run(work / "editor/edit_drive", "keys", "mine.edits")
        finally:
            drive.send_signal(signal.SIGINT)
            drive.wait()
        saved = (work / "mine.edits").read_text()
        self.assertIn("mine/post", saved)
        run(program("septet"), "drive", "--no-screens", *scenario[1:], "--seconds", "0.2", "--edits", "mine.edits", "--save", "again.edits", "--out", "second")
        self.assertEqual((work / "again.edits").read_text(), saved)
        refused = subprocess.run([work / "editor/edit_drive", "nowhere", "x.edits"], cwd=work, capture_output=True, text=True)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("nowhere", refused.stderr)

    def test_manual_pages_tell_every_command_and_option(self):
        for name in PROGRAMS:
            page = gzip.decompress((prefix / f"share/man/man1/{name}.1.gz").read_bytes()).decode().replace("\\-", "-")
            for words, text in commands_of(name):
                if words:
                    self.assertIn(f"\n.SS {' '.join([name, *words])}\n", page)
                for option in options_of(text) - {"--help"}:
                    self.assertRegex(page, rf"(?m)^\.B {option}( |$)")

    def complete(self, name, *words):
        """Completions that bash offers for the last of these words."""
        script = f"""source {prefix}/share/bash-completion/completions/{name}
            COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _septet "$1"; printf '%s\\n' "${{COMPREPLY[@]}}" """
        return set(run("bash", "-c", script, "bash", program(name), *words).split())

    def test_bash_completes_every_command_and_option(self):
        for name in PROGRAMS:
            every = dict((tuple(words), text) for words, text in commands_of(name))
            for words, text in every.items():
                self.assertEqual(self.complete(name, *words, "--"), options_of(text), (name, words))
                below = {other[-1] for other in every if other[:-1] == words and other}
                if below:
                    self.assertEqual(self.complete(name, *words, ""), below, (name, words))
        self.assertEqual(self.complete("septet", "dr"), {"drive"})
        self.assertEqual(self.complete("septet", "drive", "--virtual", "--rig", "s"), {"seven-screens"})
        self.assertEqual(self.complete("septet-server", "--driver", "esc"), {"escort"})
        self.assertEqual(self.complete("septet", "list", "r"), {"rigs"})


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="septet-installed-") as folder:
        work = pathlib.Path(folder)
        if sys.argv[1] == "--install":
            prefix = work / "prefix"
            run("cmake", "--install", pathlib.Path(sys.argv[2]).resolve(), "--prefix", prefix)
        else:
            prefix = pathlib.Path(sys.argv[1]).resolve()
        unittest.main(argv=sys.argv[:1], verbosity=2)
