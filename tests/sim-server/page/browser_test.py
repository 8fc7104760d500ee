#!/usr/bin/env python3
"""Two headless Chromiums at the operator's page of a drive: one commands and is killed, the other takes over and ends the drive.

    browser_test.py SEPTET_SERVER SEPTET ROOT

Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import json
import sqlite3
import sys

from chromium import LIMIT_S, PageTrial


def main():
    server_program, septet, root = sys.argv[1:]
    with PageTrial(septet, root) as trial:
        server, url = trial.serve(server_program, "--rig", "desktop", "--scenario", "behind-ambulance", "--keys", trial.folder / "keys/server",
                                  "--out", trial.folder / "out", "--wait-for-screens", "0", "--driver", "plain", "--any-port", "--page", "0")
        first, second = trial.browser("first"), trial.browser("second")
        first.open(url)
        first.until("mine")
        second.open(url)
        assert second.value("!mine && document.getElementById('controls').disabled"), "the second browser commands too"
        assert second.value("state.browsers") == 2

        first.value("document.getElementById('note').value = 'sneezed'")
        first.click("#markform button")
        second.until("[...document.querySelectorAll('#events li')].some((line) => line.textContent.includes('sneezed'))")
        first.value("[...document.querySelectorAll('#presets button')].find((button) => button.textContent === 'Snow').click()")
        second.until("state.conditions[2] === 0.8")
        for wish, seen in (("conditions friction_scale=0.6", "state.conditions[11] === 0.6"),
                           ("conditions sun_elevation_rad=0.05 sun_illuminance_lux=9000", "state.conditions[8] === 0.05"),
                           ("traffic vehicles=31", "state.everybody.length < 50"),
                           ("hide entity=ambulance", "state.entities.some((other) => other.name === 'ambulance' && !other.shown)"),
                           ("show entity=ambulance", "state.entities.some((other) => other.name === 'ambulance' && other.shown)")):
            first.value(f"change({wish!r})")
            second.until(seen)
        first.click("#pause")
        second.until("state.paused && document.getElementById('phase').textContent === 'paused'")
        # Placed by a click on the map, sixty metres ahead, and one of two taken away again.
        first.value("var own = state.everybody.find((other) => other[0] === hello.driver);"
                    "for (const ahead of [60, 70]) place_at(own[2] + ahead * Math.cos(own[4]), own[3] + ahead * Math.sin(own[4]))")
        second.until("state.lying.length === 2 && state.lying[0].name === 'traffic-cone'")
        first.until("document.querySelector('#lying button') !== null")  # It hears when it hears.
        first.click("#lying button")
        second.until("state.lying.length === 1")
        stood_at = second.value("state.tick")

        shown = first.value("state.screens = ['left', 'middle', 'right'].map((name) => ({ name }));"
                            "for (const screen of ['right', 'left', 'middle']) show_thumbnail({ screen, picture: 'data:,' });"
                            "age_thumbnails(); [...document.querySelectorAll('#thumbnails figcaption')].map((one) => one.textContent).join()")
        assert shown == "left,middle,right", f"thumbnails stand in the order {shown}"

        first.kill()
        second.until("state.commander === null")
        assert second.value("state.tick") == stood_at, "a paused drive went on"
        second.click("#take")
        second.until("mine && document.getElementById('pause').textContent === 'Go on'")
        second.click("#pause")
        second.until(f"!state.paused && state.tick > {stood_at}")

        # Another site in the same browser, which knows the port but not the token.
        stranger = trial.browser("stranger")
        place = url.split("/")[2]
        stranger.call("Page.navigate", url="data:text/html,<p>another site")
        stranger.until("document.readyState === 'complete'")
        stranger.value(f"var came = ''; new WebSocket('ws://{place}/live', ['septet', '{url.split('#')[1]}']).onerror = () => came = 'refused'")
        stranger.until("came === 'refused'")
        assert second.value("state.browsers") == 1, "another site's socket was opened"

        second.value("document.getElementById('reason').value = 'the task is done'")
        second.click("#end")
        second.click("#ending button[value=yes]")
        second.until("document.getElementById('phase').textContent === 'ended'")
        assert server.wait(LIMIT_S) == 3, "a drive that was ended by hand exits with 3"
        assert json.loads((trial.folder / "out/summary.json").read_text())["ended"] == "by_operator"
        session = trial.folder / "out/session.sqlite"
        events = sqlite3.connect(session).execute("SELECT kind, detail FROM events").fetchall()
        for kind, part in (("mark", "sneezed"), ("operator_command", "snow_cover=0.8"), ("operator_command", "friction_scale=0.6"),
                           ("operator_command", "sun_elevation_rad=0.05"), ("operator_command", "traffic vehicles=31"),
                           ("operator_command", "hide entity=ambulance"), ("operator_command", "part=traffic-cone"),
                           ("operator_command", "remove thing="), ("operator", "reason=the task is done")):
            assert any(k == kind and part in d for k, d in events), (kind, part)
        trial.run("replay", "--verify", session)


main()
