"""What the module promises, against a real server: edit_scripts_check.py SEPTET."""
import pathlib
import queue
import sqlite3
import subprocess
import sys
import tempfile
import time

from edited_drive import EditedDrive, refused, run, triangle_glb, use_module_of

septet_program = pathlib.Path(sys.argv[1])
use_module_of(septet_program)
import septet  # noqa: E402


def end_lifetimes(host: str, port: int, keys: pathlib.Path, glb: pathlib.Path) -> int:
    """What has a lifetime is gone at its tick, which is returned; its script has ended while the world stood."""
    with septet.connect(host, port, keys / "desk/desk.key") as desk:
        stood = desk.pause()
        with septet.connect(host, port, keys / "lab/lab.key") as lab:
            with lab.batch() as batch:
                lab.add("stimuli/flash", glb, lifetime_s=0.5)
                lab.board("stimuli/notice", 2, 1, lifetime_s=0.5).show_text("NOW")
            assert batch.result() == stood
            # Removed before, or replaced by one that stays: nothing of it is refused later.
            lab.add("stimuli/early", glb, lifetime_s=0.25).remove()
            lab.add("stimuli/again", glb, lifetime_s=0.25)
            lab.add("stimuli/again", glb)
            assert "more than 0 seconds" in refused(lambda: lab.add("stimuli/never", glb, lifetime_s=0)).why
            assert not lab.find("stimuli/never")
        desk.step(50)
        while not (desk.find("stimuli/flash") and desk.find("stimuli/notice") and desk.find("stimuli/again")):
            pass
        assert not desk.find("stimuli/early")
        desk.step(10)
        while desk.find("stimuli/flash") or desk.find("stimuli/notice"):
            pass
        assert desk.find("stimuli/again")
    return stood + 60


def hear(world: septet.World) -> list[septet.Event]:
    """All events of two seconds, by a script that takes each seventh tick and is late for a while."""
    first, events = None, []
    for tick in world.ticks(every=7):
        assert tick.dropped_events == 0
        if first is None:
            first = tick.tick
            for n in range(20):
                world.mark(f"number {n}")
        events += tick.events
        if tick.tick > first + 240 and sum(one.name == "mark" and one.fields["note"].startswith("number") for one in events) == 20:
            return events
    raise AssertionError("the drive has ended")


def events_of_ticks_that_a_slow_script_misses_go_to_the_next_and_are_bounded() -> None:
    def tick(number: int, events: int, dropped: int = 0) -> septet.Tick:
        happened = tuple(septet.Event(number, 0.0, "mark", None, {"note": str(n)}) for n in range(events))
        return septet.Tick(number, 0.0, None, (), 0, 0.0, 0.0, happened, dropped)
    both = septet._joined(tick(1, 2, 3), tick(2, 1))
    assert both.tick == 2 and [one.tick for one in both.events] == [1, 1, 2] and both.dropped_events == 3
    full = septet._joined(tick(1, septet.MOST_EVENTS_KEPT), tick(2, 5))
    assert len(full.events) == septet.MOST_EVENTS_KEPT and full.dropped_events == 5 and full.events[-1].tick == 2


def every_tick_that_is_missed_is_stood_in_for() -> None:
    every = septet._Every(12)
    assert [tick for tick in (5, 11, 12, 13, 25, 30, 36, 59, 60, 61) if every.takes(tick)] == [12, 25, 36, 59, 60]


def use(host: str, port: int, keys: pathlib.Path, glb: pathlib.Path, folder: pathlib.Path) -> None:
    with septet.connect(host, port, keys / "lab/lab.key") as world:
        first = next(world.ticks())
        assert first.driver.id == first.car.id and first.everybody
        # Everything of the world has a name of its own, by which it is found and hidden.
        tree = world.find("tree/*")[0]
        assert world.get(tree.node.strip('"')).position == tree.position
        tree.visible = False
        ball = world.add("stimuli/ball", glb, first.driver.ahead(30))
        ball.position = first.driver.ahead(31)
        sign = world.board("stimuli/sign", 2, 1, first.driver.ahead(60))
        def looks() -> int:
            return sum(len(world._ask([f'find "" type {kind}']).result(60)) for kind in ("material", "bitmap"))
        sign.show_text("STOP")
        one_text = looks()
        for number in range(100):
            sign.show_text(str(number))
        assert 2 <= looks() == one_text < 1000, (looks(), one_text)
        world.undo()
        assert looks() == one_text, (looks(), one_text)
        sign.paint(1, 0, 0)
        lines = world._ask(["read stimuli/sign"]).result(60)
        assert [line.split()[3] for line in lines if line.startswith("link-set")] == ["geometry", "material"], lines
        sign.hang_on(first.driver)
        sign.position = (-1, 0, 2)
        assert len(world.find(f"model/participant/{first.car.id}")) == 1
        # What was made and what was generated leave the world as models, which a check reads.
        for thing, name in ((ball, "ball"), (tree, "tree"), (world.get("model/hatchback"), "car")):
            thing.export(folder / f"{name}.glb")
            assert " triangles;" in run(str(septet_program), "check", str(folder / f"{name}.glb")), name
        # A thing hangs on another one and is removed with it.
        tray = world.add("stimuli/tray", glb, (0, 0, 1), parent=first.car)
        cup = world.add("stimuli/cup", glb, (0, 0, 0.1), parent=tray)
        links = [line.split() for line in world._ask(["read stimuli/tray"]).result(60) if line.startswith("link-set")]
        assert sum(line[3] == "child" for line in links) == 2, links
        assert "what it hangs on" in refused(lambda: cup.hang_on(cup)).why
        tray.remove()
        assert not world.find("stimuli/cup")
        (driver,) = [name for name, number in world.participants.items() if number == first.car.id]
        world.repaint(driver, 0, 0, 1)
        assert any("paint" in line for line in world._ask([f"read model/participant/{first.car.id}"]).result(60))
        assert "number or name" in refused(lambda: world.repaint("nobody", 0, 0, 1)).why
        # A script marks, sets the weather, stops the world and takes it tick by tick.
        world.mark("phase 2")
        world.conditions(rain_mm_per_h=12, road_wetness=0.5)
        assert "is not" in (why := refused(lambda: world.conditions(rain=1))).why or why.why, why
        stood = world.pause()
        for n in (1, 5):
            assert world.step(n).tick == stood + n
            stood += n
        time.sleep(0.3)
        assert world.newest.tick == stood
        # What happens while it stands is told with the next tick, and once.
        world.mark("at rest")
        marks = [one for _ in range(3) for one in world.step(2).events if one.name == "mark"]
        assert [one.fields for one in marks] == [{"by": "lab", "note": "at rest"}], marks
        assert (marks[0].tick, marks[0].participant) == (stood, None), marks
        stood += 6
        world.go_on()
        assert next(tick for tick in world.ticks() if tick.tick > stood).tick > stood
        heard_by.extend(hear(world))
        # What moves is sent once, and begins where it is when the server does it.
        # What is solid is met where it is seen, far from everybody here; it is no more where it is hidden.
        wall = world.add("stimuli/wall", glb, (5, 6, 700), solid=True)
        assert wall.solid is True
        wall.go((1, 0, 0))
        wall.visible = False
        wall.visible = True
        wall.solid = False
        crate = world.add("stimuli/crate", glb, (5, 6, 700), solid=25)
        assert crate.solid == 25
        tags = [line.split()[3:] for line in world._ask(["read stimuli/crate"]).result(60) if line.startswith("tag-set")]
        assert {tag[1].strip('"') for tag in tags} >= {"solid", "mass_kg", "participant", "foot_m"}, tags
        assert "from 0.1 to 20000 kg" in refused(lambda: setattr(crate, "solid", 0.0)).why
        crate.remove()
        deer = world.add("stimuli/deer", glb, (5, 6, 7))
        deer.go((0, 3, 0), turn_degps=90, then=[(2, (0, 0, 0))])
        (line,) = [line.split() for line in world._ask(["read stimuli/deer"]).result(60) if line.startswith("motion-set")]
        assert [float(word) for word in line[2:6]] == [0, 5, 6, 7] and line[10] == "2", line
        assert float(line[11]) > first.time_s and abs(float(line[21]) - float(line[11]) - 2) < 1e-9, line
        deer.position = (1, 1, 1)
        assert not [line for line in world._ask(["read stimuli/deer"]).result(60) if line.startswith("motion-set")]
        why = refused(lambda: deer.go((20000, 0, 0)))
        assert "faster than 10 km/s" in why.why, why.why
        # A file that is watched: what differs is sent when it was saved, and a half-written one is told.
        live = folder / "live.glb"
        live.write_bytes(triangle_glb())
        told = queue.Queue()
        world.on("message")(told.put)
        world.add("stimuli/live", live, watch=True)
        assert "already" in refused(lambda: world.add("stimuli/live", live, watch=True)).why
        live.write_bytes(triangle_glb(2))
        while "changes, from tick" not in (message := told.get(timeout=60)):
            pass
        assert message.startswith(f"{live}: 1 changes"), message
        live.write_bytes(triangle_glb()[:100])
        assert "live.glb" in (message := told.get(timeout=60)) and "changes" not in message, message
        # A batch is done whole at its tick, or nothing of it.
        at = world.pause() + 24
        with world.batch(at_tick=at) as later:
            ball.visible = False
            sign.visible = False
        world.go_on()
        assert later.result() == at
        def half():
            with world.batch():
                ball.visible = True
                world._change("hide nobody")
        why = refused(half)
        assert why.line == 2 and "nobody" in why.why, (why.line, why.why)
        assert not world.get("stimuli/ball").visible
        # Each change that cannot be read is named; what needs a thing that was not made is left out.
        def three_wrong():
            with world.batch():
                world.add("stimuli/none", folder / "none.glb").visible = False
                ball.visible = True
                world._change("hide nobody")
                world._change("jump stimuli/ball")
        why = refused(three_wrong)
        assert [one.index for one in why.failures] == [1, 4, 5], why
        assert [one.node for one in why.failures] == ["stimuli/none", "nobody", "stimuli/ball"] and why.others == 0, why.failures
        assert all(one.why in str(why) and one.command in str(why) for one in why.failures), why
        assert not world.get("stimuli/ball").visible
        # Adding again replaces.
        world.add("stimuli/ball", glb, (1, 2, 3))
        assert [one.position for one in world.find("stimuli/ball")] == [(1, 2, 3)]
        world.save(folder / "kept.edits")
        text = (folder / "kept.edits").read_text()
        assert f"hide-set {tree.node} 1" in text and "stimuli/ball" in text
    with septet.connect(host, port, keys / "guest/guest.key") as guest:
        assert "which lab made" in refused(lambda: guest.get("stimuli/ball").remove()).why
        assert "may not operate" in refused(lambda: guest.mark("no")).why
        assert "needs the word create" in refused(lambda: guest.add("mine")).why
        # Of a batch that is refused the change is told that may not be, and none is made.
        tree, ball = guest.find("tree/*")[1], guest.get("stimuli/ball")
        def second_may_not():
            with guest.batch():
                tree.visible = False
                ball.visible = False
        why = refused(second_may_not)
        assert why.line == 2 and "which lab made" in why.why, (why.line, why.why)
        assert guest.get(tree.node.strip('"')).visible
        sign = guest.get("stimuli/sign")
        def three_may_not():
            with guest.batch():
                ball.visible = False
                tree.visible = False
                sign.visible = False
                for _ in range(40):
                    ball.position = (0, 0, 0)
        why = refused(three_may_not)
        assert [one.index for one in why.failures[:3]] == [1, 3, 4] and len(why.failures) + why.others == 42, why
        assert [one.node for one in why.failures[:2]] == ["stimuli/ball", "stimuli/sign"] and len(why.failures) == 16, why.failures
        assert "after an earlier failure of this node" in why.failures[2].why and str(why).endswith("and 26 more"), why
        assert guest.get(tree.node.strip('"')).visible
    with septet.connect(host, port, keys / "reader/reader.key") as reader:
        assert next(reader.ticks()).everybody
        assert "may look, not edit" in refused(lambda: reader.get("stimuli/ball").remove()).why


def call_and_listen(host: str, port: int, keys: pathlib.Path) -> None:
    """Who listens hears each call that is meant, in a thread that may change the world; who may not operate may not call."""
    heard: queue.Queue = queue.Queue()
    with septet.connect(host, port, keys / "desk/desk.key") as desk:
        gate = desk.add("stimuli/gate")
        tree = desk.find("tree/*")[0]
        @desk.on_call("open", node=gate)
        def open_gate(call: septet.Call) -> None:
            with desk.batch():
                gate.visible = False
            heard.put((call, gate.visible))
            desk.call("opened", gate)
        desk.on_call()(lambda call: heard.put((call, None)))
        with septet.connect(host, port, keys / "lab/lab.key") as lab:
            at = lab.call("open", node="stimuli/gate", words="a b=c", seconds=3)
            lab.call("close")
            lab.call("open", node=tree)
            assert "no node" in (why := refused(lambda: lab.operate("call name=open node=nowhere")).why), why
            assert "a node that exists" in (why := refused(lambda: lab.call("open", node="nowhere")).why), why
            assert "not printed" in (why := refused(lambda: lab.call("open", words="\n")).why), why
            assert "names of parameters" in (why := refused(lambda: lab.call("open", by="somebody")).why), why
        told = [heard.get(timeout=60) for _ in range(5)]
        # The answer of the desk's handler comes after the call that it answers, beside the other calls of the lab, in either order.
        every = [(call.name, call.node, call.by) for call, seen in told if seen is None]
        lab_called = [("open", "stimuli/gate", "lab"), ("close", None, "lab"), ("open", tree.name, "lab")]
        assert [one for one in every if one[2] == "lab"] == lab_called and every.index(("opened", "stimuli/gate", "desk")) > 0, told
        ((first, seen),) = [one for one in told if one[1] is not None]
        assert not seen and first.parameters == {"words": "a b=c", "seconds": "3"} and first.tick == at + 1, (first, at)
        gate.remove()
    with septet.connect(host, port, keys / "guest/guest.key") as guest:
        assert "may not operate" in refused(lambda: guest.call("open")).why


def undo_by_the_server(host: str, port: int, keys: pathlib.Path) -> None:
    """A key's newest batch is taken back, by a later connection too, and by no other key."""
    with septet.connect(host, port, keys / "lab/lab.key") as lab:
        lab.add("stimuli/undone", position=(1, 2, 3))
        tree = lab.find("tree/*")[2]
        tree.visible = False
    with septet.connect(host, port, keys / "guest/guest.key") as guest:
        assert "nothing of guest's" in refused(guest.undo).why
    with septet.connect(host, port, keys / "reader/reader.key") as reader:
        assert "may not undo" in refused(reader.undo).why and "needs `KEY reader … edit`" in refused(reader.undo).why
    with septet.connect(host, port, keys / "lab/lab.key") as lab:
        assert not lab.get(tree.name).visible
        assert lab.undo() > 0
        assert lab.get(tree.name).visible
        lab.undo()
        assert not lab.find("stimuli/undone")
        lab.operate(f"scene hide-set {tree.node} 1")
        assert not lab.get(tree.name).visible
        lab.undo()
        assert lab.get(tree.name).visible


def time_of(host: str, port: int, keys: pathlib.Path) -> float:
    with septet.connect(host, port, keys / "desk/desk.key") as desk:
        return next(desk.ticks()).time_s


def film(session: pathlib.Path, times_s: list, folder: pathlib.Path) -> None:
    """Two frames of the half second before each of these times, by both renderers: as many pictures, and no two times look alike."""
    shots = [f"[[shot]]\nfrom_s = {time_s - 0.5:.3f}\nto_s = {time_s:.3f}\ninterior = true\n" for time_s in times_s]
    (folder / "after_scripts.toml").write_text("\n".join(shots))
    for renderer, more in (("raster", ["--software"]), ("traced", ["--samples", "1"])):
        out = folder / renderer
        run(str(septet_program), "film", str(session), "--shots", str(folder / "after_scripts.toml"), "--out", str(out), "--fps", "4", "--size", "64x48",
            "--renderer", renderer, "--no-sound", *more)
        pictures = sorted(out.glob("*.png"))
        assert len(pictures) == 2 * len(times_s), (renderer, len(pictures))
        assert len({picture.read_bytes() for picture in pictures[::2]}) == len(times_s), renderer


every_tick_that_is_missed_is_stood_in_for()
events_of_ticks_that_a_slow_script_misses_go_to_the_next_and_are_bounded()
heard_by: list = []
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "ball.glb").write_bytes(triangle_glb())
    editors = ["lab=edit operate", "desk=edit operate", "guest=edit hide move", "reader=look"]
    with EditedDrive(septet_program, folder, editors, "--save", str(folder / "saved.edits")) as drive:
        keys, port = drive.keys, drive.port
        use("127.0.0.1", port, keys, folder / "ball.glb", folder)
        used_s = time_of("127.0.0.1", port, keys)
        call_and_listen("127.0.0.1", port, keys)
        undo_by_the_server("127.0.0.1", port, keys)
        ended_at = end_lifetimes("127.0.0.1", port, keys, folder / "ball.glb")
        (folder / "lines").write_text(f"save {folder}/as-lines.edits\nmove stimuli/again 1 2 3\n")
        saved, moved = [line for line in run(str(septet_program), "edit", "--keys", str(keys / "lab"), str(folder / "lines")).splitlines() if line[1:2] == ":"]
        assert saved == "1: done" and moved.startswith("2: done, shown from tick "), (saved, moved)
        (folder / "unended").write_text("begin\ncreate stimuli/unended\n")
        unended = subprocess.run([str(septet_program), "edit", "--keys", str(keys / "lab"), str(folder / "unended")], capture_output=True, text=True)
        assert unended.returncode != 0 and "without its `commit`" in unended.stdout + unended.stderr, unended
        with septet.connect("127.0.0.1", port, keys / "lab/lab.key"):
            try:
                septet.connect("127.0.0.1", port, keys / "lab/lab.key")
                raise AssertionError("two scripts have one key")
            except septet.Ended as why:
                assert "another client with this key is connected" in str(why), why
        ended_s = time_of("127.0.0.1", port, keys)
    log, session = drive.log_file.read_text(), drive.session
    assert "lab connected, which is no screen of this rig: it reads the world and may hide, move, paint, create, solid, and operates" in log, log
    assert "refused so far: 2" in log, log
    logged = sqlite3.connect(session).execute("SELECT count(*) FROM scene_edits WHERE tick > 0").fetchone()[0]
    notes = [row for row in sqlite3.connect(session).execute("SELECT kind, detail FROM events WHERE detail LIKE 'by=lab %'")]
    assert ("mark", "by=lab note=phase 2") in notes and ("operator", "by=lab wish=pause") in notes, notes
    # A script hears what the log has, in its order, without a gap. A glance is logged when it is over, with the tick of its beginning.
    events = [(one.tick, one.name, one.participant) for one in heard_by]
    logged_events = sqlite3.connect(session).execute("SELECT tick, kind, participant FROM events ORDER BY id").fetchall()
    assert any(logged_events[i : i + len(events)] == events for i in range(len(logged_events))), (logged_events, events)
    # What had half a second went at its tick; of what had a quarter, parts that were left when it was replaced.
    at_tick = [row[0] for row in sqlite3.connect(session).execute("SELECT tick FROM scene_edits WHERE tick > ? AND tick <= ?", (ended_at - 60, ended_at))]
    assert ended_at in at_tick and set(at_tick) <= {ended_at - 30, ended_at}, at_tick
    assert not [line for line in log.splitlines() if "lab: nothing" in line and "node destroy" in line], log
    assert logged > 20, logged
    print(run(str(septet_program), "replay", "--verify", str(session)))
    film(session, [used_s, ended_s], folder)
    told = sqlite3.connect(session).execute("SELECT detail FROM events WHERE kind = 'operator_command'").fetchall()
    solids = [row[0].split()[:2] for row in told if "solid=" in row[0]]
    stand, clear = ["stand", "solid=0"], ["clear", "solid=0"]
    assert solids == [stand, stand, clear, stand, clear, stand, clear], told
    stood = [row[0] for row in told if row[0].startswith("stand ")]
    assert [row.endswith(' name="stimuli/wall"') for row in stood] == [True] * 3 + [False], stood
    assert [" leg=" in row for row in stood] == [False, True, True, False] and " mass_kg=25 " in stood[3], stood
    # What is hidden of the generated world is met no more.
    assert any(row[0].startswith("gone x_m=") and ' name="tree/' in row[0] for row in told), told
    assert "stimuli/sign" in (folder / "saved.edits").read_text()
