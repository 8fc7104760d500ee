"""Plan curves between two poses (x, y, heading), as segments (kind, length, curvature at the start, curvature at the end)."""
import math


def turned(angle):
    """An angle within half a turn either way."""
    return math.remainder(angle, 2 * math.pi)


def moved(pose, along, across=0.0, turn=0.0):
    x, y, heading = pose
    return (x + along * math.cos(heading) - across * math.sin(heading), y + along * math.sin(heading) + across * math.cos(heading),
            heading + turn)


def end_of(pose, segments):
    """The pose at the end of lines and arcs, exactly."""
    x, y, heading = pose
    for _, length, k, _ in segments:
        half = 0.5 * k * length
        chord = length * (math.sin(half) / half if abs(half) > 1e-9 else 1.0)
        x, y = x + chord * math.cos(heading + half), y + chord * math.sin(heading + half)
        heading += k * length
    return x, y, heading


def arc(start, heading, end):
    """One arc that leaves `start` along `heading` and passes `end`."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    half = turned(math.atan2(dy, dx) - heading)
    chord = math.hypot(dx, dy)
    if abs(half) < 1e-7:
        return ("line", chord, 0.0, 0.0)
    length = chord * half / math.sin(half)
    k = 2 * half / length
    return ("arc", length, k, k)


def biarc(a, b):
    """Two arcs with equal tangents from pose a to pose b."""
    (xa, ya, ha), (xb, yb, hb) = a, b
    vx, vy = xb - xa, yb - ya
    tx, ty = math.cos(ha) + math.cos(hb), math.sin(ha) + math.sin(hb)
    v_t, v_v, less = vx * tx + vy * ty, vx * vx + vy * vy, 2 * (1 - math.cos(turned(hb - ha)))
    d = v_v / (2 * v_t) if less < 1e-9 else (math.sqrt(v_t * v_t + less * v_v) - v_t) / less
    middle = (0.5 * (xa + d * math.cos(ha) + xb - d * math.cos(hb)), 0.5 * (ya + d * math.sin(ha) + yb - d * math.sin(hb)))
    first = arc(a, ha, middle)
    second = arc(middle, end_of(a, [first])[2], b)
    alike = abs(first[2] - second[2]) < 1e-6
    return [arc(a, ha, b)] if alike else [first, second]


def fillet(a, b):
    """A line, an arc and a line where the poses' tangents meet ahead of a and behind b, with the widest arc; else two arcs."""
    (xa, ya, ha), (xb, yb, hb) = a, b
    turn = turned(hb - ha)
    if abs(math.sin(turn)) < 0.1:
        return biarc(a, b)
    cross = lambda ux, uy, vx, vy: ux * vy - uy * vx  # noqa: E731
    dx, dy = xb - xa, yb - ya
    from_a = cross(dx, dy, math.cos(hb), math.sin(hb)) / math.sin(turn)
    to_b = cross(math.cos(ha), math.sin(ha), dx, dy) / math.sin(turn)
    tangent = min(from_a, to_b)
    if tangent < 1.0:
        return biarc(a, b)
    radius = tangent / math.tan(abs(turn) / 2)
    k = math.copysign(1 / radius, turn)
    lines = [("line", from_a - tangent, 0.0, 0.0), ("arc", abs(turn) * radius, k, k), ("line", to_b - tangent, 0.0, 0.0)]
    return [segment for segment in lines if segment[1] > 1e-3]


def samples(pose, segments, step):
    """Poses along the curve, at most `step` apart, with their stations."""
    s = 0.0
    for kind, length, k0, k1 in segments:
        count = max(1, math.ceil(length / step))
        for i in range(count):
            part = length * i / count
            yield s + part, end_of(pose, [(kind, part, k0, k1)])
        pose, s = end_of(pose, [(kind, length, k0, k1)]), s + length
    yield s, pose
