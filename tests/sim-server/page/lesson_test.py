#!/usr/bin/env python3
"""An instructor at the page of a lesson in headless Chromium: tasks, faults in words, the student's screen large, a word to him, the second
brake, back onto the road, faults of the car; and the drive verifies with all of that in it. It begins again at a kept state.

    lesson_test.py SEPTET_SERVER SEPTET ROOT [FOLDER_FOR_PICTURES]

Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import json
import os
import pathlib
import re
import sqlite3
import sys

from chromium import LIMIT_S, PageTrial, wait_for

# Spoken words: the arguments, a line a sentence.
SPEAKER = "#!/bin/sh\nprintf '%s|' \"$@\" >> \"$SEPTET_SAID\"\nprintf '\\n' >> \"$SEPTET_SAID\"\n"
OWN = "var own = state.everybody.find((other) => other[0] === hello.driver);"


def press(browser, key, down):
    browser.call("Input.dispatchKeyEvent", type="rawKeyDown" if down else "keyUp", key=key, code="Space", windowsVirtualKeyCode=32)


def pictures(browser, folder, name):
    if not folder:
        return
    for width in (1280, 390):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=1000 if width > 400 else 2600, deviceScaleFactor=1, mobile=False)
        browser.picture(folder / f"{name}-{width}.png")
    browser.call("Emulation.clearDeviceMetricsOverride")


def refusal(desk, at_s):
    """Why the drive does not begin again at a time; None: it does."""
    desk.value(f"var whys = []; ask({{ do: 'restart', at_s: {at_s} }}, (answer) => whys.push(answer.why || null))")
    desk.until("whys.length === 1")
    return desk.value("whys[0]")


def at_the_desk(trial, server_program, folder):
    """Without screens, by the clock."""
    said = trial.folder / "aloud"
    speaker = trial.folder / "bin/espeak-ng"
    speaker.parent.mkdir()
    speaker.write_text(SPEAKER)
    speaker.chmod(0o755)
    os.environ["PATH"] = f"{speaker.parent}:{os.environ['PATH']}"
    os.environ["SEPTET_SAID"] = str(said)
    server, url = trial.serve(server_program, "--rig", "desktop", "--scenario", "first-lesson", "--keys", trial.folder / "keys/server",
                              "--out", trial.folder / "out", "--wait-for-screens", "0", "--driver", "plain", "--any-port", "--page", "0")
    desk = trial.browser("desk")
    desk.open(url)
    desk.until("mine")
    desk.value("document.getElementById('language').value = 'en'; document.getElementById('language').onchange()")
    # This rig has no actuators: nothing can be cut.
    assert desk.value("state.actuators === null && document.getElementById('rearm').hidden && document.getElementById('alarm').hidden")
    tasks = desk.value("hello.lesson.tasks.map((task) => task.says)")
    assert tasks and desk.value("[...document.querySelectorAll('#lessontasks td:first-child')].map((cell) => cell.textContent)") == tasks

    # Nobody is there to start this server again.
    assert desk.value("hello.restart === null && document.getElementById('restartform').hidden")
    assert refusal(desk, 0) == "this server was started by itself: only septet drive begins again"

    # A fault as it happens, in words: far too fast where 50 are allowed, until the instructor brakes.
    desk.until("state.sim_s > 2")
    desk.value(f"{OWN} change(`put x_m=${{own[2]}} y_m=${{own[3]}} heading_rad=${{own[4]}} speed_mps=45`)")
    desk.until("document.querySelectorAll('#faults li').length > 0")
    desk.value("document.getElementById('instructorbrake').focus()")
    press(desk, " ", True)
    desk.until("state.instructor_brakes && state.car.brake === 1 && state.car.accelerator === 0")
    pictures(desk, folder, "lesson")
    desk.until("state.car.speed_mps < 25")
    press(desk, " ", False)
    desk.until("!state.instructor_brakes && state.car.brake < 1")
    desk.until("lesson.mark !== null && document.getElementById('lessonmark').textContent !== '–'")
    told = desk.value("[...document.querySelectorAll('#faults li, #events li')].map((line) => line.textContent)")
    assert any("km/h" in line for line in told), told
    assert not any(re.search(r"\w=\S|\(running\)|\brunning\b", line) for line in told), told
    desk.value("document.getElementById('language').value = 'de'; document.getElementById('language').onchange()")
    desk.until("[...document.querySelectorAll('#faults li')].some((line) => line.textContent.includes('zu schnell'))")
    assert desk.value("[...document.querySelectorAll('#events li')].some((line) => line.textContent.includes('Der Fahrlehrer bremst'))")
    pictures(desk, folder, "lesson-de")

    # Blanks are no word.
    desk.value("var blank_why = []; ask({ do: 'say', text: '   ', aloud: true, language: 'de' }, (answer) => blank_why.push(answer.why || 'said'))")
    desk.until("blank_why.length === 1")
    assert desk.value("blank_why[0]") == "there is no word", desk.value("blank_why")

    # A word to the student, aloud in the page's language.
    desk.value("document.getElementById('word').value = '-v „Langsamer“, bitte'")
    desk.click("#wordform button")
    wait_for(said.exists, "the synthesiser")
    wait_for(lambda: said.read_text().endswith("\n"), "the synthesiser's sentence")
    assert said.read_text() == "-v|de|--|-v „Langsamer“, bitte|\n", said.read_text()
    desk.until("[...document.querySelectorAll('#events li')].some((line) => line.textContent.includes('Langsamer'))")

    # Faults of the car, shown as faults and cleared.
    desk.click("#carfaults button:nth-child(5)")
    desk.until("state.faults[4] && document.querySelector('#carfaults button:nth-child(5)').getAttribute('aria-pressed') === 'true'")
    desk.click("#carfaults button:nth-child(1)")
    desk.until("state.faults[0]")
    desk.click("#carfaults button:nth-child(5)")
    desk.until("!state.faults[4]")

    # Back to where it was, which repairs the tyre: the car is as new.
    desk.until("state.sim_s > 12")
    desk.value(f"{OWN} var there = own.slice(2, 4)")
    desk.click("#back")
    desk.until("!state.faults[0]")
    desk.value("command({ do: 'back', seconds: 8 })")
    desk.until(f"(() => {{ {OWN} return Math.hypot(own[2] - there[0], own[3] - there[1]) > 15; }})()")

    # A browser that dies with its foot on the brake: it is let go.
    other = trial.browser("other")
    other.open(url)
    desk.click("#take")
    other.click("#take")
    other.until("mine")
    other.value("hold_brake()")
    desk.until("state.instructor_brakes")
    other.kill()
    desk.until("!state.instructor_brakes && state.commander === null")
    desk.click("#take")
    desk.until("mine")

    desk.value("document.getElementById('reason').value = 'done'")
    desk.click("#end")
    desk.click("#ending button[value=yes]")
    assert server.wait(LIMIT_S) == 3
    session = trial.folder / "out/session.sqlite"
    events = sqlite3.connect(session).execute("SELECT kind, detail FROM events").fetchall()
    for kind, part in (("word", "text=-v „Langsamer“, bitte"), ("operator", "wish=brake"), ("operator", "wish=brake_off"),
                       ("operator_command", "fault what=anti_lock"), ("operator_command", "repair what=anti_lock"),
                       ("operator_command", "fault what=tyre_front_left"), ("operator_command", "put x_m=")):
        assert any(k == kind and part in d for k, d in events), (kind, part)
    trial.run("replay", "--verify", session)


def small_rig(trial, width_px=720, height_px=420):
    text = (pathlib.Path(trial.root) / "rigs/desktop.toml").read_text()
    text = re.sub(r"width_px *= *\d+", f"width_px = {width_px}", text)
    text = re.sub(r"height_px *= *\d+", f"height_px = {height_px}", text)
    rig = trial.folder / "small.toml"
    rig.write_text(text)
    return rig


def with_a_screen(trial, folder):
    """The screen's picture, off-screen and in lockstep."""
    drive, url = trial.serve(trial.septet, "drive", "--rig", small_rig(trial), "--scenario", "first-lesson", "--driver", "plain", "--virtual",
                             "--seconds", "0", "--out", trial.folder / "seen", "--page", "0")
    desk = trial.browser("seen")
    desk.open(url)
    desk.until("mine")
    desk.until("document.querySelector('#thumbnails img') !== null")
    desk.value(f"{OWN} change(`put x_m=${{own[2]}} y_m=${{own[3]}} heading_rad=${{own[4]}} speed_mps=45`)")
    desk.value("var large = new Set(); new MutationObserver(() => large.add(document.getElementById('large').src))"
               ".observe(document.getElementById('large'), { attributes: true })")
    desk.value("change('fault what=anti_lock'); change('fault what=misfire')")  # Which his instruments tell.
    desk.until("state.faults[4] && state.faults[5]")
    desk.click("#thumbnails button")
    desk.until("large.size > 4 && document.getElementById('large').naturalWidth >= 640")
    assert desk.value("document.getElementById('large').getBoundingClientRect().width") >= 640
    pictures(desk, folder, "large")
    # Small pictures, which come with every frame, leave the large one its turn.
    desk.value("large.clear(); var small = new Set(), image = document.querySelector('#thumbnails img');"
               "new MutationObserver(() => small.add(image.src)).observe(image, { attributes: true })")
    desk.until("small.size >= 40")
    assert desk.value("large.size") >= 5, desk.value("large.size")
    desk.click("#largebox button")
    desk.until("!document.getElementById('largebox').open")
    # Without a viewer nothing more comes.
    desk.value("var stood = state.tick; large.clear()")
    desk.until("state.tick > stood + 60")
    assert desk.value("large.size") <= 1, "large pictures come though nobody looks"
    desk.until("document.querySelector('#faults img[src]') !== null")
    desk.until("document.querySelector('#faults img').naturalWidth > 200")
    pictures(desk, folder, "faults")
    desk.value("command({ do: 'end', reason: '', participant_stops: false })")
    assert drive.wait(LIMIT_S) == 3


def begun_again(trial, folder):
    """At a state that the drive has kept, with everybody as they were then; both drives are whole and verify."""
    out = trial.folder / "again"
    drive, url = trial.serve(trial.septet, "drive", "--rig", small_rig(trial, 120, 70), "--scenario", "first-lesson", "--driver", "plain", "--virtual",
                             "--seconds", "0", "--out", out, "--page", "0")
    desk = trial.browser("again")
    desk.open(url)
    desk.until("mine")
    times = "[...document.getElementById('restartat').options].map((one) => +one.value)"
    desk.until("state.sim_s > 11")
    assert desk.value(times) == [10, 0] and desk.value("document.getElementById('restartat').value") == "10"
    desk.value("document.getElementById('restartat').value = '0'")
    desk.until("state.sim_s > 21")
    assert desk.value(times) == [20, 10, 0] and desk.value("document.getElementById('restartat').value") == "0"
    pictures(desk, folder, "restart")
    desk.value("document.getElementById('restartat').value = '10'")
    desk.click("#restartform button")
    desk.until("hello.restart && hello.restart.from_s === 10 && mine")
    desk.until("state.sim_s > 11")
    assert desk.value(times) == [10, 0]
    desk.until("lesson.tasks[hello.lesson.tasks.findIndex((task) => task.measure === 'limit')].mark === 10")  # The limit was posted before.
    assert refusal(desk, 5) == "this drive began later"
    assert refusal(desk, 1000) == refusal(desk, -10) == "the drive has not come so far"
    desk.value("command({ do: 'end', reason: '', participant_stops: false })")
    assert drive.wait(LIMIT_S) == 3
    earlier = trial.folder / "again.1"
    for kept in (earlier, out):
        trial.run("check", kept / "session.sqlite")
        trial.run("replay", "--verify", kept / "session.sqlite")
        trial.run("report", kept / "session.sqlite", "--out", kept / "pooled")
    ask = lambda kept, question: sqlite3.connect(kept / "session.sqlite").execute(question).fetchall()
    assert ask(out, "SELECT min(tick) FROM snapshots") == [(1200,)]
    then = "SELECT x_m, y_m, heading_rad, speed_mps FROM samples WHERE tick = 1200"
    assert ask(out, then) == ask(earlier, then) != []
    assert ask(earlier, "SELECT detail FROM events WHERE kind = 'operator'") == [("by=operator wish=restart at_s=10",)]
    assert ask(earlier, "SELECT value FROM meta WHERE key = 'ended_why'") == [("restart",)]


def main():
    server_program, septet, root = sys.argv[1:4]
    folder = pathlib.Path(sys.argv[4]) if len(sys.argv) > 4 else None
    with PageTrial(septet, root) as trial:
        at_the_desk(trial, server_program, folder)
        with_a_screen(trial, folder)
        begun_again(trial, folder)


main()
