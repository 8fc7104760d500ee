#!/usr/bin/env python3
"""A deer of your own runs out 60 m ahead of the driver, and stops on the other side: deer.py KEYS DEER.glb, of a drive with --editors KEYS."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    for tick in world.ticks(every=12):
        driver = tick.driver
        if driver.speed_mps > 10:
            deer = world.add("stimuli/deer", sys.argv[2], driver.ahead(60, left=-8), driver.heading_deg + 90)
            along, across = driver.ahead(0), driver.ahead(0, left=1)
            deer.go([6 * (b - a) for a, b in zip(along, across)], then=[(16 / 6, (0, 0, 0))])
            break
