#!/usr/bin/env python3
"""Writes the shipped rigs from angles and distances; run it again after changing them. Writes beside itself.

A ring of flat screens stands around the eye point, neighbours sharing an edge. Each covers its angle fully: the full 30 degrees of
height hold at the screens' vertical edges too, where the screen is farthest from the eye.
"""
import math
import pathlib

EYE = (1.35, 0.37, 1.17)  # driver's eyes in the S80: forward of the rear axle, left of the middle, above the ground (m)
HERE = pathlib.Path(__file__).parent


def screen(name, from_deg, to_deg, height_deg, width_px, distance_m=2.4, pitch_deg=0.0, height_px=None, extra=""):
    """One screen from azimuth from_deg (left, larger) to to_deg, its middle distance_m away."""
    middle = math.radians((from_deg + to_deg) / 2)
    half = math.radians((from_deg - to_deg) / 2)
    edge_m = distance_m / math.cos(half)
    half_height_m = edge_m * math.tan(math.radians(height_deg / 2))
    rise_m = edge_m * math.tan(math.radians(pitch_deg))

    def corner(azimuth, up):
        return [EYE[0] + edge_m * math.cos(azimuth), EYE[1] + edge_m * math.sin(azimuth), EYE[2] + up + rise_m]

    left, right = middle + half, middle - half
    corners = [corner(left, -half_height_m), corner(right, -half_height_m), corner(left, half_height_m)]
    pixels_high = height_px or round(width_px * half_height_m / (distance_m * math.tan(half)))
    lines = [f'name = "{name}"', f"width_px = {width_px}", f"height_px = {pixels_high}"]
    for key, point in zip(("lower_left_m", "lower_right_m", "upper_left_m"), corners):
        lines.append(f"{key} = [{', '.join(f'{value:.6f}' for value in point)}]")
    return "[[screen]]\n" + "\n".join(lines) + "\n" + extra + "\n"


def inset(left, top, width, height, from_deg, to_deg, height_deg, distance_m=1.0):
    text = screen("x", from_deg, to_deg, height_deg, 100, distance_m)
    corners = "\n".join(line for line in text.splitlines() if line.endswith("]") and line.startswith(("lower", "upper")))
    return f"[[screen.inset]]\nmirrored = true\nleft = {left}\ntop = {top}\nwidth = {width}\nheight = {height}\n{corners}\n"


def write(name, comment, body):
    eye = f"eye_point_m = [{', '.join(str(value) for value in EYE)}]"
    (HERE / f"{name}.toml").write_text(f'{comment}\nname = "{name}"\n{eye}\n\n{body}')


AHEAD = [f"ahead-{number}" for number in range(1, 6)]
seven = "[car]\nsource = \"simulated-driver\"\nvehicle = \"volvo-s80\"\n\n"
for i, name in enumerate(AHEAD):
    seven += screen(name, 110 - 44 * i, 66 - 44 * i, 30, 640)
# Behind: 60 degrees around the rear, seen through the rear window and the car's own mirrors.
seven += screen("behind-right", 210, 180, 30, 448)
seven += screen("behind-left", 180, 150, 30, 448)
write("seven-screens", "# Seven projection screens around a complete car: 220 x 30 degrees ahead on five, 60 x 30 degrees behind on two.\n"
      "# (Lebram, Engstrom and Gustavsson 2006, section 3.2.) Made by make_rigs.py.", seven)

mirror_ahead = inset(0.40, 0.02, 0.22, 0.13, 195, 165, 9)
desk = [("left", inset(0.80, 0.60, 0.18, 0.19, 184, 158, 15)), ("middle", "instruments = true\n" + mirror_ahead), ("right", inset(0.02, 0.60, 0.18, 0.19, 202, 176, 15))]
three = "[car]\nsource = \"automatic\"\n\n" + "".join(
    screen(name, 90 - 60 * i, 30 - 60 * i, 34, 1920, 0.8, height_px=1080, extra=f"monitor = {i}\nshow_interior = true\n{more}") for i, (name, more) in enumerate(desk))
write("three-monitors", "# Three monitors on a desk, each 60 degrees wide. Measure your own and change the corners. Made by make_rigs.py.", three)

mirrors = mirror_ahead + inset(0.01, 0.58, 0.17, 0.17, 184, 158, 15) + inset(0.82, 0.58, 0.17, 0.17, 202, 176, 15)
write("desktop", "# One window on a desktop, with the three mirrors as insets. Made by make_rigs.py.",
      "[car]\nsource = \"keyboard\"\n\n" + screen("desktop", 37, -37, 38.7, 1280, 0.7, extra="show_interior = true\ninstruments = true\n" + mirrors))
