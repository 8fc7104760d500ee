#!/usr/bin/env python3
"""Two headless Chromiums at the operator's page of a drive: one commands and is killed, the other takes over and ends the drive.

    browser_test.py SEPTET_SERVER SEPTET ROOT

Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import json
import os
import pathlib
import re
import shutil
import socket
import sqlite3
import struct
import subprocess
import sys
import tempfile
import time
import urllib.request

LIMIT_S = 300


class Browser:
    """Told what to do over its debugging socket."""

    def __init__(self, program, folder):
        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--remote-debugging-port=0",
             f"--user-data-dir={folder}", "--window-size=1440,1040", "about:blank"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        said = pathlib.Path(folder, "DevToolsActivePort")
        wait_for(lambda: said.exists() and "\n" in said.read_text(), "Chromium to start")
        port = int(said.read_text().split()[0])
        pages = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json", timeout=LIMIT_S))
        path = next(page for page in pages if page["type"] == "page")["webSocketDebuggerUrl"].split(str(port), 1)[1]
        self.socket, self.bytes, self.number = socket.create_connection(("127.0.0.1", port), LIMIT_S), b"", 0
        self.socket.sendall(f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n".encode())
        while b"\r\n\r\n" not in self.bytes:
            self.bytes += self.socket.recv(4096)
        self.bytes = self.bytes.split(b"\r\n\r\n", 1)[1]

    def read(self, count):
        while len(self.bytes) < count:
            more = self.socket.recv(1 << 20)
            if not more:
                raise EOFError("Chromium has gone")
            self.bytes += more
        taken, self.bytes = self.bytes[:count], self.bytes[count:]
        return taken

    def call(self, method, **parameters):
        self.number += 1
        data, mask = json.dumps({"id": self.number, "method": method, "params": parameters}).encode(), b"mask"
        size = bytes([0x80 | len(data)]) if len(data) < 126 else b"\xfe" + struct.pack(">H", len(data))
        self.socket.sendall(b"\x81" + size + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(data)))
        while True:
            message, is_last = b"", False
            while not is_last:
                first, size = self.read(2)
                is_last, size = first & 0x80, size & 127
                if size > 125:
                    size = int.from_bytes(self.read(2 if size == 126 else 8), "big")
                message += self.read(size)
            answer = json.loads(message)
            if answer.get("id") == self.number:
                return answer["result"]

    def value(self, script):
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True)
        assert "exceptionDetails" not in answer, (script, answer)
        return answer["result"].get("value")

    def until(self, script):
        wait_for(lambda: self.value(script), script)

    def open(self, url):
        self.call("Page.navigate", url=url)
        self.until("typeof state !== 'undefined' && state && state.tick > 0")

    def click(self, selector):
        self.value(f"document.querySelector({selector!r}).click()")

    def kill(self):
        self.process.kill()
        self.process.wait()


def wait_for(condition, what):
    until = time.monotonic() + LIMIT_S
    while not condition():
        if time.monotonic() > until:
            sys.exit(f"waited in vain for: {what}")
        time.sleep(0.02)


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
