#!/usr/bin/env python3
"""Writes the shipped rigs from angles and distances; run it again after changing them. Writes beside itself.

A ring of flat screens stands around the eye point, neighbours sharing an edge. Each covers its angle fully: the full 30 degrees of
height hold at the screens' vertical edges too, where the screen is farthest from the eye.
"""
import math
import pathlib

EYE = (1.35, 0.37, 1.17)  # driver's eyes in the S80: forward of the rear axle, left of the middle, above the ground (m)
HERE = pathlib.Path(__file__).parent


def screen(name, from_deg, to_deg, height_deg, width_px, distance_m=2.4, rise_m=0.0, height_px=None, extra=""):
    """One screen from azimuth from_deg (left, larger) to to_deg, its middle distance_m away. Its height is height_deg, or that of height_px
    square pixels."""
    middle = math.radians((from_deg + to_deg) / 2)
    half = math.radians((from_deg - to_deg) / 2)
    edge_m = distance_m / math.cos(half)
    half_width_m = distance_m * math.tan(half)
    half_height_m = half_width_m * height_px / width_px if height_px else edge_m * math.tan(math.radians(height_deg / 2))

    def corner(azimuth, up):
        return [EYE[0] + edge_m * math.cos(azimuth), EYE[1] + edge_m * math.sin(azimuth), EYE[2] + up + rise_m]

    left, right = middle + half, middle - half
    corners = [corner(left, -half_height_m), corner(right, -half_height_m), corner(left, half_height_m)]
    pixels_high = height_px or round(width_px * half_height_m / half_width_m)
    lines = [f'name = "{name}"', f"width_px = {width_px}", f"height_px = {pixels_high}"]
    for key, point in zip(("lower_left_m", "lower_right_m", "upper_left_m"), corners):
        lines.append(f"{key} = [{', '.join(f'{value:.6f}' for value in point)}]")
    return "[[screen]]\n" + "\n".join(lines) + "\n" + extra + "\n"


def mirror(name, place, behind_deg, width_m, height_m, zone_deg, radius_m=0.0):
    """A glass at `place` in which the driver sees what lies towards the azimuth behind_deg, level: its normal halves the angle between
    that and the way to the eyes."""
    def unit(v):
        length = math.sqrt(sum(x * x for x in v))
        return [x / length for x in v]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

    azimuth = math.radians(behind_deg)
    to_eye = unit([EYE[i] - place[i] for i in range(3)])
    normal = unit([a + b for a, b in zip(to_eye, (math.cos(azimuth), math.sin(azimuth), 0.0))])
    right = unit(cross((0.0, 0.0, 1.0), normal))  # As the driver sees it.
    up = cross(normal, right)

    def corner(across, upward):
        point = [place[i] + 0.5 * (across * width_m * right[i] + upward * height_m * up[i]) for i in range(3)]
        return f"[{', '.join(f'{value:.6f}' for value in point)}]"

    radius = f"radius_m = {radius_m}\n" if radius_m else ""
    return (f'[[mirror]]\nname = "{name}"\n{radius}zone_from_deg = {zone_deg[0]}\nzone_to_deg = {zone_deg[1]}\n'
            f"lower_left_m = {corner(-1, -1)}\nlower_right_m = {corner(1, -1)}\nupper_left_m = {corner(-1, 1)}\n\n")


# Sizes of glass: the door mirrors' are convex (UN R46 class III: at least 1.2 m), the inside one is flat (class I: at least 0.15 m by 0.04 m)
# and hangs behind the windscreen's head. Heads turn less than eyes, so that
# the zones reach well towards the front, and meet between the two right ones.
LEFT, INSIDE, RIGHT = "left mirror", "inside mirror", "right mirror"
ASPECT = {LEFT: 0.19 / 0.112, INSIDE: 0.24 / 0.06, RIGHT: 0.19 / 0.112}


def mirrors(right_deg):
    return (mirror(LEFT, (1.95, 0.95, 1.0), 171, 0.19, 0.112, (25, 75), 1.4)
            + mirror(INSIDE, (1.82, 0.0, 1.26), 180, 0.24, 0.06, (-45, -20))
            + mirror(RIGHT, (1.95, -0.95, 1.0), right_deg, 0.19, 0.112, (-80, -45), 1.4))


MIRRORS = mirrors(187)
SOUND = "[sound]\n\n"  # Stereo on the usual device.


def inset(name, left, top, width, pixels):
    """The mirror on a screen of so many pixels, as wide a share of it as `width`."""
    height = width * pixels[0] / pixels[1] / ASPECT[name]
    return f'[[screen.inset]]\nmirror = "{name}"\nleft = {left}\ntop = {top}\nwidth = {width}\nheight = {height:.4f}\n'


def write(name, comment, body):
    eye = f"eye_point_m = [{', '.join(str(value) for value in EYE)}]"
    (HERE / f"{name}.toml").write_text(f'{comment}\nname = "{name}"\n{eye}\n\n{body}')


# Behind: 60 degrees around the rear, seen through the rear window and the car's own mirrors.
seven = "[car]\nsource = \"simulated-driver\"\nvehicle = \"volvo-s80\"\n\n" + mirrors(174)  # Turned in until it meets the screens behind.
for i in range(5):
    seven += screen(f"ahead-{i + 1}", 110 - 44 * i, 66 - 44 * i, 30, 640)
seven += screen("behind-right", 210, 180, 30, 448)
seven += screen("behind-left", 180, 150, 30, 448)
write("seven-screens", "# Seven projection screens around a complete car: 220 x 30 degrees ahead on five, 60 x 30 degrees behind on two.\n"
      "# (Lebram, Engstrom and Gustavsson 2006, section 3.2.) The mirrors are the car's own. Made by make_rigs.py.", seven)

MONITOR = (1920, 1080)
# Down to the dials, and up to most of the inside mirror.
desk = [("left", ""), ("middle", "instruments = true\n"), ("right", "")]  # They see the mirrors where they are.
three = "[car]\nsource = \"automatic\"\n\n" + SOUND + MIRRORS + "".join(
    screen(name, 90 - 60 * i, 30 - 60 * i, None, MONITOR[0], 0.8, rise_m=-0.085, height_px=MONITOR[1], extra=f"monitor = {i}\nshow_interior = true\n{more}")
    for i, (name, more) in enumerate(desk))
write("three-monitors", "# Three monitors on a desk, each 60 degrees wide. Measure your own and change the corners. Made by make_rigs.py.", three)

WINDOW = (1280, 747)
insets = inset(INSIDE, 0.40, 0.02, 0.24, WINDOW) + inset(LEFT, 0.01, 0.58, 0.17, WINDOW) + inset(RIGHT, 0.82, 0.58, 0.17, WINDOW)
write("desktop", "# One window on a desktop, with the three mirrors as insets while it does not see them in their places. Made by make_rigs.py.",
      "[car]\nsource = \"keyboard\"\n\n" + SOUND + MIRRORS
      + screen("desktop", 37, -37, 38.7, WINDOW[0], 0.7, rise_m=-0.15, extra="show_interior = true\ninstruments = true\n" + insets))
