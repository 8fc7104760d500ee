"""Every command that reads a session, beside a watch on its folder: nothing there is written, made or removed.

    watched_commands.py SEPTET

The folder is watched by inotify and compared before and after by listing, size, time and bytes. It is as a drive leaves it, as a killed drive
leaves it (with and without the index of its newest commits), as a killed answer leaves it, read-only, and as somebody may have made it who wants
a file of the reader's deleted.
"""
import ctypes
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
IN_MODIFY, IN_ATTRIB, IN_MOVED, IN_CREATE, IN_DELETE = 0x2, 0x4, 0xC0, 0x100, 0x200
MAGIC = bytes.fromhex("d9d505f920a163d7")
septet = pathlib.Path(sys.argv[1])
python_reader = pathlib.Path(__file__).resolve().parents[2] / "logging" / "python"
libc = ctypes.CDLL(None, use_errno=True)


def written_bytes(path):
    """Contents of a file without its holes: (offset, bytes) of each extent."""
    extents = []
    with open(path, "rb") as file:
        end = 0
        while True:
            try:
                begin = os.lseek(file.fileno(), end, os.SEEK_DATA)
            except OSError:  # Nothing but a hole from here on.
                return extents
            end = os.lseek(file.fileno(), begin, os.SEEK_HOLE)
            extents.append((begin, os.pread(file.fileno(), end - begin, begin)))


class Watch:
    def __init__(self, folders):
        self.folders = folders
        self.inotify = libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        for folder in folders:
            assert libc.inotify_add_watch(self.inotify, os.fsencode(folder), IN_MODIFY | IN_ATTRIB | IN_MOVED | IN_CREATE | IN_DELETE) >= 0
        self.before = self.listing()

    def listing(self):
        return {str(path): (path.lstat().st_ino, path.lstat().st_size, path.lstat().st_mtime_ns, path.lstat().st_mode, written_bytes(path))
                for folder in self.folders for path in folder.iterdir() if path.is_file()}

    def changes(self):
        found, data = [], b""
        try:
            data = os.read(self.inotify, 1 << 20)
        except BlockingIOError:
            pass
        at = 0
        while at < len(data):
            _, mask, _, length = struct.unpack_from("iIII", data, at)
            file = data[at + 16:at + 16 + length].rstrip(bytes(1)).decode()
            # As root SQLite gives a WAL and its index, when it opens them, the owner that they have.
            if not (mask == IN_ATTRIB and file.endswith(("-wal", "-shm")) and os.geteuid() == 0):
                found.append(f"event {mask:#x} {file}")
            at += 16 + length
        os.close(self.inotify)
        after = self.listing()
        found += [f"{name} differs" for name in sorted(self.before.keys() | after.keys()) if self.before.get(name) != after.get(name)]
        return found


def killed_with(session, sql):
    """A program that writes the session and is killed in the middle of it."""
    program = ("import os, sqlite3, sys\nd = sqlite3.connect(sys.argv[1], isolation_level=None)\n"
               f"for sql in {sql!r}: d.execute(sql).fetchall()\nos.kill(os.getpid(), 9)")
    assert subprocess.run([sys.executable, "-c", program, str(session)], check=False).returncode == -signal.SIGKILL


def still_written(session):
    """A program that has committed and has the session open."""
    program = ("import sqlite3, sys\nd = sqlite3.connect(sys.argv[1], isolation_level=None)\n"
               "d.execute('PRAGMA journal_mode=WAL').fetchall()\nd.execute(\"INSERT INTO meta VALUES('later', '1')\")\n"
               "print('written', flush=True)\nsys.stdin.read()")
    writer = subprocess.Popen([sys.executable, "-c", program, str(session)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert writer.stdout.readline() == "written\n"
    return writer


def super_journal(session, victim):
    name = str(victim).encode()
    total = sum(byte - 256 if byte > 127 else byte for byte in name) & 0xFFFFFFFF
    head = (MAGIC + struct.pack(">IIIII", 0, 0x1234, session.stat().st_size // 16384, 512, 16384)).ljust(512, b"\0")
    pathlib.Path(f"{session}-journal").write_bytes(head + struct.pack(">I", 0x40000000 // 16384 + 1) + name + struct.pack(">II", len(name), total) + MAGIC)


def operate(session, _out):
    """The operator's page lists the sessions below its folder when it starts."""
    process = subprocess.Popen([septet, "operate", "--page", "0", "--out", session.parent.parent], stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        for line in process.stdout:
            if "http" in line:
                break
        time.sleep(1.5)
    finally:
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
    return 0


def file_of_holes(path, begin):
    """Larger than what is copied to be read, and takes no room."""
    with open(path, "wb") as file:
        file.write(begin)
        file.truncate(5 << 30)


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, stdin=subprocess.DEVNULL, timeout=600, check=False).returncode


read_in_python = ("import sys; sys.dont_write_bytecode = True; sys.path.insert(0, sys.argv[2]); import septet_session\n"
                  "with septet_session.open(sys.argv[1]) as s: s.samples, s.motion_tables(12)")
COMMANDS = {
    "verify": lambda session, out: run(septet, "replay", "--verify", session),
    "check": lambda session, out: run(septet, "check", session),
    "report": lambda session, out: run(septet, "report", session, "--out", out / "report.html"),
    "pooled report": lambda session, out: run(septet, "report", session.parent, session.parent, "--out", out / "pooled"),
    "sound": lambda session, out: run(septet, "sound", session, "--out", out / "drive.wav"),
    "film": lambda session, out: run(septet, "film", session, "--size", "64x36", "--fps", "1", "--out", out / "film"),
    "forget somebody else": lambda session, out: run(septet, "session", "forget", "nobody", session.parent) == 1 and 0,
    "Python": lambda session, out: run("/usr/bin/python3", "-c", read_in_python, session, python_reader),
    "operate": operate,
}
only = sys.argv[2:] or list(COMMANDS)

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    assert run(septet, "drive", "--no-screens", "--driver", "plain", "--seconds", "1.1", "--participant", "P07", "--out", folder / "good") == 0
    assert (folder / "good" / "session.sqlite").stat().st_mode & 0o777 == 0o600, "others may read who drove"
    assert (folder / "good" / "summary.json").stat().st_mode & 0o777 == 0o600 and (folder / "good").stat().st_mode & 0o777 == 0o700
    own = folder / "own"
    own.mkdir()
    bad = 0

    def look_at(kind, make, is_read):
        global bad
        sent = folder / kind.replace(" ", "-")
        for command in only:
            sessions = sent / "drive"
            shutil.rmtree(sent, ignore_errors=True)
            sessions.mkdir(parents=True)
            session = sessions / "session.sqlite"
            shutil.copyfile(folder / "good" / "session.sqlite", session)
            (own / "thesis.txt").write_text("years of work")
            make(session)
            out = folder / "results"
            shutil.rmtree(out, ignore_errors=True)
            out.mkdir()
            writer = still_written(session) if kind == "a drive that goes on" else None
            watch = Watch([own, sessions])
            status = COMMANDS[command](session, out)
            changes = watch.changes()
            sessions.chmod(0o700)
            if writer:
                writer.communicate("end", timeout=60)
            if changes or (is_read and status != 0):
                bad += 1
                print(f"{kind}: {command} ends with {status}; {changes}")

    commits = ["PRAGMA journal_mode=WAL", "INSERT INTO meta VALUES('later', '1')", "UPDATE meta SET value = '2' WHERE key = 'later'"]
    undone = ["PRAGMA cache_size=1", "BEGIN IMMEDIATE", "UPDATE meta SET value = 'half' WHERE key = 'participant'", "DELETE FROM samples",
              "UPDATE snapshots SET data = x'00' WHERE tick < 100"]
    look_at("a drive", lambda session: None, True)
    look_at("a drive that goes on", lambda session: None, True)
    look_at("a killed drive", lambda session: killed_with(session, commits), True)
    look_at("a killed drive without its index", lambda session: (killed_with(session, commits), pathlib.Path(f"{session}-shm").unlink()), True)
    look_at("a killed answer", lambda session: killed_with(session, undone), True)
    look_at("a read-only folder", lambda session: (session.chmod(0o400), session.parent.chmod(0o500)), True)
    look_at("a super-journal", lambda session: super_journal(session, own / "thesis.txt"), False)
    look_at("a super-journal beside newest commits", lambda session: (killed_with(session, commits), super_journal(session, own / "thesis.txt")), False)
    look_at("no WAL where one would lie", lambda session: file_of_holes(f"{session}-wal", b"nothing"), True)
    look_at("a WAL of holes", lambda session: file_of_holes(f"{session}-wal", b"\x37\x7f\x06\x83"), False)
    sys.exit(1 if bad else 0)
