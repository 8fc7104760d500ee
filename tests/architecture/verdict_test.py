#!/usr/bin/env python3
"""A kept verdict is believed only if nothing has changed that its test can see: .ci/verdict on small checkouts, of which one thing at a time changes.

    verdict_test.py .ci/verdict

Skipped (77) where the kernel has no Landlock: there no verdict is kept.
"""

import ctypes
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

FAILED = []
if ctypes.CDLL(None).syscall(444, None, ctypes.c_size_t(0), 1) < 2:  # landlock_create_ruleset, asked for its version.
    print("The kernel has no Landlock.")
    sys.exit(77)


class Checkout:
    """A checkout with one program, which reads the given files and counts its runs in a file beside the checkout."""

    def __init__(self, home, name):
        self.home, self.root = home, home / name
        self.runs, self.build = home / f"{name}-runs", self.root / "build/release"
        for folder in (".ci", "scenarios", "rigs"):
            (self.root / folder).mkdir(parents=True)
        self.build.mkdir(parents=True)
        shutil.copy(sys.argv[1], self.root / ".ci/verdict")
        for path in (".ci/leaks-of-others.txt", ".ci/races-of-others.txt", "scenarios/road.xodr", "rigs/desktop.toml"):
            (self.root / path).write_text("as it was")
        (self.build / "septet").write_bytes(b"\x7fELF product revision of Septet: 6ccbc82\0")
        self.program = self.build / "road_test"
        self.program.write_text('#!/bin/sh\necho >>"${0%/build/*}-runs"\ncat "$@" >/dev/null\n')
        self.program.chmod(0o755)

    def test(self, *arguments, **environment):
        """Exit status, and true if it ran."""
        before = self.runs.stat().st_size if self.runs.exists() else 0
        command = [self.root / ".ci/verdict", f"--build={self.build}", "--reads=scenarios", "--starts=septet", "--mounts=a full disk", "--",
                   self.program, *(arguments or [self.root / "scenarios/road.xodr"])]
        kept = {name: value for name, value in os.environ.items() if not name.startswith("SEPTET_")}
        kept |= {"SEPTET_VERDICTS": str(self.home / "verdicts")} | environment
        status = subprocess.run(command, env=kept, capture_output=True, check=False).returncode
        after = self.runs.stat().st_size if self.runs.exists() else 0
        return status, after > before

    def passed_once(self):
        return self.test() == (0, True) and self.test() == (0, False)


def check(fact, holds):
    if not holds:
        FAILED.append(fact)


def changed(fact, change):
    """A checkout whose verdict is kept; after the change its test runs again."""
    with tempfile.TemporaryDirectory() as home:
        checkout = Checkout(pathlib.Path(home), "clone")
        check(f"{fact}: the verdict was not kept before", checkout.passed_once())
        change(checkout)
        check(fact, checkout.test()[1])


def append(path, text):
    def change(checkout):
        with open(checkout.root / path, "a", encoding="utf-8") as file:
            file.write(text)
    return change


def same_size_and_time(checkout):
    """Differences of content alone."""
    path = checkout.root / "scenarios/road.xodr"
    times = path.stat()
    path.write_text("as it wos")
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


changed("a test runs again whose program has changed", append("build/release/road_test", "# another program\n"))
changed("a test runs again of which a program that it starts has changed", append("build/release/septet", "another"))
changed("a test runs again whose data have changed", append("scenarios/road.xodr", "!"))
changed("a test runs again whose data changed within a moment, at the same size", same_size_and_time)
changed("a test runs again of which a folder has one file more", append("scenarios/new.xodr", ""))
changed("a test runs again of which a folder has one file less", lambda checkout: (checkout.root / "scenarios/road.xodr").rename(checkout.home / "gone"))
changed("a test runs again of which a file may now be started", lambda checkout: (checkout.root / "scenarios/road.xodr").chmod(0o755))
changed("a test runs again when verdicts are reached in another way", append(".ci/verdict", "# another way\n"))

with tempfile.TemporaryDirectory() as home:
    one = Checkout(pathlib.Path(home), "clone")
    check("a test that passed is not run twice", one.passed_once())
    check("SEPTET_BELIEVE=nothing runs it all the same", one.test(SEPTET_BELIEVE="nothing") == (0, True))
    check("another environment runs it", one.test(LC_ALL="de_DE.UTF-8") == (0, True))
    check("a test that is asked for more than a verdict runs", one.test(SEPTET_RENEW_HASHES="1") == (0, True))
    check("a file that the test did not declare does not count", not (append("rigs/desktop.toml", "!")(one), one.test())[1][1])
    (one.build / "septet").write_bytes(b"\x7fELF product revision of Septet: ffd07b2\0")
    check("a commit alone makes no other program", one.test() == (0, False))
    for _ in range(2):
        check("a test fails that reads what it did not declare", one.test(one.root / "rigs/desktop.toml") == (1, True))
        check("a failure is not kept", one.test(one.root / "scenarios/none.xodr") == (1, True))
        check("a test that mounts is always run", one.test(one.root / "scenarios/road.xodr", "-n", "a full disk")[1])
    check("a test reads what is not of the checkout", one.test("/etc/hostname" if os.path.exists("/etc/hostname") else "/etc/passwd") == (0, True))
    lump, reader = one.root / "scenarios/lump", [one.root / ".ci/verdict", f"--build={one.build}", "--seen=scenarios/lump", "--", "/bin/grep", "-q", "good"]
    lump.write_text("good")

    def read_again():
        said = subprocess.run([*reader, lump], env={"SEPTET_VERDICTS": str(one.home / "verdicts")}, capture_output=True, check=False)
        return said.returncode, b"Kept" not in said.stdout

    check("what is seen by another's eye is read once", [read_again(), read_again()] == [(0, True), (0, False)])
    lump.write_text("evil")
    check("what is seen by another's eye fails each time after a change", [read_again(), read_again()] == [(1, True), (1, True)])
    (one.home / "file").write_text("")
    for _ in range(2):
        check("where no verdict can be kept, each test runs", one.test(SEPTET_VERDICTS=str(one.home / "file/verdicts")) == (0, True))

with tempfile.TemporaryDirectory() as home:
    first, second = Checkout(pathlib.Path(home), "first"), Checkout(pathlib.Path(home), "second-clone")
    check("the first checkout runs the test", first.test() == (0, True))
    check("another checkout believes it", second.test() == (0, False))

print("\n".join(FAILED) or "Each change is seen.")
sys.exit(bool(FAILED))
