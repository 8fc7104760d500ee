"""Change and watch the world of a running Septet drive.

    import septet
    with septet.connect("10.7.0.1", 4750, "keys/lab/lab.key") as world:
        ball = world.add("stimuli/ball", "ball.glb", position=(10, 0, 0))
        for tick in world.ticks():
            ball.position = (10 + tick.time_s, 0, 0)

Standard library alone. Names, units and lines: README.md beside this file. The program `septet edit` is the transport.
"""

from __future__ import annotations

import asyncio
import collections
import dataclasses
import json
import math
import os
import pathlib
import queue
import shutil
import subprocess
import tempfile
import threading
import traceback
from concurrent.futures import Future
from typing import Any, AsyncIterator, Callable, Iterable, Iterator, NamedTuple, Optional, Sequence, Union

__all__ = ["connect", "World", "Handle", "Batch", "Tick", "Event", "Call", "Car", "Participant", "Refused", "Failure", "Ended"]

Vector = Sequence[float]
Path = Union[str, "os.PathLike[str]"]
MOST_TICKS_KEPT = 1200
"""Ticks that wait for a script that is slow; older ones are dropped and counted."""
MOST_EVENTS_KEPT = 10_000
"""Events that wait with them; older ones are dropped and counted."""


Solid = Union[bool, float]
Parent = Union[int, str, "Participant", "Car", "Handle"]
"""A participant, by its number, the scenario's name or as a tick has it; or a thing."""


class _Done(NamedTuple):
    """Of a request: the first tick that shows it, and what is said of it."""

    tick: int
    messages: list[str]


@dataclasses.dataclass(frozen=True)
class Failure:
    """A change that could not be done. `index`: its place in the batch, from 1; `node` is empty where it is about no thing."""

    index: int
    command: str
    node: str
    why: str


class Refused(Exception):
    """Nothing of a change, or of a batch, was done.

    `failures` has each change that could not be done, in their order, the first 16 at most; `others` counts the rest. What failed only
    because an earlier change did is left out, or says so. `why`, `line` and `text` are the first one's.
    """

    def __init__(self, failures: Sequence[Failure], others: int = 0) -> None:
        told = [f"{one.why} (change {one.index}: {one.command})" for one in failures]
        super().__init__("\n".join(told + ([f"and {others} more"] if others else [])))
        self.failures, self.others = list(failures), others
        self.why, self.line, self.text = failures[0].why, failures[0].index, failures[0].command


class Ended(Exception):
    """The drive has ended, or its server is gone."""


@dataclasses.dataclass(frozen=True)
class Participant:
    """Anybody in traffic at one tick. Metres, metres a second; `wxyz` is a unit quaternion."""

    id: int
    model: str
    position: tuple[float, float, float]
    wxyz: tuple[float, float, float, float]
    velocity: tuple[float, float, float]

    @property
    def heading_deg(self) -> float:
        w, x, y, z = self.wxyz
        return math.degrees(math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))

    @property
    def speed_mps(self) -> float:
        return math.hypot(*self.velocity)

    def ahead(self, metres: float, left: float = 0.0) -> tuple[float, float, float]:
        """The place so far ahead of it and to its left, at its height."""
        angle = math.radians(self.heading_deg)
        x, y, z = self.position
        return (x + metres * math.cos(angle) - left * math.sin(angle), y + metres * math.sin(angle) + left * math.cos(angle), z)

    def distance_m(self, place: Vector) -> float:
        return math.dist(self.position, tuple(place))


@dataclasses.dataclass(frozen=True)
class Car:
    """The driver's car at one tick, beyond what it is as a participant (logging/FORMAT.md has the same words)."""

    id: int
    speed_mps: float
    gear: int
    steering_wheel_rad: float
    accelerator: float
    brake: float
    clutch: float
    yaw_rate_radps: float
    gaze_heading_rad: float
    road: int
    lane: int
    road_s_m: float
    lateral_position_m: float
    lane_width_m: float


@dataclasses.dataclass(frozen=True)
class Event:
    """Something that happened, as the log has it: "collision", "lane_change", "mark", "scenario", ... (logging/FORMAT.md).

    `fields` are its values as text; `participant` is whom it happened to, if anybody.
    """

    tick: int
    time_s: float
    name: str
    participant: Optional[int]
    fields: dict[str, str]


@dataclasses.dataclass(frozen=True)
class Call:
    """A message from the storyboard, the operator's page or a script to all who listen; those do what it asks for.

    `node` is the name of the thing that it is about, if any; `parameters` are texts; `by` says who calls: a key's or an operator's
    name, or "storyboard".
    """

    name: str
    node: Optional[str]
    parameters: dict[str, str]
    by: str
    tick: int
    time_s: float


def _call(event: Event) -> Call:
    words = dict(event.fields)
    name, node, by = words.pop("name"), words.pop("node", None), words.pop("by", "")
    return Call(name, node, words, by, event.tick, event.time_s)


@dataclasses.dataclass(frozen=True)
class Tick:
    tick: int
    time_s: float
    car: Car
    everybody: tuple[Participant, ...]
    collisions: int
    rain_mm_per_h: float
    visibility_m: float
    events: tuple[Event, ...] = ()
    """What has happened since the tick before this one that the script was given; an event has its own tick."""
    dropped_events: int = 0
    """Events of that time that were lost because somebody was too slow."""

    @property
    def calls(self) -> tuple[Call, ...]:
        """Those of its events that are calls."""
        return tuple(_call(event) for event in self.events if event.name == "call")

    @property
    def driver(self) -> Participant:
        """The driver's car as a participant."""
        return next(one for one in self.everybody if one.id == self.car.id)

    def participant(self, number: Optional[int]) -> Optional[Participant]:
        return next((one for one in self.everybody if one.id == number), None)


def _tick(row: dict[str, Any]) -> Tick:
    everybody = tuple(
        Participant(one["id"], one["model"], tuple(one["position"]), tuple(one["wxyz"]), tuple(one["velocity"]))
        for one in row["everybody"]
    )
    events = tuple(Event(**one) for one in row["events"])
    return Tick(
        row["tick"], row["time_s"], Car(**row["car"]), everybody, row["collisions"], row["rain_mm_per_h"], row["visibility_m"],
        events, row["dropped_events"],
    )


def _joined(earlier: Optional[Tick], later: Tick) -> Tick:
    """The later tick, with the events of both."""
    if earlier is None or not (earlier.events or earlier.dropped_events):
        return later
    events = earlier.events + later.events
    over = max(0, len(events) - MOST_EVENTS_KEPT)
    return dataclasses.replace(later, events=events[over:], dropped_events=earlier.dropped_events + later.dropped_events + over)


class _Every:
    """Of ticks, some of which are missed, one for each multiple of n: it, or the first that comes after it."""

    def __init__(self, every: int) -> None:
        self._every = every
        self._due: Optional[int] = None

    def takes(self, tick: int) -> bool:
        if self._due is None:
            self._due = -(-tick // self._every) * self._every
        if tick < self._due:
            return False
        self._due = (tick // self._every + 1) * self._every
        return True


class _Backlog:
    """Ticks that wait for one loop, the newest `MOST_TICKS_KEPT`."""

    def __init__(self) -> None:
        self.ticks: collections.deque[Tick] = collections.deque()

    def keep(self, tick: Tick) -> int:
        """Returns how many are dropped; their events go to the next."""
        self.ticks.append(tick)
        if len(self.ticks) <= MOST_TICKS_KEPT:
            return 0
        self.ticks[1] = _joined(self.ticks[0], self.ticks[1])
        self.ticks.popleft()
        return 1


def _word(text: str) -> str:
    """The text as one quoted word of a line."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\x{ord(c):02x}" for c in escaped) + '"'


def _who(participant: Parent) -> str:
    if isinstance(participant, Handle):
        return participant.node
    return _word(participant) if isinstance(participant, str) else str(participant if isinstance(participant, int) else participant.id)


def _numbers(values: Vector) -> str:
    return " ".join(repr(float(value)) for value in values)


def _turned(heading_deg: float) -> tuple[float, float, float, float]:
    half = math.radians(heading_deg) / 2
    return (math.cos(half), 0.0, 0.0, math.sin(half))


def _solid(value: Solid) -> str:
    """What stands behind `solid NODE`."""
    return {True: "", False: " off"}[value] if isinstance(value, bool) else f" {float(value)!r}"


def _leg(velocity: Vector, acceleration: Vector = (0, 0, 0), turn_degps: float = 0.0) -> str:
    if (len(velocity), len(acceleration)) != (3, 3):
        raise ValueError("a velocity and an acceleration are x, y, z")
    return _numbers((*velocity, *acceleration, turn_degps))


class Handle:
    """An object of the world. Assigning a property is the change."""

    def __init__(self, world: World, node: str, name: str, position: Vector, wxyz: Vector, scale: Vector, visible: bool) -> None:
        self._world, self.node, self.name = world, node, name
        """`node` is its word in a line; `name` is as events and calls name it: #NUMBER where it has no name of its own."""
        self._position, self._wxyz, self._scale, self._visible = tuple(position), tuple(wxyz), tuple(scale), visible
        self._solid: Solid = False
        self.messages: list[str] = []
        """What add() has said of its file: the size by axes, and a sentence for each thing that is left out. In a batch: Batch.messages."""

    def __repr__(self) -> str:
        return f"<septet.Handle {self.node} at {self._position}>"

    def _transform(self, position: Vector, wxyz: Vector, scale: Vector) -> None:
        position, wxyz, scale = tuple(map(float, position)), tuple(map(float, wxyz)), tuple(map(float, scale))
        if (len(position), len(wxyz), len(scale)) != (3, 4, 3):
            raise ValueError("a position is x, y, z, a rotation w, x, y, z, a scale x, y, z")
        self._world._change(f"move {self.node} {_numbers(position)} {_numbers(wxyz)} {_numbers(scale)}")
        self._position, self._wxyz, self._scale = position, wxyz, scale

    def go(self, velocity: Vector, acceleration: Vector = (0, 0, 0), turn_degps: float = 0.0, then: Iterable[tuple[Any, ...]] = ()) -> None:
        """In motion from where it is, m/s, m/s² and degrees a second about the vertical, until a position is assigned.

        `then` holds later legs, each (seconds after the beginning, velocity[, acceleration[, turn_degps]]).
        """
        line = f"go {self.node} {_leg(velocity, acceleration, turn_degps)}"
        for after_s, *leg in then:
            line += f" then {float(after_s)!r} {_leg(*leg)}"
        self._world._change(line)

    @property
    def position(self) -> tuple[float, ...]:
        return self._position

    @position.setter
    def position(self, value: Vector) -> None:
        self._transform(value, self._wxyz, self._scale)

    @property
    def wxyz(self) -> tuple[float, ...]:
        return self._wxyz

    @wxyz.setter
    def wxyz(self, value: Vector) -> None:
        self._transform(self._position, value, self._scale)

    @property
    def scale(self) -> tuple[float, ...]:
        return self._scale

    @scale.setter
    def scale(self, value: Union[float, Vector]) -> None:
        three = (value,) * 3 if isinstance(value, (int, float)) else value
        self._transform(self._position, self._wxyz, three)

    def turn_to(self, heading_deg: float) -> None:
        """Upright, its x axis in this direction, counter-clockwise from the world's x."""
        self.wxyz = _turned(heading_deg)

    @property
    def visible(self) -> bool:
        return self._visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._world._change(f"{'show' if value else 'hide'} {self.node}")
        self._visible = bool(value)

    @property
    def solid(self) -> Solid:
        """True once this script has made it so: an upright box around it is hit, stands fast and follows go() whatever it meets.

        A number is its mass in kg, from 0.1 to 20000: it is then pushed, and the first push ends what go() has begun.
        """
        return self._solid

    @solid.setter
    def solid(self, value: Solid) -> None:
        self._world._change(f"solid {self.node}{_solid(value)}")
        self._solid = value

    def show_text(self, text: str) -> None:
        """Black letters on white in the place of its first material: for boards and signs."""
        self._world._change(f"text {self.node} {_word(text)}")

    def show_picture(self, picture: Union[Path, bytes]) -> None:
        """A PNG file, or its bytes, in the place of its first material."""
        self._world._change(f"picture {self.node} {_word(self._world._file(picture, '.png'))}")

    def paint(self, red: float, green: float, blue: float) -> None:
        """One colour, each part from 0 to 1 as in pictures, in the place of all its materials."""
        self._world._change(f"color {self.node} {_numbers((red, green, blue))}")

    def hang_on(self, parent: Parent) -> None:
        """On another thing, or on one vehicle: its position is then in that one's frame, a vehicle's x forward, y left, z up from the
        ground below the rear axle."""
        self._world._change(f"hang {self.node} {_who(parent)}")

    def remove(self) -> None:
        self._world._change(f"remove {self.node}")

    def export(self, file: Path) -> None:
        """Writes it, with all that hangs below it, as a glTF file (.glb) around its own origin."""
        self._world._ask([f"export {self.node} {_word(os.path.abspath(file))}"]).result(60.0)


class Batch:
    """Changes that are made together, whole or not at all: one tick shows them first."""

    def __init__(self, world: World, at_tick: Optional[int]) -> None:
        self._world, self._at_tick, self._lines = world, at_tick, []  # type: World, Optional[int], list[str]
        self._answer: Optional[Future[_Done]] = None

    def __enter__(self) -> Batch:
        if self._world._batch is not None:
            raise RuntimeError("a batch within a batch")
        self._world._batch = self._lines
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        self._world._batch = None
        if kind is not None or not self._lines:
            return
        begin = "begin" if self._at_tick is None else f"begin at {self._at_tick}"
        self._answer = self._world._ask([begin, *self._lines, "commit"])
        if self._at_tick is None:
            self.result()

    def result(self, timeout_s: float = 60.0) -> int:
        """The first tick that shows them; waits for it. Raises Refused."""
        return self._done(timeout_s).tick

    @property
    def messages(self) -> list[str]:
        """What is said of the files that it has added, in their order, as of Handle.messages. Waits as result() does."""
        return self._done(60.0).messages

    def _done(self, timeout_s: float) -> _Done:
        if self._answer is None:
            raise RuntimeError("the batch is empty, or not closed yet")
        return self._answer.result(timeout_s)


class World:
    """A connection to a running drive; `connect` makes it. Threads may share it: each has batches of its own."""

    def __init__(self, command: list[str]) -> None:
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, encoding="utf-8")
        self._batches = threading.local()
        self._asked: dict[int, Future[Any]] = {}
        self._requests = 0
        self._news = threading.Condition()
        self._writing = threading.Lock()  # Held while a pipe may be full; the thread that empties the other one needs `_news` alone.
        self._waiting = _Backlog()  # For the loop that begins next, as long as there is no loop.
        self._loops: list[_Backlog] = []
        self._stepped: Optional[Tick] = None
        self._handlers: dict[str, list[Callable[..., Any]]] = {"tick": [], "end": [], "message": []}
        self._call_handlers: list[tuple[Optional[str], Optional[str], Callable[[Call], Any]]] = []
        self._calls: Optional[queue.SimpleQueue[Optional[Call]]] = None
        self._caller: Optional[threading.Thread] = None
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        self._files = 0
        self._tells_ticks = False
        self.hello: dict[str, Any] = {}
        self.newest: Optional[Tick] = None
        """The newest tick, once ticks are asked for."""
        self.missed_ticks = 0
        self.why_ended: Optional[str] = None
        self._errors: list[str] = []
        self._error_reader = threading.Thread(target=self._read_errors, daemon=True)
        self._error_reader.start()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    # ---- changes

    def add(
        self,
        name: str,
        glb: Optional[Path] = None,
        position: Vector = (0, 0, 0),
        heading_deg: float = 0.0,
        watch: bool = False,
        lifetime_s: Optional[float] = None,
        parent: Optional[Parent] = None,
        solid: Solid = False,
    ) -> Handle:
        """A thing of your own: a .glb file, or nothing yet. One that was added under this name before is replaced.

        `watch`: the file is read again each time when it was saved, as long as this connection stands; nothing is replaced.
        `lifetime_s`: it is removed so many seconds of drive time after the tick that shows it first, also when this script has ended.
        `parent`: what it hangs on from the first, as of Handle.hang_on; `position` is in that one's frame.
        `solid`: it can be hit from the first tick that shows it, as of Handle.solid; a number is its mass in kg.
        """
        if watch and (lifetime_s is not None or parent is not None or solid is not False):
            raise ValueError("a file that is watched has no lifetime, is hung on something by hang_on and made solid by Handle.solid")
        at = f"{_numbers(position)} {float(heading_deg)!r}"
        what = f"create {_word(name)} {at}" if glb is None else f"{'watch' if watch else 'import'} {_word(name)} {_word(os.path.abspath(glb))} {at}"
        return self._made(name, what, position, heading_deg, lifetime_s, parent, solid)

    def board(
        self,
        name: str,
        width_m: float,
        height_m: float,
        position: Vector = (0, 0, 0),
        heading_deg: float = 0.0,
        lifetime_s: Optional[float] = None,
        parent: Optional[Parent] = None,
        solid: Solid = False,
    ) -> Handle:
        """A board for text and pictures; who stands on its +x side, `heading_deg`, reads it. `lifetime_s`, `parent` and `solid` as of add."""
        what = f"board {_word(name)} {_numbers((width_m, height_m))} {_numbers(position)} {float(heading_deg)!r}"
        return self._made(name, what, position, heading_deg, lifetime_s, parent, solid)

    def repaint(self, participant: Union[int, str, "Participant", "Car"], red: float, green: float, blue: float) -> None:
        """The paint of one participant, each part from 0 to 1 as in pictures."""
        self._change(f"repaint {_who(participant)} {_numbers((red, green, blue))}")

    def find(self, pattern: str = "*", near: Optional[tuple[float, float, float]] = None) -> list[Handle]:
        """Objects whose names match (* and ?), `near` (x, y, metres); a thousand at most."""
        line = f"find {_word(pattern)}" + ("" if near is None else f" near {_numbers(near)}")
        return [self._found(one) for one in self._ask([line]).result(60.0) if "position" in one]

    def get(self, name: str) -> Handle:
        """The object of this name. Raises KeyError."""
        for one in self._ask([f"find {_word(name)}"]).result(60.0):
            if one["name"] == name:
                return self._found(one)
        raise KeyError(name)

    def batch(self, at_tick: Optional[int] = None) -> Batch:
        """`with world.batch():` makes the changes within together; with a tick, from that one on, and waits for no answer."""
        return Batch(self, at_tick)

    def undo(self) -> int:
        """Takes back this key's newest batch that is not undone, of an earlier connection too; the first tick that shows it.

        Raises Refused where there is none, or somebody else has changed one of its things since. Handles do not notice it.
        """
        return int(self._ask(["undo"]).result(60.0).tick)

    def save(self, file: Path) -> None:
        """Writes what differs from the world as it was when this script came, for `septet drive --edits`."""
        self._ask([f"save {_word(os.path.abspath(file))}"]).result(60.0)

    # ---- the drive

    def operate(self, line: str) -> int:
        """A line of an operator's, as docs/editing.md has them; the tick after which it was done."""
        if "\n" in line:
            raise ValueError("a line has no end within")
        return int(self._ask([f"operate {line}"]).result(60.0).tick)

    def call(self, name: str, node: Optional[Union["Handle", str]] = None, **parameters: Any) -> int:
        """One message to all who listen to the drive, about a thing or none: call("lift", node="stimuli/barrier", seconds=3).

        Logged with the tick after which it was made, which is returned. Parameters are sent as texts.
        """
        about = "none" if node is None else node.node if isinstance(node, Handle) else _word(node)
        words = [_word(f"{key}={value}") for key, value in parameters.items()]
        return int(self._ask([" ".join(["call", about, _word(name), *words])]).result(60.0).tick)

    def mark(self, text: str) -> int:
        """A mark in the log, at this tick."""
        return self.operate(f"mark {text}")

    def conditions(self, **values: float) -> int:
        """Weather, light and grip: conditions(rain_mm_per_h=20, road_wetness=0.6)."""
        return self.operate("conditions " + " ".join(f"{name}={float(value)!r}" for name, value in values.items()))

    def trigger(self, element: str) -> int:
        """An act or event of the storyboard begins now, Story::Act or longer."""
        return self.operate(f"trigger element={element}")

    def pause(self) -> int:
        """The world stands still until go_on, or this connection's end."""
        tick = self.operate("pause")
        with self._news:
            self._stepped = None
        return tick

    def go_on(self) -> int:
        return self.operate("go_on")

    def step(self, ticks: int = 1, timeout_s: float = 60.0) -> Tick:
        """So many ticks, then the world stands still; returns the last of them, with the events since the last step or pause."""
        self._want_ticks()
        last = self.operate(f"step {int(ticks)}") + int(ticks)
        with self._news:
            self._news.wait_for(lambda: (self.newest is not None and self.newest.tick >= last) or self.why_ended is not None, timeout_s)
            if self.newest is None or self.newest.tick < last:
                raise Ended(self.why_ended or "the ticks do not come")
            stepped, self._stepped = self._stepped, None
            return stepped or dataclasses.replace(self.newest, events=(), dropped_events=0)

    @property
    def participants(self) -> dict[str, int]:
        """Numbers by the scenario's names: tick.participant(world.participants["ambulance"])."""
        return {str(name): int(number) for name, number in self.hello["participants"].items()}

    # ---- ticks

    def ticks(self, every: int = 1) -> Iterator[Tick]:
        """Each tick as it comes, or every n-th, until the drive ends. For one that was missed the next that comes stands in, and has its events.

        Loops beside each other each have all ticks from their beginning on."""
        backlog = self._begin_loop()
        try:
            chosen, passed = _Every(every), None  # type: _Every, Optional[Tick]
            while (tick := self._next_tick(backlog)) is not None:
                tick = _joined(passed, tick)
                passed = None if (taken := chosen.takes(tick.tick)) else tick
                if taken:
                    yield tick
        finally:
            self._end_loop(backlog)

    async def aticks(self, every: int = 1) -> AsyncIterator[Tick]:
        """The same for asyncio."""
        backlog = self._begin_loop()
        try:
            chosen, passed = _Every(every), None  # type: _Every, Optional[Tick]
            while (tick := await asyncio.get_running_loop().run_in_executor(None, self._next_tick, backlog)) is not None:
                tick = _joined(passed, tick)
                passed = None if (taken := chosen.takes(tick.tick)) else tick
                if taken:
                    yield tick
        finally:
            self._end_loop(backlog)

    def on(self, what: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
        """`@world.on("tick")`, "end", "message": called in the connection's own thread; such a handler must not change the world. What one raises is printed."""
        def register(handler: Callable[..., Any]) -> Callable[..., Any]:
            self._handlers[what].append(handler)
            if what == "tick":
                self._want_ticks()
            return handler
        return register

    def on_call(self, name: Optional[str] = None, node: Optional[Union["Handle", str]] = None) -> Callable[[Callable[[Call], Any]], Callable[[Call], Any]]:
        """`@world.on_call("lift", node=barrier)`: each call of this name about this thing; without them, of any name, about anything.

        Such handlers run in a thread of their own, one after another, and may change the world and call. What one raises is printed.
        """
        about = node.name if isinstance(node, Handle) else node
        def register(handler: Callable[[Call], Any]) -> Callable[[Call], Any]:
            self._want_ticks()
            with self._news:
                if self._calls is None:
                    self._calls = queue.SimpleQueue()
                    self._caller = threading.Thread(target=self._hear_calls, args=(self._calls,), daemon=True)
                    self._caller.start()
                self._call_handlers.append((name, about, handler))
            return handler
        return register

    # ---- life

    def __enter__(self) -> World:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def close(self) -> None:
        """Waits until the calls that were heard are handled and all that was asked for is answered, and leaves. What was made stays
        until the drive ends."""
        if self._calls is not None and self._caller is not None and self._caller is not threading.current_thread():
            self._calls.put(None)
            self._caller.join(60.0)
        if self._process.stdin and not self._process.stdin.closed:
            try:
                self._process.stdin.close()
            except OSError:
                pass
        try:
            self._process.wait(60.0)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._reader.join(10.0)
        if self._folder:
            self._folder.cleanup()

    # ---- within

    @property
    def _batch(self) -> Optional[list[str]]:
        """Lines of this thread's batch."""
        return getattr(self._batches, "lines", None)

    @_batch.setter
    def _batch(self, lines: Optional[list[str]]) -> None:
        self._batches.lines = lines

    def _hear_calls(self, calls: queue.SimpleQueue[Optional[Call]]) -> None:
        while (call := calls.get()) is not None:
            for name, node, handler in list(self._call_handlers):
                if name not in (None, call.name) or node not in (None, call.node):
                    continue
                try:
                    handler(call)
                except Exception:
                    traceback.print_exc()

    def _found(self, one: dict[str, Any]) -> Handle:
        name = one["name"] or f"#{one['id']}"
        return Handle(self, one["node"], name, one["position"], one["wxyz"], one["scale"], one["visible"])

    def _made(
        self, name: str, line: str, position: Vector, heading_deg: float, lifetime_s: Optional[float], parent: Optional[Parent], solid: Solid
    ) -> Handle:
        lines = [line]
        if lifetime_s is not None:
            lines.append(f"lifetime {_word(name)} {float(lifetime_s)!r}")
        if parent is not None:
            lines.append(f"hang {_word(name)} {_who(parent)}")
        if solid is not False:
            lines.append(f"solid {_word(name)}{_solid(solid)}")
        messages = self._change(*lines)
        made = Handle(self, _word(name), name, position, _turned(heading_deg), (1.0, 1.0, 1.0), True)
        made._solid, made.messages = solid, messages
        return made

    def _change(self, *lines: str) -> list[str]:
        """One line, or several that are one batch; returns what is said of them."""
        if self._batch is not None:
            self._batch.extend(lines)
            return []
        done: _Done = self._ask(list(lines) if len(lines) == 1 else ["begin", *lines, "commit"]).result(60.0)
        return done.messages

    def _file(self, content: Union[Path, bytes], ending: str) -> str:
        if not isinstance(content, bytes):
            return os.path.abspath(content)
        with self._news:
            if self._folder is None:
                self._folder = tempfile.TemporaryDirectory(prefix="septet")
            self._files += 1
            path = pathlib.Path(self._folder.name) / f"{self._files}{ending}"
        path.write_bytes(content)
        return str(path)

    def _ask(self, lines: list[str]) -> Future[Any]:
        answer: Future[Any] = Future()
        with self._writing:
            with self._news:
                if self.why_ended is not None or self._process.stdin is None or self._process.stdin.closed:
                    raise Ended(self.why_ended or "the connection is closed")
                self._requests += 1
                self._asked[self._requests] = answer
            try:
                self._process.stdin.write("\n".join(lines) + "\n")
                self._process.stdin.flush()
            except OSError as error:
                raise Ended(str(error)) from error
        return answer

    def _want_ticks(self) -> None:
        if not self._tells_ticks:
            self._tells_ticks = True
            self._ask(["ticks on"])

    def _begin_loop(self) -> _Backlog:
        self._want_ticks()
        with self._news:
            backlog, self._waiting = self._waiting, _Backlog()
            self._loops.append(backlog)
        return backlog

    def _end_loop(self, backlog: _Backlog) -> None:
        """What it leaves waits for the next loop, unless another one has it already."""
        with self._news:
            self._loops.remove(backlog)
            if not self._loops:
                self._waiting = backlog

    def _next_tick(self, backlog: _Backlog) -> Optional[Tick]:
        with self._news:
            self._news.wait_for(lambda: backlog.ticks or self.why_ended is not None)
            return backlog.ticks.popleft() if backlog.ticks else None

    def _read_errors(self) -> None:
        assert self._process.stderr
        for line in self._process.stderr:
            self._errors.append(line.strip())

    def _read(self) -> None:
        assert self._process.stdout
        why = "the connection is closed"
        for line in self._process.stdout:
            row = json.loads(line)
            if row["type"] == "end":
                why = row["why"]
            else:
                self._take(row)
        if not self.hello:
            self._error_reader.join(10.0)  # It has the reason.
        with self._news:
            self.why_ended = "\n".join(self._errors) if self._errors and not self.hello else why
            for answer in self._asked.values():
                answer.set_exception(Ended(self.why_ended))
            self._asked.clear()
            self._news.notify_all()
        self._tell("end", self.why_ended)

    def _tell(self, what: str, news: Any) -> None:
        for handler in list(self._handlers[what]):
            try:
                handler(news)
            except Exception:
                traceback.print_exc()

    def _take(self, row: dict[str, Any]) -> None:
        kind = row["type"]
        if kind == "tick":
            tick = _tick(row)
            with self._news:
                self.newest = tick
                self._stepped = _joined(self._stepped, tick)
                for backlog in self._loops or [self._waiting]:
                    self.missed_ticks += backlog.keep(tick)
                self._news.notify_all()
            if self._calls is not None:
                for call in tick.calls:
                    self._calls.put(call)
            self._tell("tick", tick)
        elif kind == "message":
            if not self.hello:
                self._errors.append(row["text"])  # What hinders it.
            self._tell("message", row["text"])
        elif kind == "hello":
            with self._news:
                self.hello = row
                self._news.notify_all()
        else:
            with self._news:
                answer = self._asked.pop(row["request"], None)
            if answer is None:
                return
            if kind == "nodes":
                answer.set_result(row["nodes"])
            elif kind == "lines":
                answer.set_result(row["lines"])
            elif row["ok"]:
                answer.set_result(_Done(row["tick"], row["messages"]))
            else:
                failures = [Failure(one["line"], one["text"], one["node"], one["why"]) for one in row["failures"]]
                answer.set_exception(Refused(failures, row["others"]))

    def _wait_for_hello(self, timeout_s: float) -> None:
        with self._news:
            self._news.wait_for(lambda: self.hello or self.why_ended is not None, timeout_s)
        if not self.hello:
            self._process.kill()
            raise Ended(self.why_ended or "the server does not answer")


def _program() -> str:
    named = os.environ.get("SEPTET_PROGRAM")
    if named:
        return named
    here = pathlib.Path(__file__).resolve()
    for folder in (here.parents[3] / "bin" if len(here.parents) > 3 else here.parent, here.parents[2] / "build" / "release"):
        if (folder / "septet").is_file():
            return str(folder / "septet")
    return shutil.which("septet") or "septet"


def connect(host: Optional[str] = None, port: Optional[int] = None, key: Optional[Path] = None, *, keys: Optional[Path] = None, timeout_s: float = 60.0) -> World:
    """Connects to the drive at that address. `key`: file NAME.key, server.public beside it. Or `keys` alone: the folder that
    `septet drive --editors` wrote, which has the address too. Raises Ended, with the reason, where nobody lets it in."""
    if key is None and keys is None:
        raise ValueError("give key, or keys")
    command = [_program(), "edit", "--json", "--keys", str(keys if key is None else pathlib.Path(key).parent)]
    if key is not None:
        command += ["--key", pathlib.Path(key).stem]
    if host is not None:
        command += ["--server", f"{host}:{4750 if port is None else port}"]
    world = World(command)
    world._wait_for_hello(timeout_s)
    return world
