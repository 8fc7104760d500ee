#!/usr/bin/env python3
"""A ball crosses the road in two seconds: ball.py KEYS BALL.glb, of a drive with --editors KEYS."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    first = next(world.ticks())
    ball = world.add("stimuli/ball", sys.argv[2], first.driver.ahead(40, left=8))
    for tick in world.ticks(every=4):
        if tick.time_s > first.time_s + 2:
            break
        ball.position = first.driver.ahead(40, left=8 - 8 * (tick.time_s - first.time_s))
    ball.visible = False
