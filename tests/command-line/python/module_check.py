"""What the module does by itself, against a program that speaks as `septet edit --json` does: module_check.py."""
import asyncio
import contextlib
import io
import pathlib
import sys
import threading

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "command-line/python"))
import septet  # noqa: E402

#: It answers each request after it has told a tick; at a batch's beginning it tells a megabyte of them, and reads nothing meanwhile.
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
    tells = tells or words[0] == "ticks"
    if tells:
        tell_tick()
    if words[0] == "begin":
        for _ in range(2000 if tells else 0):
            tell_tick()
        messages = []
        is_in_batch = True
        continue
    said = ["12 triangles of " + words[1]] if words[0] == "import" else []
    if is_in_batch and words[0] != "commit":
        messages += said
        continue
    said = messages if is_in_batch else said
    is_in_batch = False
    request += 1
    say(type="answer", request=request, ok=True, tick=tick, messages=said)
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
    assert len(heard) == 4 and said.getvalue().count("RuntimeError: of the script") == 4, (heard, said.getvalue())
    assert world.why_ended == "all lines are done"


def a_batch_of_megabytes_is_written_while_ticks_are_told() -> None:
    with connected() as world:
        next(world.ticks())
        def write() -> None:
            with world.batch():
                for _ in range(1000):
                    world._change("tag " + "x" * 4000)
        writer = threading.Thread(target=write, daemon=True)
        writer.start()
        writer.join(60)
        assert not writer.is_alive()
        assert world.newest.tick > 2000


def what_is_said_of_a_file_reaches_the_script() -> None:
    with connected() as world:
        ball = world.add("ball", "ball.glb")
        assert ball.messages == ['12 triangles of "ball"'], ball.messages
        ball.visible = False
        with world.batch() as batch:
            assert world.add("cup", "cup.glb", lifetime_s=2).messages == []
            world.add("plate", "plate.glb")
        assert batch.messages == ['12 triangles of "cup"', '12 triangles of "plate"'], batch.messages


def loops_beside_each_other_have_all_ticks_and_a_later_one_those_that_wait() -> None:
    async def take(world: septet.World, most: int) -> list:
        taken = []
        async for tick in world.aticks(every=2):
            taken.append(tick.tick)
            if len(taken) == most:
                return taken
        return taken

    async def take_both(world: septet.World) -> list:
        async def change() -> None:
            for _ in range(8):
                await asyncio.get_running_loop().run_in_executor(None, world._ask, ["hide a"])
        return (await asyncio.gather(take(world, 3), take(world, 3), change()))[:2]

    with connected() as world:
        first, second = asyncio.run(asyncio.wait_for(take_both(world), 60))
        # Either begins first, so the tick that answers the request for ticks may be one's alone.
        assert first == second == [2, 4, 6], (first, second)
        assert next(world.ticks()).tick == 7
        assert next(world.ticks()).tick == 8


what_a_handler_raises_is_printed_and_the_connection_goes_on()
a_batch_of_megabytes_is_written_while_ticks_are_told()
what_is_said_of_a_file_reaches_the_script()
loops_beside_each_other_have_all_ticks_and_a_later_one_those_that_wait()
