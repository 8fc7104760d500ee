#!/usr/bin/env python3
"""A sign on the bonnet while somebody is nearer than a second ahead: too_close.py KEYS [SECONDS], of a drive with --editors KEYS."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    first = next(world.ticks())
    sign = world.board("stimuli/too-close", 0.5, 0.15, (2.6, 0.4, 1.0), 180)
    sign.show_text("TOO CLOSE")
    sign.hang_on(first.car)
    for tick in world.ticks(every=12):
        reach = tick.driver.ahead(0.5 * tick.car.speed_mps)
        sign.visible = any(one.distance_m(reach) < 0.5 * tick.car.speed_mps for one in tick.everybody if one.id != tick.car.id)
        if tick.time_s > first.time_s + float((sys.argv[2:] or ["600"])[0]):
            break
