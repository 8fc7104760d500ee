#!/usr/bin/env python3
"""Gaze and lane position as a table, ten times a second: log_gaze.py KEYS FILE.csv [SECONDS], of a drive with --editors KEYS."""
import csv
import sys

import septet

with septet.connect(keys=sys.argv[1]) as world, open(sys.argv[2], "w", newline="") as file:
    table, first = csv.writer(file), next(world.ticks())
    table.writerow(["time_s", "gaze_heading_rad", "lateral_position_m", "speed_mps"])
    for tick in world.ticks(every=12):
        table.writerow([f"{tick.time_s:.3f}", tick.car.gaze_heading_rad, tick.car.lateral_position_m, tick.car.speed_mps])
        if tick.time_s > first.time_s + float((sys.argv[3:] or ["600"])[0]):
            break
