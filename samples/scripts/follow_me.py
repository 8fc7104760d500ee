#!/usr/bin/env python3
"""A target that a controller of your own keeps 2 s ahead of the driver: follow_me.py KEYS TARGET.glb [SECONDS]."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    first = next(world.ticks())
    place, velocity = list(first.driver.ahead(20)), [0.0, 0.0, 0.0]
    target = world.add("stimuli/target", sys.argv[2], place)
    for tick in world.ticks(every=12):
        place = [here + 0.1 * v for here, v in zip(place, velocity)]
        wanted = tick.driver.ahead(10 + 2 * tick.car.speed_mps)
        velocity = [there - here + v for there, here, v in zip(wanted, place, tick.driver.velocity)]
        target.go(velocity)
        if tick.time_s > first.time_s + float((sys.argv[3:] or ["600"])[0]):
            break
