"""A roundabout of one lane: a ring in pieces, one junction an arm. Ways in and out touch the ring in one arc each."""
import math

from town_geometry import moved

RING, LANE = 16.0, 5.0  # The ring's lane lies outside the circle of radius RING.
ISLAND = RING - 1.0
BESIDE = math.radians(32)  # From an arm to where its ways touch the ring.
WAY = RING * math.sin(BESIDE) / (1 - math.sin(BESIDE))
WAY_LENGTH = (math.pi / 2 - BESIDE) * WAY
HALF = (RING + WAY) * math.cos(BESIDE)  # From the middle to the streets' ends.


def ring_point(middle, angle):
    """The ring's inner edge at an angle, along the traffic."""
    return moved((*middle, angle), RING, turn=math.pi / 2)
