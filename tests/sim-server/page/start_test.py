#!/usr/bin/env python3
"""A drive is chosen and started on the page of `septet operate`, driven and ended there, and its report is read from the list of past drives.

    start_test.py SEPTET ROOT [FOLDER]

Pictures of the page come into the folder, if there is one. Exits 77 where there is no Chromium. It waits for what the page shows, with a limit that only a hang reaches.
"""
import signal
import sqlite3
import sys

from chromium import LIMIT_S, PageTrial


def main():
    septet, root = sys.argv[1:3]
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

        # An impossible drive is refused, in the drive's own words.
        browser.value("var said = []; ask({ do: 'start', scenario: '../../etc/passwd' }, (answer) => said.push(answer.why))")
        browser.until("said.length === 1")
        assert browser.value("said[0]") == "there is no such scenario"
        choose = "for (const [id, value] of Object.entries(%s)) document.getElementById(id).value = value; show_scenario()"
        browser.value(choose % "{ choosescenario: 'motorway-ambulance', chooserig: 'desktop', choosedriver: 'plain', seed: 'seven' }")
        browser.click("#startbutton")
        browser.until("state.failed && state.last.includes('seed')")

        # An invalid order is refused by the page before it is sent, and by the server if it is sent nevertheless.
        browser.value(choose % "{ seed: '7', order: 'x' }")
        assert browser.value("!document.getElementById('startform').checkValidity()"), "the page takes an order that is none"
        browser.value("var orders = []; for (const order of ['x', '0', '-1', '1.5']) ask({ ...chosen(), order }, (answer) => orders.push(answer.why))")
        browser.until("orders.length === 4")
        assert browser.value("orders.every((why) => why === 'the order is a whole number from 1 on')"), browser.value("orders")

        browser.value(choose % "{ seed: '7', order: '2', participant: 'P07', drivenote: \"it's late\" }")
        browser.value("for (let i = 0; i < 2; ++i) ask(chosen(), (answer) => said.push(answer.why))")
        browser.until("said.length === 3")
        assert browser.value("said[1] === undefined && said[2]") == "a drive is being started already"
        browser.until("hello.scenario === 'motorway-ambulance' && hello.seed === '7' && hello.participant === 'P07' && mine && state && state.phase.startsWith('waiting')")
        browser.click("#pause")
        browser.until("state.tick > 10")
        browser.value("document.querySelectorAll('#sickness button')[3].click()")
        browser.until("state.rating.answered && state.rating.value === 3")
        # From nausea on the page offers to end it, as a drop-out.
        browser.click("#end")
        assert browser.value("!document.getElementById('participantstops').checked"), "an end is no drop-out by itself"
        browser.click("#ending button[value=no]")
        browser.until("!document.getElementById('ending').open")
        browser.value("document.getElementById('reason').value = 'felt sick'; offer_end(true)")
        browser.click("#ending button[value=yes]")
        browser.until("hello.choices && state && state.sessions && state.sessions.length === 1 && !state.starting")
        assert browser.value("state.sessions[0].participant + state.sessions[0].ended") == "P07by_operator"
        browser.value("var report = ''; ask({ do: 'look', session: state.sessions[0].id, file: 'report.html' },"
                      " async (answer) => { report = await (await fetch(answer.path)).text(); })")
        browser.until("report.includes('</html>')")

        # Its film, by a click, and read from the row.
        browser.click("#sessions button.make.film")
        browser.until("state.work && state.work.what === 'film'")
        browser.until("!state.work.running && state.sessions[0].has_film")
        assert not browser.value("state.work.failed"), browser.value("state.work.said")
        browser.value("var film = null; ask({ do: 'look', session: state.sessions[0].id, file: 'film.mp4' },"
                      " async (answer) => { film = await (await fetch(answer.path)).blob(); })")
        browser.until("film && film.type === 'video/mp4' && film.size > 10000")
        # A replay goes on beside the page until it is stopped; a second one is refused meanwhile.
        browser.click("#sessions button.make.replay")
        browser.until("state.work.what === 'replay' && state.work.running")
        browser.value("var why_refused = ''; ask({ do: 'make', session: state.sessions[0].id, what: 'film' }, (answer) => why_refused = answer.why || 'done')")
        browser.until("why_refused !== ''")
        assert "goes on already" in browser.value("why_refused"), browser.value("why_refused")
        if len(sys.argv) > 3:
            browser.picture(sys.argv[3] + "/replay.png")
        browser.click("#pastworkstop")
        browser.until("!state.work.running && !state.work.failed")

        # The driver's answers afterwards: by the page's dialog, and invalid ones are refused.
        browser.click("#sessions button.questionnaire")
        browser.until("document.getElementById('asking').open")
        browser.value("document.getElementById('askingwhich').value = 'paper'; show_questionnaire()")
        browser.value("document.querySelector('#askingitems input[data-item=fun][value=\"5\"]').click();"
                      "document.querySelector('#askingitems input[data-item=realistic][value=\"3\"]').click()")
        browser.value("document.getElementById('askingas').value = 'paper-after'")
        if len(sys.argv) > 3:
            browser.picture(sys.argv[3] + "/asking.png")
        browser.click("#askingyes")
        browser.until("!document.getElementById('asking').open && state.sessions[0].answered.includes('paper-after')")
        if len(sys.argv) > 3:
            browser.picture(sys.argv[3] + "/answered.png")
        wrong = [("{ session: 999 }", "there is no such session any more"), ("{ questionnaire: '../../rigs/desktop' }", "there is no such questionnaire"),
                 ("{ questionnaire: 'misc' }", "there is no such questionnaire"), ("{ as: '../x' }", "the answers' name is a word"),
                 ("{ as: 'misc' }", "another questionnaire's answers"), ("{ answers: { joy: 3 } }", "it has no item"),
                 ("{ answers: { fun: 6 } }", "is answered from 1 to 5"), ("{ answers: { fun: 2.5 } }", "is answered from 1 to 5"),
                 ("{ answers: {} }", "nothing is answered")]
        for i, (spoiled, why) in enumerate(wrong):
            browser.value("var refused_why = null; ask({ do: 'answer', session: state.sessions[0].id, questionnaire: 'paper', as: '', answers: { fun: 1 }, ..."
                          f"{spoiled} }}, (answer) => refused_why = answer.why || 'taken')")
            browser.until("refused_why")
            assert why in browser.value("refused_why"), (spoiled, browser.value("refused_why"))

        session = next(drives.glob("*motorway-ambulance/session.sqlite"))
        rows = sqlite3.connect(session).execute("SELECT item, value FROM questionnaire").fetchall()
        assert rows == [("misc.00", 3.0), ("drive_completed", None), ("paper-after.fun", 5.0), ("paper-after.realistic", 3.0)], rows
        stopped_s, reason = sqlite3.connect(session).execute(
            "SELECT observed_s, reason FROM questionnaire WHERE item = 'drive_completed' AND censored = 1").fetchone()
        assert stopped_s > 0.0 and reason == "felt sick", (stopped_s, reason)
        assert ("note", "it's late") in sqlite3.connect(session).execute("SELECT key, value FROM meta").fetchall()
        trial.run("replay", "--verify", session)

        # An experiment is chosen: its next drive is run, under the experiment's own name.
        browser.value("ask({ ...chosen(), experiment: 'no-such', scenario: '' }, (answer) => said.push(answer.why))")
        browser.until("said.includes('there is no such experiment')")
        browser.value("document.getElementById('choosescenario').value = 'experiment:ambulance-24'; show_scenario();"
                      "document.getElementById('participant').value = 'P02'; ask(chosen(), (answer) => said.push(answer.why))")
        browser.until("hello.scenario === 'motorway-ambulance' && hello.participant === 'P02' && mine && state && state.phase.startsWith('waiting')")
        browser.value("document.getElementById('reason').value = 'enough'; offer_end(false)")
        browser.click("#ending button[value=yes]")
        browser.until("hello.choices && state && state.sessions && state.sessions.length === 2 && !state.starting && !state.looking")
        assert browser.value("state.command.includes('--about=part=game') && state.command.includes('ambulance-24/subjects/P02/game-01')"), browser.value("state.command")
        assert (drives / "ambulance-24/subjects/P02/game-01/session.sqlite").exists()
        operate.send_signal(signal.SIGTERM)
        assert operate.wait(LIMIT_S) == 0


main()
