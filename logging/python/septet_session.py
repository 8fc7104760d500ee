"""Reads a Septet session file (logging/FORMAT.md) into pandas frames.

    import septet_session
    session = septet_session.open("out/session.sqlite")
    session.samples                      # ten rows a second, as in FORMAT.md
    session.participants(every=12)       # all participants, every 12th tick
    session.driver_car()                 # the driver's car, every tick

Units stand in the columns' names; positions are of the middle of the rear axle on the ground, world frame: x east, y north,
z up. A session whose writer was killed, or is still writing, opens as well. The file may be of unknown origin: nothing beside it is changed,
and any fault of it is a SessionError.
"""

import contextlib
import functools
import json
import re
from pathlib import Path

import numpy as np
import pandas

# noqa: F401
from septet_snapshot import DIAGNOSTICS, DRIVER_CAR, ENVIRONMENT, FIELDS, LAMPS, SessionError, motion_of, unpack
from septet_untrusted import DAMAGE, UntrustedDatabase

APPLICATION_ID = 0x53535444
FORMAT_VERSION = 3
_FIRST_SOLID = 32768
_TEXTS = ("role", "name", "kind", "detail", "item", "question", "answer", "reason")


@contextlib.contextmanager
def _names(session):
    """Turns any exception from the file's bytes into an error about the file."""
    try:
        yield
    except SessionError as error:
        if str(error).startswith(str(session.path)):
            raise
        raise SessionError(f"{session.path}: {error}") from error
    except DAMAGE as error:
        raise SessionError(f"{session.path}: the session is damaged or was altered ({type(error).__name__}: {str(error)[:200]}): "
                           "use an unaltered copy") from error


def _told(method):
    @functools.wraps(method)
    def call(self, *arguments, **named):
        with _names(self):
            return method(self, *arguments, **named)
    return call


class Session:
    """One drive. Frames are read when they are asked for; nothing is kept."""

    def __init__(self, path):
        self.path = Path(path)
        with _names(self):
            self._database = UntrustedDatabase(self.path)
            try:
                self._check()
            except BaseException:
                self.close()
                raise

    def _check(self):
        (application,) = self._database.ask("PRAGMA application_id").fetchone()
        (version,) = self._database.ask("PRAGMA user_version").fetchone()
        if application != APPLICATION_ID:
            raise SessionError(f"{self.path}: not a session of Septet (application id {application})")
        if not 1 <= version <= FORMAT_VERSION:
            raise SessionError(f"{self.path}: format {version}; this reader knows format {FORMAT_VERSION}: take the one beside the Septet that drove")
        for kind, name in self._database.ask("SELECT type, name FROM sqlite_schema"):
            if kind == "trigger":
                raise SessionError(f"{self.path}: the session holds a trigger, which none of Septet's does: use an unaltered session file")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._database.close()

    def _has_table(self, name):
        kinds = [kind for (kind,) in self._database.ask("SELECT type FROM sqlite_schema WHERE name = ? COLLATE NOCASE", name)]
        if kinds not in ([], ["table"]):
            raise SessionError(f"{self.path}: {name} is no table but {', '.join(map(str, kinds))}: use an unaltered session file")
        return bool(kinds)

    def _rows(self, columns, name, rest=""):
        if not self._has_table(name):
            raise SessionError(f"{self.path}: the table {name} is missing: use an unaltered session file")
        return self._database.ask(f"SELECT {columns} FROM {name} {rest}")

    def _table(self, name):
        cursor = self._rows("*", name)
        columns = [column[0] for column in cursor.description]
        table = pandas.DataFrame(cursor.fetchall(), columns=columns)
        for column in columns:
            if column in _TEXTS or column == "report":
                continue
            if table[column].dtype == object:
                if not table[column].map(lambda value: value is None or isinstance(value, (int, float))).all():
                    raise SessionError(f"{self.path}: the column {column} of {name} has a value that is not a number: use an unaltered copy")
                table[column] = pandas.to_numeric(table[column])
        return table

    @property
    @_told
    def meta(self):
        """Key to value, as text: driver, seeds, end (FORMAT.md, `meta`)."""
        return dict(self._rows("key, value", "meta").fetchall())

    @property
    @_told
    def files(self):
        """(role, name) to content, of every file that the drive was made from."""
        return {(role, name): content for role, name, content in self._rows("role, name, content", "files")}

    @property
    @_told
    def has_snapshots(self):
        """False for a drive whose log kept samples alone."""
        return self._rows("1", "snapshots", "LIMIT 1").fetchone() is not None

    @_told
    def vehicle_models(self):
        """Models of participants, by index. Empty for sessions of earlier builds."""
        text = self.meta.get("vehicle_models")
        if text is None:
            raise SessionError(f"{self.path}: the session does not say what its vehicles are; it is of an earlier build: drive it again")
        models = json.loads(text)
        if not isinstance(models, list) or not all(isinstance(model, dict) for model in models):
            raise SessionError(f"{self.path}: its vehicle_models are not what Septet writes: use an unaltered session")
        return models

    @_told
    def who(self):
        """All participants: name, model, first and last time; one row a participant."""
        return self._who(_Seen().of(self.snapshots()))

    def _who(self, seen):
        names = self.names()
        models = self.vehicle_models() if "vehicle_models" in self.meta else []
        rows = []
        for number, (index, first_s, last_s) in sorted(seen.times.items()):
            model = models[index] if index < len(models) else {}
            rows.append((number, names.get(str(number), f"traffic {number}"), number == seen.driver, model.get("name", ""), model.get("kind", ""),
                         model.get("length_m"), model.get("width_m"), model.get("height_m"), first_s, last_s))
        return pandas.DataFrame(rows, columns=["participant", "name", "is_driver", "vehicle", "kind", "length_m", "width_m", "height_m",
                                               "first_seen_s", "last_seen_s"])

    @_told
    def names(self):
        """Names by the participant's number as text: of the scenario, and of things in whose place solids stand, the newest of a number."""
        names = json.loads(self.meta.get("participant_names", "{}"))
        if not isinstance(names, dict):
            raise SessionError(f"{self.path}: its participant_names are not what Septet writes: use an unaltered session")
        events = self.events
        told = (re.match(r'stand solid=(\d{1,4}) .*? name="([^"]*)"$', detail)
                for detail in events[events.kind == "operator_command"].detail if isinstance(detail, str))
        return names | {str(_FIRST_SOLID + int(found[1])): found[2] for found in told if found}

    @property
    @_told
    def samples(self):
        """Ten rows a second: position in the lane, headway, controls. `time_headway_s` is added, NaN at a standstill."""
        samples = self._table("samples")
        samples["time_headway_s"] = (samples["distance_headway_m"] / samples["speed_mps"]).where(samples["speed_mps"] > 0.1)
        return samples

    @property
    @_told
    def events(self):
        return self._table("events")

    @property
    @_told
    def questionnaire(self):
        return self._table("questionnaire")

    @property
    @_told
    def actuators(self):
        """Commands to fan, shaker and wheel force, ten rows a second; empty in sessions of earlier builds."""
        if self._has_table("actuators"):
            return self._table("actuators")
        return pandas.DataFrame(columns=["tick", "fan", "vibration", "vibration_hz", "steering", "is_cut"])

    @property
    @_told
    def driver_inputs(self):
        """The input of every tick, without the raw reports."""
        return self._table("driver_inputs").drop(columns="report")

    def snapshots(self):
        """Every tick in order, decoded. Raises SessionError where bytes are damaged."""
        with _names(self):
            before = None
            for tick, baseline, data in self._rows("tick, baseline_tick, data", "snapshots", "ORDER BY tick"):
                try:
                    before = unpack(data, before if baseline is not None else None)
                except (SessionError, *DAMAGE) as error:
                    raise SessionError(f"{self.path}: the snapshot of tick {tick} is damaged ({str(error)[:200]})") from error
                yield before

    @_told
    def participants(self, every=1):
        """Motion of all participants: one row a participant and tick, of every `every`-th tick."""
        return _participants(self._each(every))

    @_told
    def driver_car(self, every=1):
        """The driver's car as its instruments show it, and its faults so far; one row a tick."""
        return _driver_car(self._each(every))

    @_told
    def head(self, every=1):
        """Offset of the driver's eyes from the rig's eye point, and the pictures' turn to the left; one row a tick."""
        return _head(self._each(every))

    @_told
    def game(self, every=12):
        """Standing of a game, ten times a second by default; no row if the scenario is no game."""
        return _game(self._each(every))

    @_told
    def environment(self, every=120):
        """Weather and light, once a second by default."""
        return _environment(self._each(every))

    @_told
    def motion_tables(self, every=12):
        """All of these by name, and `who`, in one pass over the snapshots."""
        seen = _Seen()
        taken = [s for s in seen.passing(self.snapshots()) if s.tick % every == 0]
        return {"who": self._who(seen), "participants": _participants(taken), "driver_car": _driver_car(taken), "head": _head(taken),
                "environment": _environment(taken), "game": _game(taken)}

    def _each(self, every):
        return [s for s in self.snapshots() if s.tick % every == 0]


class _Seen:
    """Participants seen: id to model, first and last time."""

    def __init__(self):
        self.times, self.driver = {}, None

    def passing(self, snapshots):
        for s in snapshots:
            self.driver = s.car[0] if self.driver is None else self.driver
            for number, model in zip(s.ids.tolist(), s.fields[:, 0].tolist()):
                first = self.times.get(number)
                self.times[number] = (model, first[1] if first else s.time_s, s.time_s)
            yield s

    def of(self, snapshots):
        for _ in self.passing(snapshots):
            pass
        return self


def _participant_frame(ticks, times, ids, fields):
    return pandas.DataFrame({"tick": ticks, "simulated_time_s": times, "participant": ids} | motion_of(fields))


def _participants(taken):
    counts = [len(s.ids) for s in taken]
    if not taken:
        return _participant_frame([], [], [], np.empty((0, len(FIELDS)), np.int64))
    return _participant_frame(np.repeat([s.tick for s in taken], counts), np.repeat([s.time_s for s in taken], counts),
                              np.concatenate([s.ids for s in taken]), np.concatenate([s.fields for s in taken]))


def _frame_of(taken, columns, values):
    return pandas.DataFrame([(s.tick, s.time_s, *values(s)) for s in taken], columns=["tick", "simulated_time_s", *columns])


def _driver_car(taken):
    return _frame_of(taken, ["participant", "gear", "road", "lane", *DRIVER_CAR, *DIAGNOSTICS], lambda s: s.car)


def _head(taken):
    return _frame_of(taken, ["forward_m", "left_m", "up_m", "turn_rad"], lambda s: s.head)


def _game(taken):
    return _frame_of([s for s in taken if s.game is not None], ["level", "end", "points", "survived_s", "leader_m", "away_s"], lambda s: s.game)


def _environment(taken):
    return _frame_of(taken, ENVIRONMENT, lambda s: s.environment)


def open(path):  # pylint: disable=redefined-builtin
    """The session in a file, or a SessionError with its fault."""
    return Session(path)
