"""What the module does by itself, against a program that speaks as `septet edit --json` does: module_check.py."""
import contextlib
import io
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "command-line/python"))
import septet  # noqa: E402

#: It answers each request after it has told a tick; while it tells of a batch it reads nothing, as the product's does not.
PROGRAM = '''
import json, sys
request, tick, is_in_batch, tells = 0, 0, False, False
car = dict.fromkeys("id speed_mps gear steering_wheel_rad accelerator brake clutch yaw_rate_radps gaze_heading_rad road lane road_s_m lateral_position_m lane_width_m".split(), 0)
def say(**row):
    print(json.dumps(row), flush=True)
def tell_tick():
    global tick
    tick += 1
    say(type="tick", tick=tick, time_s=tick / 120, everybody=[], events=[], dropped_events=0, collisions=0, rain_mm_per_h=0, visibility_m=0, car=car)
say(type="hello", participants={})
for line in sys.stdin:
    words = line.split()
    if tells:
        tell_tick()
    if words[0] == "begin":
        is_in_batch = True
        continue
    if is_in_batch and words[0] != "commit":
        continue
    is_in_batch = False
    request += 1
    tells = tells or words[0] == "ticks"
    say(type="answer", request=request, ok=True, tick=tick, messages=["12 triangles"] if words[0] == "import" else [])
say(type="end", why="all lines are done")
'''


def connected() -> septet.World:
    world = septet.World([sys.executable, "-c", PROGRAM])
    world._wait_for_hello(60)
    return world


def what_a_handler_raises_is_printed_and_the_connection_goes_on() -> None:
    with contextlib.redirect_stderr(io.StringIO()) as said, connected() as world:
        heard = []
        @world.on("tick")
        def late(tick: septet.Tick) -> None:
            heard.append(tick)
            raise RuntimeError("of the script")
        world.on("end")(late)
        assert world._ask(["hide a"]).result(60) and world._ask(["hide a"]).result(60)
    assert len(heard) == 3 and said.getvalue().count("RuntimeError: of the script") == 3, (heard, said.getvalue())
    assert world.why_ended == "all lines are done"


what_a_handler_raises_is_printed_and_the_connection_goes_on()
