"""Opens an SQLite file that somebody else may have made: nothing in its folder is written, made or removed, and nothing that its schema
asks for is run (sqlite.org/security.html). As logging/session/files_beside.hpp and logging/session/untrusted_database.hpp do for the programs.
"""

import contextlib
import os
import shutil
import sqlite3
import stat
import struct
import tempfile
import zlib
from pathlib import Path

from septet_snapshot import SessionError

_JOURNAL_MAGIC = bytes.fromhex("d9d505f920a163d7")
_LARGEST_VALUE_BYTES = 512 << 20
_STEPS_BETWEEN_LOOKS = 100_000
_WAL_MAGICS = (b"\x37\x7f\x06\x82", b"\x37\x7f\x06\x83")
# Changes beside a session that are larger are not copied to be read (logging/session/files_beside.hpp).
MOST_COPIED_BYTES = 4 << 30
_ALLOWED_PRAGMAS = ("application_id", "user_version")
# Exceptions that a file's bytes can make Python, NumPy, pandas and zlib raise.
DAMAGE = (sqlite3.Error, sqlite3.Warning, ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError, TypeError, ValueError, struct.error,
          zlib.error, EOFError)


def _beside(path, ending):
    return path.with_name(path.name + ending)


def _found(path):
    """Its status, or nothing; an error where it is no file."""
    try:
        found = os.lstat(path)
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(found.st_mode):
        raise SessionError(f"{path}: the session's journal or WAL is not a regular file: delete it if nobody needs it")
    return found


def _has_hot_journal(path):
    """True if an interrupted change has to be rolled back. A journal may name a second file, which SQLite deletes."""
    journal = _beside(path, "-journal")
    found = _found(journal)
    if found is None or found.st_size == 0:
        return False
    with open(journal, "rb") as file:
        first = file.read(1)
        file.seek(max(found.st_size - 8, 0))
        if file.read(8) == _JOURNAL_MAGIC:
            raise SessionError(f"{journal}: this journal names another file, which would be deleted when the session is opened: it is not Septet's; "
                               "do not trust who sent it")
    return first != b"\0"


def _connect(path, options):
    uri = "file:" + path.as_posix().replace("%", "%25").replace("?", "%3f").replace("#", "%23") + options
    return sqlite3.connect(uri, uri=True)


def _is_wal(path):
    """True where SQLite would read commits from it."""
    with open(path, "rb") as file:
        first = file.read(4)
    return first in _WAL_MAGICS


def _of_copy(path):
    """A copy in a private folder, in which interrupted changes are rolled back and a killed drive's newest commits are folded in."""
    beside = sum(found.st_size for found in (_found(_beside(path, "-journal")), _found(_beside(path, "-wal"))) if found is not None)
    if beside > MOST_COPIED_BYTES:
        raise SessionError(f"{path}: beside the session lie {beside / 1e6:.0f} MB of changes that belong to it, too many to be copied: if you trust who sent "
                           "it, join them: sqlite3 FILE 'PRAGMA journal_mode=DELETE'")
    with tempfile.TemporaryDirectory(prefix="septet-read-") as folder:
        copy = Path(folder) / "copy.sqlite"
        for ending in ("-journal", "-wal", ""):
            if ending == "" or _found(_beside(path, ending)) is not None:
                shutil.copyfile(_beside(path, ending) if ending else path, _beside(copy, ending) if ending else copy)
        _has_hot_journal(copy)
        with contextlib.closing(_connect(copy, "?mode=rw")) as whole:
            whole.execute("PRAGMA trusted_schema=OFF")
            whole.execute("PRAGMA journal_mode=DELETE").fetchall()
            whole.execute("SELECT 1 FROM sqlite_schema LIMIT 1").fetchall()
        database = _connect(copy, "?immutable=1")
        database.execute("SELECT 1 FROM sqlite_schema LIMIT 1").fetchall()
        return database  # It keeps the file, whose folder goes now.


def _open(path):
    if _has_hot_journal(path):
        return _of_copy(path)
    wal, index = _found(_beside(path, "-wal")), _found(_beside(path, "-shm"))
    if wal is not None and index is not None:
        database = _connect(path, "?mode=ro&readonly_shm=1")
        try:
            database.execute("SELECT 1 FROM sqlite_schema LIMIT 1").fetchall()
            return database
        except sqlite3.Error:
            database.close()
            return _of_copy(path)
    if wal is not None and _is_wal(_beside(path, "-wal")):
        return _of_copy(path)
    with open(path, "rb") as file:
        header = file.read(20)
    return _connect(path, "?immutable=1" if wal is not None or 2 in header[18:20] else "?mode=ro")


def _may(action, first, second, _database, view):
    if view is not None:
        return sqlite3.SQLITE_DENY
    if action in (sqlite3.SQLITE_SELECT, sqlite3.SQLITE_READ):
        return sqlite3.SQLITE_OK
    if action == sqlite3.SQLITE_PRAGMA and first in _ALLOWED_PRAGMAS and second is None:
        return sqlite3.SQLITE_OK
    return sqlite3.SQLITE_DENY


class UntrustedDatabase:
    """A read-only connection with bounded queries."""

    def __init__(self, path):
        self.path = path
        if not path.is_file():
            raise SessionError(f"{path}: there is no such file; a drive writes session.sqlite into its --out folder")
        # SQLite deletes the files beside an empty file.
        if path.stat().st_size == 0:
            raise SessionError(f"{path}: not a session file (it is empty)")
        try:
            self._database = _open(path.resolve())
            for pragma in ("trusted_schema=OFF", "cell_size_check=ON", "query_only=ON"):
                self._database.execute("PRAGMA " + pragma).fetchall()
            if hasattr(self._database, "setlimit"):  # From Python 3.11 on.
                for what, most in ((sqlite3.SQLITE_LIMIT_LENGTH, _LARGEST_VALUE_BYTES), (sqlite3.SQLITE_LIMIT_SQL_LENGTH, 100_000),
                                   (sqlite3.SQLITE_LIMIT_COLUMN, 200), (sqlite3.SQLITE_LIMIT_EXPR_DEPTH, 100),
                                   (sqlite3.SQLITE_LIMIT_COMPOUND_SELECT, 10), (sqlite3.SQLITE_LIMIT_ATTACHED, 0)):
                    self._database.setlimit(what, most)
        except (sqlite3.Error, OSError, MemoryError) as error:
            raise SessionError(f"{path}: not a session file ({error})") from error
        self._steps_left = 0
        self._steps = max(50_000_000, 40 * path.stat().st_size)
        self._database.set_authorizer(_may)
        self._database.set_progress_handler(self._look, _STEPS_BETWEEN_LOOKS)

    def _look(self):
        self._steps_left -= _STEPS_BETWEEN_LOOKS
        return self._steps_left < 0

    def close(self):
        self._database.close()

    def ask(self, sql, *values):
        """A cursor; the limit restarts here."""
        self._steps_left = self._steps
        return self._database.execute(sql, values)
