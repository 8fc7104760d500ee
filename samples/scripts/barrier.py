#!/usr/bin/env python3
"""A barrier across the lane ahead that lifts on the call `lift`: barrier.py KEYS [SECONDS], of a drive with --editors KEYS.

It is called by the storyboard (septet:call), the operator's page, a line `call stimuli/barrier lift degrees=70`, or another script.
"""
import math
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    first = next(world.ticks())
    barrier = world.add("stimuli/barrier", position=first.driver.ahead(60, left=3), heading_deg=first.driver.heading_deg + 180)
    hinge = world.add("stimuli/hinge", position=(0, 0, 1), parent=barrier)

    @world.on_call("lift", node=barrier)
    def lift(call: septet.Call) -> None:
        half = math.radians(float(call.parameters.get("degrees", 85))) / 2
        hinge.wxyz = (math.cos(half), math.sin(half), 0, 0)
        print(f"lifted for {call.by} at {call.time_s:.2f} s", flush=True)

    # The arm comes last: a barrier that is seen can be called.
    world.board("stimuli/arm", 6, 0.2, (0, 3, 0), parent=hinge).paint(0.8, 0, 0)
    for tick in world.ticks():
        if tick.time_s > first.time_s + float((sys.argv[2:] or ["600"])[0]):
            break
