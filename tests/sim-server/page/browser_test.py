#!/usr/bin/env python3
"""Two headless Chromiums at the operator's page of a drive: one commands and is killed, the other takes over and ends the drive.

    browser_test.py SEPTET_SERVER SEPTET ROOT

Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import json
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile

from chromium import LIMIT_S, Browser, wait_for


def main():
    server_program, septet, root = sys.argv[1:]
    chromium = shutil.which("chromium")
    if not chromium:
        print("no chromium: install the package chromium")
        sys.exit(77)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="septet-page-"))
    running = []
    try:
        subprocess.run([septet, "rig", "keys", "desktop", "--out", folder / "keys"], check=True, cwd=root, stdout=subprocess.DEVNULL)
        log = open(folder / "log", "wb")
        server = subprocess.Popen(
            [server_program, "--rig", "desktop", "--scenario", "motorway-ambulance", "--keys", folder / "keys/server", "--out", folder / "out",
             "--wait-for-screens", "0", "--driver", "plain", "--any-port", "--page", "0"], cwd=root, stdout=log, stderr=log, stdin=subprocess.DEVNULL)
        running.append(server)
        address = re.compile(rb"http://127\.0\.0\.1:\d+/#[0-9a-f]{32}")
        wait_for(lambda: address.search((folder / "log").read_bytes()) or server.poll() is not None, "the server's address")
        url = address.search((folder / "log").read_bytes())[0].decode()

        first, second = (Browser(chromium, folder / name) for name in ("first", "second"))
        running += [first.process, second.process]
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
        first.click("#pause")
        second.until("state.paused && document.getElementById('phase').textContent === 'paused'")
        stood_at = second.value("state.tick")

        first.kill()
        second.until("state.commander === null")
        assert second.value("state.tick") == stood_at, "a paused drive went on"
        second.click("#take")
        second.until("mine && document.getElementById('pause').textContent === 'Go on'")
        second.click("#pause")
        second.until(f"!state.paused && state.tick > {stood_at}")

        # Another site in the same browser, which knows the port but not the token.
        stranger = Browser(chromium, folder / "stranger")
        running.append(stranger.process)
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
        assert json.loads((folder / "out/summary.json").read_text())["ended"] == "by_operator"
        session = folder / "out/session.sqlite"
        events = sqlite3.connect(session).execute("SELECT kind, detail FROM events").fetchall()
        for kind, part in (("mark", "sneezed"), ("operator_command", "snow_cover=0.8"), ("operator", "reason=the task is done")):
            assert any(k == kind and part in d for k, d in events), (kind, part)
        subprocess.run([septet, "replay", "--verify", session], check=True, cwd=root)
    finally:
        for process in running:
            process.kill()
            process.wait()
        shutil.rmtree(folder, ignore_errors=True)


main()
