#!/usr/bin/env python3
"""The world in steps of a tenth of a second, for a program that is slower than time: step_by_step.py KEYS [STEPS]."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    world.pause()
    for _ in range(int((sys.argv[2:] or ["100"])[0])):
        tick = world.step(12)
        print(f"{tick.time_s:.2f} s, {tick.car.speed_mps:.1f} m/s")  # Here yours decides, as long as it likes.
