#!/usr/bin/env python3
"""Everybody ahead is red, for one condition: repaint_traffic.py KEYS, of a drive with --editors KEYS."""
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world:
    tick = next(world.ticks())
    with world.batch():
        for one in tick.everybody:
            if one.id != tick.car.id:
                world.repaint(one, 0.8, 0.05, 0.05)
    print(f"repainted {len(tick.everybody) - 1}")
