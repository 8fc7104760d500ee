"""Elements of ASAM OpenDRIVE 1.8 as text, and the geometry behind them. Metres and radians throughout.

A plan is a list of records (s, pose, kind, length, curvature at the start, curvature at the end); a pose is x, y, heading.
"""
import math


def num(value):
    """Twelve digits: a micrometre in a thousand kilometres."""
    text = f"{value:.12g}"
    return "0" if text == "-0" else text


def walk(pose, kind, length, k0, k1, part=None):
    """The pose `part` along a segment (its end by default): composite Gauss-Legendre integration of the tangent."""
    x, y, heading = pose
    part = length if part is None else part
    rate = (k1 - k0) / length
    pieces = 64
    nodes = [(0.5 - math.sqrt(15) / 10, 5 / 18), (0.5, 8 / 18), (0.5 + math.sqrt(15) / 10, 5 / 18)]
    step = part / pieces
    for i in range(pieces):
        for node, weight in nodes:
            u = (i + node) * step
            angle = heading + k0 * u + 0.5 * rate * u * u
            x += weight * step * math.cos(angle)
            y += weight * step * math.sin(angle)
    return x, y, heading + k0 * part + 0.5 * rate * part * part


def chain(pose, segments):
    """Records of segments (kind, length, k0, k1) from a pose on, with the pose at their end and their length."""
    s, records = 0.0, []
    for kind, length, k0, k1 in segments:
        records.append((s, pose, kind, length, k0, k1))
        pose = walk(pose, kind, length, k0, k1)
        s += length
    return records, pose, s


class Writer:
    """Nested elements, one a line; begin and end pair up."""

    def __init__(self):
        self.lines, self.open = [], []

    def element(self, tag, /, **attributes):
        self.lines.append("  " * len(self.open) + self.tag(tag, attributes) + "/>")

    def begin(self, tag, /, **attributes):
        self.lines.append("  " * len(self.open) + self.tag(tag, attributes) + ">")
        self.open.append(tag)

    def end(self):
        name = self.open.pop()
        self.lines.append("  " * len(self.open) + f"</{name}>")

    @staticmethod
    def tag(name, attributes):
        words = (f'{k.rstrip("_")}="{num(v) if isinstance(v, (int, float)) else v}"' for k, v in attributes.items())
        return " ".join([f"<{name}", *words])


def poly(out, name, s, a=0.0, b=0.0, c=0.0, d=0.0, station="s"):
    out.element(name, **{station: s, "a": a, "b": b, "c": c, "d": d})


def plan_view(out, records):
    out.begin("planView")
    for s, (x, y, heading), kind, length, k0, k1 in records:
        out.begin("geometry", s=s, x=x, y=y, hdg=heading, length=length)
        if kind == "line":
            out.element("line")
        elif kind == "arc":
            out.element("arc", curvature=k0)
        else:
            out.element("spiral", curvStart=k0, curvEnd=k1)
        out.end()
    out.end()


MARKS = {
    "none": dict(type="none"),
    "edge": dict(type="solid", width=0.2, laneChange="none"),
    "lane": dict(type="broken", width=0.15, line=(6.0, 12.0)),
    "merge": dict(type="broken", width=0.3, line=(3.0, 3.0)),
}


def lane(out, number, type_, widths=(), mark="none", previous=None, next_=None, speed=None):
    """One lane; widths are (sOffset, a, b, c, d)."""
    out.begin("lane", id=number, type=type_, level="false")
    if previous is not None or next_ is not None:
        out.begin("link")
        if previous is not None:
            out.element("predecessor", id=previous)
        if next_ is not None:
            out.element("successor", id=next_)
        out.end()
    for width in widths:
        poly(out, "width", *width, station="sOffset")
    style = MARKS[mark]
    attributes = dict(sOffset=0, type=style["type"], weight="standard", color="white", material="standard")
    if "width" in style:
        attributes.update(width=style["width"], laneChange=style.get("laneChange", "both"))
    if "line" in style:
        out.begin("roadMark", **attributes)
        out.begin("type", name=style["type"], width=style["width"])
        length, space = style["line"]
        out.element("line", length=length, space=space, tOffset=0, sOffset=0, width=style["width"])
        out.end()
        out.end()
    else:
        out.element("roadMark", **attributes)
    if speed is not None:
        out.element("speed", sOffset=0, max=speed, unit="km/h")
    out.end()


def barrier(out, number, name, subtype, runs, height, width, z_offset=0.0):
    """A continuous object; runs are (s, length, t at the start, t at the end)."""
    s, length, t0, _ = runs[0]
    out.begin("object", id=number, name=name, type="barrier", subtype=subtype, s=s, t=t0, zOffset=z_offset, orientation="none",
              hdg=0, pitch=0, roll=0, length=length, width=width, height=height, dynamic="no")
    for s, length, t0, t1 in runs:
        out.element("repeat", s=s, length=length, distance=0, tStart=t0, tEnd=t1, heightStart=height, heightEnd=height,
                    zOffsetStart=z_offset, zOffsetEnd=z_offset, widthStart=width, widthEnd=width)
    out.end()


def junction(out, number, name, connections):
    out.begin("junction", id=number, name=name, type="direct")
    for i, (incoming, linked, contact, links) in enumerate(connections):
        out.begin("connection", id=i, incomingRoad=incoming, linkedRoad=linked, contactPoint=contact)
        for from_, to in links:
            out.element("laneLink", **{"from": from_, "to": to})
        out.end()
    out.end()
