#!/usr/bin/env python3
"""A drive is chosen and started on the page of `septet operate`, driven and ended there, and its report is read from the list of past drives.

    start_test.py SEPTET ROOT

Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import signal
import sqlite3
import sys

from chromium import LIMIT_S, PageTrial


def main():
    septet, root = sys.argv[1:]
    with PageTrial(septet, root) as trial:
        drives = trial.folder / "drives"
        hostile = drives / "<img src=x onerror=document.title=1>"
        hostile.mkdir(parents=True)
        (hostile / "session.sqlite").write_bytes(b"no session at all")
        # Of a rig of several machines: no screen is drawn here, and the operator drives without them.
        operate, url = trial.serve(septet, "operate", "--page", "0", "--out", drives, "--keys", trial.folder / "keys/server")
        browser = trial.browser("browser")
        browser.call("Page.navigate", url=url)
        browser.until("typeof hello !== 'undefined' && hello && hello.choices && state && mine")
        assert browser.value("state.sessions.length") == 0, "what is no session is listed"

        # What cannot be is refused, and is told by the drive's own words.
        browser.value("var said = []; ask({ do: 'start', scenario: '../../etc/passwd' }, (answer) => said.push(answer.why))")
        browser.until("said.length === 1")
        assert browser.value("said[0]") == "there is no such scenario"
        choose = "for (const [id, value] of Object.entries(%s)) document.getElementById(id).value = value; show_scenario()"
        browser.value(choose % "{ choosescenario: 'motorway-ambulance', chooserig: 'desktop', choosedriver: 'plain', seed: 'seven' }")
        browser.click("#startbutton")
        browser.until("state.failed && state.last.includes('seed')")

        browser.value(choose % "{ seed: '7', participant: 'P07', drivenote: \"it's late\" }")
        browser.value("for (let i = 0; i < 2; ++i) ask(chosen(), (answer) => said.push(answer.why))")
        browser.until("said.length === 3")
        assert browser.value("said[1] === undefined && said[2]") == "a drive is being started already"
        browser.until("hello.scenario === 'motorway-ambulance' && hello.seed === '7' && hello.participant === 'P07' && mine && state && state.phase.startsWith('waiting')")
        browser.click("#pause")
        browser.until("state.tick > 10")
        browser.value("document.querySelectorAll('#sickness button')[3].click()")
        browser.until("state.rating.answered && state.rating.value === 3")
        browser.click("#end")
        browser.click("#ending button[value=yes]")
        browser.until("hello.choices && state && state.sessions && state.sessions.length === 1 && !state.starting")
        assert browser.value("state.sessions[0].participant + state.sessions[0].ended") == "P07by_operator"
        browser.value("var report = ''; ask({ do: 'look', session: state.sessions[0].id, file: 'report.html' },"
                      " async (answer) => { report = await (await fetch(answer.path)).text(); })")
        browser.until("report.includes('</html>')")

        session = next(drives.glob("*motorway-ambulance/session.sqlite"))
        assert sqlite3.connect(session).execute("SELECT item, value FROM questionnaire").fetchall() == [("misc.00", 3.0)]
        assert ("note", "it's late") in sqlite3.connect(session).execute("SELECT key, value FROM meta").fetchall()
        trial.run("replay", "--verify", session)
        operate.send_signal(signal.SIGTERM)
        assert operate.wait(LIMIT_S) == 0


main()
