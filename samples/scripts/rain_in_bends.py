#!/usr/bin/env python3
"""It rains while the driver is in a bend: rain_in_bends.py KEYS [SECONDS], of a drive with --editors KEYS."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    first, rains = next(world.ticks()), None
    for tick in world.ticks(every=60):
        if tick.time_s > first.time_s + float((sys.argv[2:] or ["600"])[0]):
            break
        if rains != (rains := abs(tick.car.yaw_rate_radps) > 0.02):
            world.conditions(rain_mm_per_h=20 if rains else 0)
