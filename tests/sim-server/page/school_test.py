#!/usr/bin/env python3
"""The page before and after drives, as a school uses it: its own files are chosen, past drives are found and marked, a student's record is
read, in three languages, on a telephone, by keys alone, below a path of a proxy and by [::1].

    school_test.py SEPTET ROOT [FOLDER]

Pictures of the page come into the folder, if there is one. Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import asyncio
import json
import pathlib
import shutil
import signal
import socket
import sqlite3
import sys
import threading

from chromium import LIMIT_S, PageTrial

READY = "typeof hello !== 'undefined' && hello && hello.choices && state && state.sessions && !state.looking && mine"
# A key whose text is missing is shown verbatim.
KEYS_SHOWN = "document.body.innerText.match(/\\b(shell|start|past|record|asking|taking|ending|severity|end|said|scenario|about)\\.[a-z_]+/g)"


def make_own(own, root):
    """A school's folder: its rig and its own lesson, in the folder that it stands in and in one that it names."""
    shutil.copy(root / "rigs/desktop.toml", own / "lab.toml")
    lesson = own / "more/scenarios/our-tunnel"
    lesson.mkdir(parents=True)
    text = (root / "scenarios/tunnel-fire/tunnel-fire.xosc").read_text().replace("../motorway-ambulance/", "")
    (lesson / "our-tunnel.xosc").write_text(text)
    shutil.copy(root / "scenarios/motorway-ambulance/motorway.xodr", lesson)
    text = (root / "scenarios/tunnel-fire/tunnel-fire.lesson.toml").read_text()
    (lesson / "our-tunnel.lesson.toml").write_text(text.replace("A fire in a tunnel", "Unser Tunnel <b>"))
    shutil.copy(root / "scenarios/experiments/ambulance-24.toml", own / "more/our-study.toml")
    return lesson / "our-tunnel.xosc"


def make_past(trial, drives, lesson):
    """Two drives of a student, a game of another, and a file that is no session."""
    for name, driver, seconds in (("one", "novice", "24"), ("two", "experienced", "21")):
        trial.run("drive", "--scenario", lesson, "--rig", "desktop", "--driver", driver, "--participant", "P07", "--no-screens", "--seconds", seconds,
                  "--log", "samples", "--out", drives / name)
    shutil.copytree(drives / "two", drives / "three")
    with sqlite3.connect(drives / "three/session.sqlite") as session:
        session.execute("DELETE FROM files WHERE role = 'lesson'")
        session.execute("UPDATE meta SET value = 'P08 <img src=x onerror=document.title=1>' WHERE key = 'participant'")
        session.execute("UPDATE meta SET value = '2026-01-01T23:30:00Z' WHERE key = 'started_utc'")
        session.execute("INSERT INTO events(tick, simulated_time_s, kind, detail) VALUES (9, 0.1, 'game', 'state=over why=lost level=3 points=4520 survived_s=61.0')")
    session.close()
    (drives / "four").mkdir()
    (drives / "four/session.sqlite").write_bytes(b"no session at all")


class ProxyBelowPath:
    """Serves the page below /sim/ and takes that off, as a school's web server does."""

    def __init__(self, to_port):
        self.to_port, self.asked, self.loop = to_port, [], asyncio.new_event_loop()
        self.server = self.loop.run_until_complete(asyncio.start_server(self.serve, "127.0.0.1", 0))
        self.port = self.server.sockets[0].getsockname()[1]
        threading.Thread(target=self.loop.run_forever, daemon=True).start()

    async def serve(self, reader, writer):
        try:
            head = await reader.readuntil(b"\r\n\r\n")
            method, path, rest = head.split(b" ", 2)
            self.asked.append(path.decode())
            if not path.startswith(b"/sim/"):
                writer.write(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")
                await writer.drain()
                return
            back, to = await asyncio.open_connection("127.0.0.1", self.to_port)
            to.write(b" ".join([method, path[4:], rest]))
            await asyncio.gather(self.pump(reader, to), self.pump(back, writer))
        except (OSError, asyncio.IncompleteReadError):
            pass
        finally:
            writer.close()

    @staticmethod
    async def pump(reader, writer):
        try:
            while data := await reader.read(65536):
                writer.write(data)
                await writer.drain()
        except OSError:
            pass
        writer.close()


def choose_what_is_own(browser):
    options = browser.value("[...document.querySelectorAll('#choosescenario optgroup')].map((group) => [group.label, [...group.children].map((one) => one.textContent)])")
    groups = dict(options)
    assert list(groups) == ["Lessons", "Games", "Other drives", "Experiments"], list(groups)
    assert "A first lesson" in groups["Lessons"] and any(one.startswith("Unser Tunnel <b>") for one in groups["Lessons"]), groups
    assert groups["Games"] == ["Follow the ambulance"], groups
    assert any("our-study.toml" in one for one in groups["Experiments"]), groups
    rigs = browser.value("[...document.querySelectorAll('#chooserig option')].map((one) => one.value)")
    assert "lab.toml" in rigs and "seven-screens" in rigs, rigs
    assert browser.value("document.querySelector('#chooserig option').textContent") == "lab.toml", "the rig that stands here is not the first"
    assert browser.value("!document.getElementById('researchbox').open && !document.getElementById('seed').checkVisibility()"), "seed is not behind the fold"


def find_past(browser):
    rows = "[...document.querySelectorAll('#sessions tr')].map((row) => [...row.cells].map((cell) => cell.textContent))"
    browser.until("state.sessions.length === 3")
    marked = browser.value("state.sessions.filter((session) => session.lesson)")
    assert len(marked) == 2 and all(session["mark"] is not None and session["tasks"] for session in marked), marked
    assert browser.value("state.sessions.find((session) => session.participant.startsWith('P08')).points") == 4520
    assert all(session["simulated_s"] > 20.0 for session in marked), marked
    text = json.dumps(browser.value(rows))
    assert f"{marked[0]['mark']:.1f} of 10" in text and "4520 points, level 3" in text, text
    # In the reader's time zone: half past eleven in the evening in Greenwich is the next day in Stockholm.
    assert "Jan 2, 2026, 12:30" in text, text

    def found(words, which="all"):
        browser.value(f"document.getElementById('pastsearch').value = {words!r}; document.getElementById('pastwhich').value = {which!r};"
                      "document.getElementById('pastsearch').dispatchEvent(new Event('input'))")
        return browser.value("document.querySelectorAll('#sessions tr').length")

    for words, which, count in (("p07", "all", 2), ("P07 novice", "all", 1), ("unser tunnel", "all", 2), ("our-tunnel", "all", 3), ("", "lessons", 2), ("", "games", 1), ("", "people", 0),
                                ("P07", "games", 0), ("2026-01-01", "all", 1), ("Jan 2, 2026", "all", 1), ("<img", "all", 1), ("nobody", "all", 0), ("   ", "all", 3)):
        assert found(words, which) == count, (words, which, found(words, which))
    assert found("nobody") == 0 and browser.value("document.getElementById('nosessions').textContent") == "No drive matches."
    found("")
    assert browser.value("document.title") == "Septet: operator", "a code was taken for HTML"


def read_record(browser):
    browser.value("[...document.querySelectorAll('#sessions button.who')].find((one) => one.textContent === 'P07').click()")
    browser.until("document.getElementById('record').open")
    assert browser.value("document.querySelectorAll('#recordchart circle').length") == 2
    tasks = browser.value("[...document.querySelectorAll('#recordfaults tbody tr')].map((row) => [...row.cells].map((cell) => cell.textContent))")
    of_session = browser.value("state.sessions.find((session) => session.lesson).tasks.map((task) => task.says)")
    assert [row[0] for row in tasks] == of_session and all(len(row) == 4 for row in tasks), tasks
    wrong = browser.value("state.sessions.flatMap((session) => session.lesson ? session.tasks : []).filter((task) => task.mark !== null && task.severity !== 'none').length")
    assert sum(int(row[3].split()[0]) for row in tasks) == wrong, (tasks, wrong)
    browser.key("Escape", 27)
    browser.until("!document.getElementById('record').open")


def look_in_each_language(browser, folder):
    seen = set()
    for width, height in ((1280, 900), (390, 844)):
        browser.size(width, height)
        for language in ("en", "de", "sv"):
            browser.value(f"document.getElementById('language').value = {language!r}; document.getElementById('language').dispatchEvent(new Event('change'))")
            assert browser.value("document.documentElement.lang") == language
            assert not browser.value(KEYS_SHOWN), browser.value(KEYS_SHOWN)
            seen.add(browser.value("document.getElementById('startbutton').textContent + document.querySelector('#sessions .file').textContent"))
            for what, begin, end in (("start", "", ""), ("fold", "document.getElementById('researchbox').open = true", "document.getElementById('researchbox').open = false"),
                                     ("record", "show_record('P07')", "document.getElementById('record').close()"),
                                     ("asking", "ask_driver(state.sessions[0])", "document.getElementById('asking').close()"),
                                     ("ending", "document.getElementById('ending').showModal()", "document.getElementById('ending').close()")):
                browser.value(begin)
                assert browser.beyond_the_edge() == [], (width, language, what, browser.beyond_the_edge())
                assert browser.value("document.documentElement.scrollWidth <= innerWidth"), (width, language, what)
                assert not browser.value(KEYS_SHOWN), browser.value(KEYS_SHOWN)
                if folder:
                    browser.picture(f"{folder}/{what}-{language}-{width}.png")
                browser.value(end)
    assert len(seen) == 3, seen
    browser.call("Page.reload")
    browser.until(READY)
    assert browser.value("document.documentElement.lang") == "sv", "the choice of a language is forgotten"
    browser.value("document.getElementById('language').value = 'en'; document.getElementById('language').dispatchEvent(new Event('change'))")
    browser.size(1280, 900)


def go_by_keys(browser):
    nameless = browser.value("""[...document.querySelectorAll('#startmain input, #startmain select, #startmain button, header input, header select, header button')]
        .filter((one) => !(one.labels && one.labels.length && one.labels[0].textContent.trim()) && !one.getAttribute('aria-label') && !one.textContent.trim()).map((one) => one.id)""")
    assert nameless == [], nameless
    browser.value("document.activeElement.blur()")
    passed = []
    for _ in range(16):
        browser.key("Tab", 9)
        passed.append(browser.value("document.activeElement.id || document.activeElement.parentElement.id"))
    wanted = ["name", "take", "language", "choosescenario", "participant", "choosedriver", "chooserig", "choosevehicle", "drivenote", "researchbox", "startnow",
              "startbutton", "pastsearch", "pastwhich"]
    assert [one for one in passed if one in wanted] == wanted, passed
    # Chosen and started without a pointer; what it asks for is refused, so that nothing is driven here.
    browser.value("document.getElementById('seed').value = 'seven'; document.getElementById('choosescenario').focus()")
    browser.key("ArrowDown", 40)
    browser.value("document.getElementById('startbutton').focus()")
    browser.key("Enter", 13, "\r")
    browser.until("state.failed && state.last.includes('seed')")
    browser.value("document.getElementById('seed').value = '1'")


def main():
    septet, root = sys.argv[1], pathlib.Path(sys.argv[2])
    folder = sys.argv[3] if len(sys.argv) > 3 else None
    with PageTrial(septet, root) as trial:
        own, drives = trial.folder / "own", trial.folder / "drives"
        own.mkdir()
        drives.mkdir()
        make_past(trial, drives, make_own(own, root))
        operate, url = trial.serve(septet, "operate", "--page", "0", "--out", drives, "--keys", trial.folder / "keys/server", "--data", "more",
                                   "--rig", "lab.toml", cwd=own)
        port, token = int(url.split(":")[2].split("/")[0]), url.split("#")[1]
        browser = trial.browser("browser")
        browser.call("Emulation.setTimezoneOverride", timezoneId="Europe/Stockholm")
        browser.call("Page.navigate", url=url.replace("/#", "/?utm_source=mail#"))
        browser.until(READY)
        choose_what_is_own(browser)
        find_past(browser)
        read_record(browser)
        look_in_each_language(browser, folder)
        go_by_keys(browser)

        proxy = ProxyBelowPath(port)
        browser.call("Page.navigate", url=f"http://127.0.0.1:{proxy.port}/sim/?a=b#{token}")
        browser.until(f"location.port === '{proxy.port}' && {READY}")
        browser.value("var report = ''; ask({ do: 'look', session: state.sessions[0].id, file: 'report.html' },"
                      " async (answer) => { report = await (await fetch(new URL(answer.path, location.href))).text(); })")
        browser.until("report.includes('</html>')")
        assert all(path.startswith("/sim/") or path == "/favicon.ico" for path in proxy.asked), proxy.asked
        with socket.socket(socket.AF_INET6) as probe:
            has_ipv6 = probe.connect_ex(("::1", port)) == 0
        if has_ipv6:
            browser.call("Page.navigate", url=f"http://[::1]:{port}/#{token}")
            browser.until(f"location.hostname === '[::1]' && {READY}")
        operate.send_signal(signal.SIGTERM)
        assert operate.wait(LIMIT_S) == 0


main()
