"""A headless Chromium, controlled over its debugging socket, and the surroundings of a test of the page."""
import base64
import json
import pathlib
import re
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import time
import urllib.request

LIMIT_S = 300  # Which only a hang reaches.
ADDRESS = re.compile(rb"http://127\.0\.0\.1:\d+/#[0-9a-f]{32}")


class Browser:
    """Controlled over its debugging socket."""

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

    def picture(self, file):
        pathlib.Path(file).write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

    def size(self, width, height):
        """A window, or a telephone's screen, of so many pixels."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)

    def key(self, key, code, characters=""):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code, text=characters if kind == "keyDown" else "")

    def beyond_the_edge(self):
        """Visible elements that end right of the page's edge, except those that scroll within it."""
        return self.value("""[...document.querySelectorAll('body *')].filter((element) => {
            const place = element.getBoundingClientRect();
            if (!(place.width > 0 && place.height > 0) || place.right <= innerWidth + 0.5) return false;
            for (let around = element.parentElement; around && around !== document.body; around = around.parentElement)
                if (getComputedStyle(around).overflowX !== 'visible' && around.getBoundingClientRect().right <= innerWidth + 0.5) return false;
            return true;
        }).map((element) => `${element.tagName} ${element.id} ${element.className}`)""")

    def kill(self):
        self.process.kill()
        self.process.wait()


class PageTrial:
    """The folder, programs and browsers of a test, gone when it ends. It exits with 77 where there is no Chromium."""

    def __init__(self, septet, root):
        self.chromium, self.septet, self.root = shutil.which("chromium"), septet, root
        if not self.chromium:
            print("no chromium: install the package chromium")
            sys.exit(77)

    def __enter__(self):
        self.folder, self.running = pathlib.Path(tempfile.mkdtemp(prefix="septet-page-")), []
        self.run("rig", "keys", "desktop", "--out", self.folder / "keys")
        return self

    def __exit__(self, *_):
        for process in self.running:
            process.kill()
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def run(self, *arguments):
        subprocess.run([self.septet, *arguments], check=True, cwd=self.root, stdout=subprocess.DEVNULL)

    def serve(self, *command, cwd=None):
        """A program that serves the page, and the page's address."""
        said = self.folder / "said"
        with open(said, "wb") as log:
            process = subprocess.Popen(command, cwd=cwd or self.root, stdout=log, stderr=log, stdin=subprocess.DEVNULL)
        self.running.append(process)
        wait_for(lambda: ADDRESS.search(said.read_bytes()) or process.poll() is not None, "the page's address")
        found = ADDRESS.search(said.read_bytes())
        assert found, said.read_text()
        return process, found[0].decode()

    def browser(self, name):
        browser = Browser(self.chromium, self.folder / name)
        self.running.append(browser.process)
        return browser


def wait_for(condition, what):
    until = time.monotonic() + LIMIT_S
    while not condition():
        if time.monotonic() > until:
            sys.exit(f"waited in vain for: {what}")
        time.sleep(0.02)
