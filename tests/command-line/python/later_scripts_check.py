"""What a script finds that others have made and set in motion, and what waits for a later tick: later_scripts_check.py SEPTET."""
import math
import pathlib
import queue
import subprocess
import sys
import tempfile

from edited_drive import EditedDrive, refused, root, triangle_glb, use_module_of

septet_program = pathlib.Path(sys.argv[1])
use_module_of(septet_program)
import septet  # noqa: E402


def the_first_lines_of_the_document_are_done(keys: pathlib.Path, folder: pathlib.Path) -> None:
    words = (root / "docs/editing.md").read_text().split("lines, each answered\n")[1].split("septet drive")[0]
    assert len(words.splitlines()) == 5, words
    (folder / "lines").write_text(words)
    done = subprocess.run([str(septet_program), "edit", "--keys", str(keys), "lines"], cwd=folder, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout
    assert "hide-set tree/" in (folder / "my.edits").read_text()


def nothing_waits_for_a_batch_ahead(world: septet.World, folder: pathlib.Path) -> None:
    post, other = world.add("ahead/post"), world.add("ahead/other")
    at = world.pause() + 60
    with world.batch(at_tick=at) as later:
        post.visible = False
    # The world stands still, so the tick does not come before go_on.
    assert world.find("ahead/*") and world.get("ahead/post").visible
    world.save(folder / "meanwhile.edits")
    other.position = (1, 2, 3)
    world.undo()
    assert world.get("ahead/other").position == (0, 0, 0)
    def far() -> None:
        with world.batch(at_tick=10**12) as never:
            post.visible = True
        never.result()
    assert "tick 1000000000000 is more than 120000000 ticks ahead" in refused(far).why
    world.go_on()
    assert later.result() == at and not world.get("ahead/post").visible


def what_goes_is_found_where_it_is_and_moved_by_any_script(world: septet.World, other: septet.World) -> None:
    stood = world.pause()
    glider = world.add("later/glider", position=(100, 200, 50))
    glider.go((10, 0, 0))
    assert world.step(60).tick == stood + 60
    x, y, z = world.get("later/glider").position
    assert math.isclose(x, 105, abs_tol=1e-6) and (y, z) == (200, 50), (x, y, z)
    assert [one.name for one in world.find("later/*", near=(105, 200, 0.1))] == ["later/glider"]
    assert not world.find("later/*", near=(100, 200, 1))
    other.get("later/glider").position = (1, 2, 3)
    assert world.step(60).tick == stood + 120
    assert world.get("later/glider").position == (1, 2, 3)
    glider.go((10, 0, 0))
    glider.position = (4, 5, 6)
    world.step(12)
    assert world.get("later/glider").position == (4, 5, 6)
    world.go_on()


def a_call_about_a_thing_that_was_found_is_heard(world: septet.World) -> None:
    world.add("later/barrier")
    heard: queue.Queue = queue.Queue()
    found = world.get("later/barrier")
    assert found.name == "later/barrier", found.name
    world.on_call("lift", node=found)(heard.put)
    world.call("lift", "later/barrier")
    assert heard.get(timeout=60).node == "later/barrier"


def what_a_file_holds_and_what_is_left_out_is_said(world: septet.World, glb: pathlib.Path) -> None:
    assert any("triangle" in one for one in world.add("later/ball", glb).messages)
    told: queue.Queue = queue.Queue()
    world.on("message")(told.put)
    assert len(world.find()) == 1000 and "more than 1000 nodes" in told.get(timeout=60)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "ball.glb").write_bytes(triangle_glb())
    with EditedDrive(septet_program, folder, ["lab=edit operate", "desk=edit later/ operate"]) as drive:
        the_first_lines_of_the_document_are_done(drive.keys / "lab", folder)
        with septet.connect(keys=drive.keys / "lab") as lab, septet.connect(keys=drive.keys / "desk") as desk:
            what_a_file_holds_and_what_is_left_out_is_said(lab, folder / "ball.glb")
            what_goes_is_found_where_it_is_and_moved_by_any_script(lab, desk)
            a_call_about_a_thing_that_was_found_is_heard(lab)
            nothing_waits_for_a_batch_ahead(lab, folder)
