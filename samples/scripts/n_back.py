#!/usr/bin/env python3
"""A 1-back task on a gantry ahead: n_back.py KEYS [SECONDS], of a drive with --editors KEYS. Targets are marked in the log."""
import random
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    digits, before, first = random.Random(1), None, next(world.ticks())
    gantry = world.board("stimuli/gantry", 4, 2)
    gantry.hang_on(first.car)
    gantry.position = (60, 0, 6)
    gantry.turn_to(180)
    for tick in world.ticks(every=240):
        if tick.time_s > first.time_s + float((sys.argv[2:] or ["120"])[0]):
            break
        now = digits.randrange(3)
        gantry.show_text(str(now))
        world.mark(f"n-back {now}{' target' if now == before else ''}")
        before = now
