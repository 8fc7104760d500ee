#!/usr/bin/env python3
"""A sign that changes when the driver is 200 m before it: sign_at_200_m.py KEYS, of a drive with --editors KEYS."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    car = next(world.ticks()).driver
    sign = world.board("stimuli/sign", 3, 1.5, car.ahead(250, left=-6), car.heading_deg + 180)
    sign.show_text("100")
    for tick in world.ticks():
        if tick.driver.distance_m(sign.position) < 200:
            sign.show_text("60")
            print(f"changed at {tick.time_s:.2f} s")
            break
