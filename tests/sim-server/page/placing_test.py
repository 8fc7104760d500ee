#!/usr/bin/env python3
"""A headless Chromium places things on the operator's map, moves, turns, hides and undoes, and saves a file of edits: a second drive with
that file has the same scene, and the first one's session is verified.

    placing_test.py SEPTET_SERVER SEPTET ROOT [FOLDER]     # FOLDER: pictures of the page go there

Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import json
import sqlite3
import struct
import sys

from chromium import LIMIT_S, PageTrial


def cube_glb():
    """A cube of 1 m on the ground, as a model's file."""
    corners = [(x, y, z) for x in (-0.5, 0.5) for y in (0.0, 1.0) for z in (-0.5, 0.5)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    indices = [face[i] for face in faces for i in (0, 1, 2, 0, 2, 3)]
    data = b"".join(struct.pack("<3f", *corner) for corner in corners) + struct.pack(f"<{len(indices)}H", *indices)
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "cube"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 2 * len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-0.5, 0.0, -0.5], "max": [0.5, 1.0, 0.5]},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}]}).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data), b"BIN\0") + data)


class Map:
    """The page's map under a mouse or a finger, by world metres."""

    def __init__(self, browser):
        self.browser = browser

    def pixel(self, x_m, y_m):
        return self.browser.value(f"(() => {{ const place = canvas.getBoundingClientRect(); return [place.left + canvas.clientWidth / 2 + ({x_m} - view.x) * view.scale,"
                                  f" place.top + canvas.clientHeight / 2 - ({y_m} - view.y) * view.scale]; }})()")

    def mouse(self, kind, place):
        x, y = self.pixel(*place)
        self.browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=0 if kind == "mouseReleased" else 1, clickCount=1)

    def drag(self, *places):
        self.mouse("mousePressed", places[0])
        for place in places[1:]:
            self.mouse("mouseMoved", place)
        self.mouse("mouseReleased", places[-1])

    def swipe(self, first, last):
        for kind, place in (("touchStart", first), ("touchMove", last)):
            x, y = self.pixel(*place)
            self.browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y}])
        self.browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])


def close_to(value, wanted, within=0.6):
    return abs(value - wanted) < within


def look_around(browser, folder):
    """The page fits a desk and a telephone, whichever colours the reader's system has."""
    for scheme in ("light", "dark"):
        browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        for width, height in ((1440, 1040), (390, 844)):
            browser.size(width, height)
            browser.value("document.getElementById('placingbox').scrollIntoView()")
            assert browser.beyond_the_edge() == [], (scheme, width, browser.beyond_the_edge())
            if folder:
                browser.picture(f"{folder}/placing-{scheme}-{width}.png")
    browser.size(1440, 1040)
    browser.value("document.getElementById('map').scrollIntoView()")


def main():
    server_program, septet, root, *pictures = sys.argv[1:]
    with PageTrial(septet, root) as trial:
        (trial.folder / "cube.glb").write_bytes(cube_glb())
        server, url = trial.serve(server_program, "--rig", "desktop", "--scenario", "behind-ambulance", "--keys", trial.folder / "keys/server",
                                  "--out", trial.folder / "out", "--wait-for-screens", "0", "--driver", "plain", "--any-port", "--page", "0",
                                  cwd=trial.folder)
        page = trial.browser("one")
        page.open(url)
        page.until("mine && stock.has_scene && stock.stock.length > 20")
        page.click("#pause")
        page.until("state.paused")
        # Beside the road, where nobody is, at eight pixels a metre.
        page.value("var own = state.everybody.find((other) => other[0] === hello.driver); follow(false);"
                   "view.scale = 8; view.x = own[2] + 60 * Math.sin(own[4]); view.y = own[3] - 60 * Math.cos(own[4])")
        x, y = page.value("[view.x, view.y]")
        on_map = Map(page)

        # A vehicle of the catalogue, found by search; dragged towards y, it heads there.
        page.value("document.getElementById('stocksearch').value = 'hatch'; show_stock()")
        assert page.value("document.querySelectorAll('#stock option').length") == 1
        page.value("document.getElementById('placingsolid').checked = true")
        page.click("#placestock")
        on_map.drag((x, y), (x, y + 3), (x, y + 6))
        page.until("placed.things.length === 1 && selected && selected.name.startsWith('placed/hatchback/')")
        car = page.value("placed.things[0]")
        assert close_to(car["x_m"], x) and close_to(car["heading_deg"], 90.0) and car["solid"], car
        assert close_to(car["length_m"], page.value("hello.models.find((model) => model.name === 'hatchback').length"), 0.3), car

        # Moved by the mouse, turned by the dot ahead of it, moved by a finger, then by numbers and a key.
        middle = (car["middle_x_m"], car["middle_y_m"])
        on_map.drag(middle, (middle[0] + 2, middle[1]), (middle[0] + 10, middle[1]))
        page.until(f"Math.abs(selected.x_m - {car['x_m'] + 10}) < 0.6")
        handle = page.value("handle_of(selected)")
        on_map.drag(handle, (handle[0] + 3, handle[1] - 3), page.value("[selected.x_m + 9, selected.y_m]"))
        page.until("Math.abs(selected.heading_deg) < 3")
        page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=1)
        middle = page.value("[selected.middle_x_m, selected.middle_y_m]")
        on_map.swipe(middle, (middle[0], middle[1] + 5))
        page.until(f"Math.abs(selected.y_m - {car['y_m'] + 5}) < 1.2")
        page.call("Emulation.setTouchEmulationEnabled", enabled=False)
        page.value("document.getElementById('chosenheading').focus(); document.getElementById('chosenheading').value = '30'")
        page.key("Enter", 13, "\r")
        page.until("Math.abs(selected.heading_deg - 30) < 0.1")

        # One's own file, by keys alone, in the map's middle; not solid.
        page.value("document.getElementById('stocksearch').value = 'cube'; show_stock(); document.getElementById('placingsolid').checked = false;"
                   "document.getElementById('placingheading').value = '0'; view.y -= 12")
        page.click("#placestock")
        page.value("canvas.focus()")
        page.key("Enter", 13, "\r")
        page.until("placed.things.length === 2 && selected && selected.name.startsWith('placed/cube/') && !selected.solid")
        assert page.value("Math.abs(selected.length_m - 1) < 0.01")
        page.click("#solidchosen")
        page.until("selected.solid && document.querySelector('#solidchosen').getAttribute('aria-pressed') === 'true'")
        page.click("#undoedit")
        page.until("!selected.solid")

        # Where somebody is, nothing solid may come: the gate's reason is shown, and all stays.
        page.value("document.getElementById('chosenx').value = own[2] + 1; document.getElementById('choseny').value = own[3]")
        page.click("#solidchosen")
        page.until("selected.solid")
        page.value("document.getElementById('chosenx').value = own[2] + 1; document.getElementById('choseny').value = own[3]; document.getElementById('chosenform').requestSubmit()")
        page.until("document.getElementById('placingsaid').classList.contains('bad')")
        why = page.value("document.getElementById('placingsaid').textContent")
        assert "cannot stand there" in why, why

        # Scenery: the nearest tree is hidden, shown again by undo, and hidden for good.
        page.value("var tree = null; ask({ do: 'find_near', x_m: view.x, y_m: view.y, within_m: 200 },"
                   " (answer) => { tree = answer.found.find((thing) => thing.name.startsWith('tree/')) || answer.found.find((thing) => !thing.placed); })")
        page.until("tree")
        page.value("view.x = tree.x_m; view.y = tree.y_m")
        tree = page.value("tree")
        page.click("#pick")
        on_map.drag((tree["x_m"], tree["y_m"]))
        page.until(f"selected && selected.id === {tree['id']}")
        page.click("#hidechosen")
        page.until(f"placed.things.some((thing) => thing.id === {tree['id']} && !thing.shown) && !selected.shown")
        page.click("#undoedit")
        page.until(f"!placed.things.some((thing) => thing.id === {tree['id']}) && selected.shown")
        page.click("#hidechosen")
        page.until(f"placed.things.some((thing) => thing.id === {tree['id']} && !thing.shown)")

        # The same by the text of a command, typed in the field: shown, hidden again, and one that may not be is told.
        def type_command(line):
            page.value(f"document.getElementById('command').value = {line!r}; document.getElementById('command').form.requestSubmit()")

        type_command(f'scene hide-set "{tree["name"]}" 0')
        page.until(f"!placed.things.some((thing) => thing.id === {tree['id']})")
        type_command(f'scene hide-set "{tree["name"]}" 1')
        page.until(f"placed.things.some((thing) => thing.id === {tree['id']} && !thing.shown)")
        type_command("scene hide-set nothing/there 1")
        page.until("document.body.textContent.includes('nothing/there')")
        type_command("call name=lift node=none degrees=70")

        # A thing that is removed is gone, and comes back by undo.
        page.value("choose(placed.things.find((thing) => thing.name.startsWith('placed/cube/')))")
        page.click("#removechosen")
        page.until("placed.things.length === 2 && selected === null")
        page.click("#undoedit")
        page.until("placed.things.length === 3")
        page.value("choose(placed.things.find((thing) => thing.name.startsWith('placed/hatchback/'))); look_at_chosen()")
        look_around(page, pictures[0] if pictures else None)

        for bad in ("../x", ""):
            page.value(f"ask({{ do: 'save_edits', name: {bad!r} }}, (answer) => said(answer.why, true))")
            page.until("document.getElementById('placingsaid').textContent === 'this is no name of a file'")
        page.value("document.getElementById('editsname').value = 'my-town'")
        page.click("#saveform button:not([type])")
        page.until("document.getElementById('placingsaid').textContent.includes('my-town.edits')")
        edits = trial.folder / "out/my-town.edits"
        saved = edits.read_bytes()
        assert b"placed/hatchback/" in saved and f'hide-set "{tree["name"]}" 1'.encode() in saved.replace(f"hide-set {tree['name']} 1".encode(), f'hide-set "{tree["name"]}" 1'.encode()), saved[:400]

        # What the browser may not do.
        for line in ("import x /etc/passwd 0 0 0", "picture tree/1 /etc/passwd", "lifetime tree/1 3"):
            page.value(f"var why = null; ask({{ do: 'edit', lines: {line!r} }}, (answer) => {{ why = answer.ok ? 'done' : answer.why; }})")
            page.until("why")
            assert page.value("why") in ("the map knows no such line", "no file of this name lies in the drive's folders"), (line, page.value("why"))

        page.click("#pause")
        page.until("!state.paused && state.sim_s > 1")
        page.click("#end")
        page.click("#ending button[value=yes]")
        page.until("document.getElementById('phase').textContent === 'ended'")
        assert server.wait(LIMIT_S) == 3, "a drive that was ended by hand exits with 3"
        session = trial.folder / "out/session.sqlite"
        events = sqlite3.connect(session).execute("SELECT kind, detail FROM events").fetchall()
        for kind, part in (("operator", "edit like"), ("operator", "edit import"), ("operator_command", "stand solid="), ("operator_command", "gone x_m="),
                           ("call", "name=lift")):
            assert any(k == kind and part in d for k, d in events), (kind, part)
        trial.run("replay", "--verify", session)

        again = trial.folder / "again.edits"
        trial.run("drive", "--no-screens", "--scenario", "behind-ambulance", "--rig", "desktop", "--driver", "plain", "--seconds", "0.5",
                  "--edits", edits, "--save", again, "--out", trial.folder / "second")
        assert again.read_bytes() == saved, "a second drive with the file has another scene"


main()
